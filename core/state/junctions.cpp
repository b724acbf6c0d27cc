#include "core/state/junctions.hpp"

#include <algorithm>
#include <optional>

#include "core/state/make_tips.hpp"

namespace riven {

namespace {

Vec2 unit(Vec2 v) {
  const double length = norm(v);
  return length > 0 ? v * (1 / length) : Vec2{};
}

struct Nearest {
  double distance;  ///< m
  Junction on;
};

/// Is a crack so long that its ends meet where they are within `reach` of each other, and not for its being short?
bool may_close(const Cracks& cracks, int crack, double reach) {
  double length = 0;
  for (int k = cracks.end_point(crack, false); k < cracks.end_point(crack, true); ++k)
    length += norm(cracks.plane[k + 1] - cracks.plane[k]);
  return length > 4 * reach;
}

/// Where within `reach` an end meets an end of a crack that comes before it, or its own other end; the first crack.
std::optional<Junction> end_met(const Cracks& cracks, int crack, bool last, double reach) {
  const Vec2 x = cracks.plane[cracks.end_point(crack, last)];
  for (int c = 0; c <= crack; ++c)
    for (const bool other_last : {false, true}) {
      if (c == crack && (!last || other_last))
        continue;  // of a closed line, the last end is tied to the first
      const int k = cracks.end_point(c, other_last), segments = cracks.end_point(c, true) - cracks.end_point(c, false);
      if (norm(cracks.plane[k] - x) < reach && (c != crack || may_close(cracks, crack, reach)))
        return Junction{crack, last, c, other_last ? segments - 1 : 0, double(other_last)};
    }
  return std::nullopt;
}

/// The place nearest to an end, and within `reach`, on another crack, or on its own beyond what lies around the end.
std::optional<Junction> line_met(const Cracks& cracks, int crack, bool last, double reach) {
  const int end = cracks.end_point(crack, last), step = last ? -1 : 1;
  const Vec2 x = cracks.plane[end];
  std::optional<Nearest> nearest;
  const auto look = [&](int c, int k) {
    const Vec2 a = cracks.plane[k], d = cracks.plane[k + 1] - a;
    const double t = std::clamp(dot(x - a, d) / dot(d, d), 0., 1.), distance = norm(x - a - t * d);
    if (distance < reach && !(nearest && nearest->distance <= distance))
      nearest = {distance, {crack, last, c, k - cracks.end_point(c, false), t}};
  };
  // an end that meets this one is tied to this one, not this one to it
  const auto meets = [&](int c, bool l) { return norm(cracks.plane[cracks.end_point(c, l)] - x) < reach; };
  for (int c = 0; c < cracks.count(); ++c) {
    if (c == crack || meets(c, false) || meets(c, true))
      continue;
    for (int k = cracks.end_point(c, false); k < cracks.end_point(c, true); ++k)
      look(c, k);
  }
  const int stop = meets(crack, !last) ? end : cracks.end_point(crack, !last);
  double along = 0;
  for (int k = end; k != stop; k += step) {
    if (along > 4 * reach)
      look(crack, std::min(k, k + step));
    along += norm(cracks.plane[k + step] - cracks.plane[k]);
  }
  return nearest ? std::optional(nearest->on) : std::nullopt;
}

Vec2 place_of(const Cracks& cracks, const Junction& j) {
  const int a = cracks.end_point(j.other, false) + j.segment;
  return cracks.plane[a] + j.along * (cracks.plane[a + 1] - cracks.plane[a]);
}

}  // namespace

void tie_from_start(const Scene& scene, Cracks& cracks) {
  for (int c = 0; c < cracks.count(); ++c)
    for (const bool last : {false, true}) {
      const int end = cracks.end_point(c, last), body = body_at(scene, cracks.plane[end]);
      if (body < 0)
        continue;
      const double reach = junction_reach(scene, body);
      std::optional<Junction> on = end_met(cracks, c, last, reach);
      if (!on)
        on = line_met(cracks, c, last, reach);
      if (on)
        cracks.junctions.push_back(*on);
    }
  for (const Junction& j : cracks.junctions) {
    const Vec2 place = place_of(cracks, j);
    cracks.plane0[cracks.end_point(j.crack, j.last)] = place;
    part_surfaces(cracks, j, place, scene.cell);
  }
  tie_junctions(cracks, scene.cell);
}

void tie_junctions(Cracks& cracks, double h) {
  for (const Junction& j : cracks.junctions) {
    const int end = cracks.end_point(j.crack, j.last), before = cracks.next_to_end(j.crack, j.last);
    const Vec2 place = place_of(cracks, j);
    cracks.plane[end] = place + (overshoot * h) * unit(place - cracks.plane[before]);
  }
}

void part_surfaces(Cracks& cracks, const Junction& j, Vec2 place, double h) {
  const int end = cracks.end_point(j.crack, j.last), before = cracks.next_to_end(j.crack, j.last);
  cracks.upper[end] = cracks.lower[end] = place - (overshoot * h) * unit(place - cracks.plane[before]);
}

}  // namespace riven
