#include "core/fracture/extend_crack.hpp"

#include <algorithm>
#include <cmath>

#include "core/state/junctions.hpp"

namespace riven {

int extend_crack(Cracks& cracks, int crack, bool last, Vec2 plane, Vec2 plane0) {
  const long points = cracks.points(), at = last ? cracks.end_point(crack, true) + 1 : cracks.end_point(crack, false);
  const long end = last ? at - 1 : at + 1;  // the end before, once the new point is in
  cracks.each_point_array([&](auto& a) {
    if (a.size() != points)
      return;
    using T = std::remove_reference_t<decltype(a[0])>;
    a.resize(points + 1);
    std::copy_backward(a.begin() + at, a.begin() + points, a.end());
    a[at] = T{};
  });
  for (long c = crack + 1; c < cracks.start.size(); ++c)
    ++cracks.start[c];
  for (Junction& j : cracks.junctions)
    j.segment += !last && j.other == crack;
  cracks.crack[at] = crack;
  cracks.serial[at] = static_cast<int>(points);  // points only ever come
  cracks.plane[at] = cracks.upper[at] = cracks.lower[at] = plane;
  cracks.plane0[at] = plane0;
  if (!cracks.upper_velocity.empty())
    cracks.upper_velocity[at] = cracks.lower_velocity[at] =
        0.5 * (cracks.upper_velocity[end] + cracks.lower_velocity[end]);
  if (!cracks.in_solid.empty())
    cracks.in_solid[last ? end : at] = 1;
  if (!cracks.bearing.empty()) {
    const Vec2 there = cracks.bearing[end];
    cracks.bearing[at] = last ? Vec2{there.y, there.y} : Vec2{there.x, there.x};
  }
  return static_cast<int>(at);
}

void end_bears_nothing(Cracks& cracks, int crack, bool last) {
  if (!cracks.in_solid.empty())
    cracks.in_solid[last ? cracks.next_to_end(crack, true) : cracks.end_point(crack, false)] = 0;
  if (cracks.bearing.empty())
    return;
  cracks.bearing[cracks.end_point(crack, last)] = {};
  Vec2& next = cracks.bearing[cracks.next_to_end(crack, last)];
  (last ? next.y : next.x) = 0;
}

Rectangle box_of(const Cracks& cracks, int crack) {
  const int first = cracks.end_point(crack, false), last = cracks.end_point(crack, true);
  Rectangle box{cracks.plane[first], cracks.plane[first]};
  for (int k = first + 1; k <= last; ++k) {
    const Vec2 x = cracks.plane[k];
    box.lower = {std::min(box.lower.x, x.x), std::min(box.lower.y, x.y)};
    box.upper = {std::max(box.upper.x, x.x), std::max(box.upper.y, x.y)};
  }
  return box;
}

bool stops_growth(const Cracks& cracks, int crack) {
  return cracks.contact[static_cast<size_t>(crack)].law != ContactLaw::bonded;
}

std::optional<Obstacle> first_obstacle(const Cracks& cracks, int crack, bool last, Vec2 way, double reach,
                                       double beside, const std::vector<Rectangle>& boxes) {
  const int tip = cracks.end_point(crack, last), own = last ? tip - 1 : tip;
  const Vec2 x = cracks.plane[tip];
  std::optional<Obstacle> found;
  const auto take = [&](double distance, int point, double along) -> Obstacle* {
    if (found && found->distance <= distance)
      return nullptr;
    const int other = cracks.crack[point];
    const Vec2 a = cracks.plane[point], b = cracks.plane[point + 1];
    found = Obstacle{{crack, last, other, point - cracks.start[other], along}, a + along * (b - a), distance};
    return &*found;
  };
  const double far = 1.01 * (reach + beside);
  const auto elsewhere = [&](int c) {
    if (boxes.empty())
      return false;
    const Rectangle& box = boxes[static_cast<size_t>(c)];
    return box.lower.x > x.x + far || box.upper.x < x.x - far || box.lower.y > x.y + far || box.upper.y < x.y - far;
  };
  std::vector<int> near;
  for (int c = 0; c < cracks.count(); ++c)
    if (!elsewhere(c) && (c == crack || stops_growth(cracks, c)))
      near.push_back(c);
  for (const int c : near)
    for (int k = cracks.end_point(c, false); k < cracks.end_point(c, true); ++k) {
      if (k == own)
        continue;
      // x + t way = a + u (b - a)
      const Vec2 a = cracks.plane[k] - x, d = cracks.plane[k + 1] - cracks.plane[k];
      const double across = cross(way, d);
      if (across == 0)
        continue;
      const double t = cross(a, d) / across, u = cross(a, way) / across;
      constexpr double joint = 1e-9;  // so that no way leads through a joint of two segments
      if (t > 0 && t <= reach && u >= -joint && u <= 1 + joint)
        take(t, k, std::clamp(u, 0., 1.));
    }
  for (const int c : near)
    for (const bool other_last : {false, true}) {
      const int k = cracks.end_point(c, other_last);
      if (k == tip)
        continue;
      const Vec2 r = cracks.plane[k] - x;
      const double t = dot(r, way);
      if (t > 0 && t <= reach && std::fabs(cross(way, r)) < beside)
        if (Obstacle* o = take(t, other_last ? k - 1 : k, other_last)) {
          o->end = true;
          o->end_last = other_last;
        }
    }
  return found;
}

void join_crack(Cracks& cracks, const Obstacle& o, Vec2 plane0, double h) {
  const Junction& j = o.on;
  extend_crack(cracks, j.crack, j.last, o.place, plane0);
  part_surfaces(cracks, j, o.place, h);
  cracks.junctions.push_back(j);
  if (j.other == j.crack && !j.last)
    ++cracks.junctions.back().segment;  // which was counted before the new point
  tie_junctions(cracks, h);
}

}  // namespace riven
