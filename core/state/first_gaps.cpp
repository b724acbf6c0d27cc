#include "core/state/first_gaps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/laws/contact.hpp"
#include "core/state/lay_points.hpp"
#include "core/state/make_tips.hpp"

namespace riven {

namespace {

constexpr double rounding = 1e-5;  ///< cells
constexpr double border = 0.25;    ///< cells, by which a crack along the border of a body may lie in it, as chords do
constexpr double aside = 0.01;     ///< cells: from the end of a border the way leads along an edge, which is neither
constexpr double deep = 3;         ///< cells behind a face, from where no node beside it sees a particle
constexpr double past_end = 2;     ///< cells, beyond the ends of a crack

/// From x along `way`, of unit length, over what is void to the first body, m.
std::optional<double> to_solid(const Scene& s, Vec2 x, Vec2 way) {
  constexpr double fine = 0.01, middle = 0.05, coarse = 0.25, near = 4;  // cells
  constexpr int halvings = 30;
  const Rectangle grid{s.grid.lower, s.grid.upper};
  const auto inside = [&](double d) { return contains(grid, x + (d * s.cell) * way); };
  const auto solid = [&](double d) {
    for (const double side : {0., -aside, aside})
      if (body_at(s, x + s.cell * (d * way + side * turned(way))) >= 0)
        return true;
    return false;
  };
  /// Where it changes between solid and void, from d on.
  const auto change = [&](double from, double end) -> std::optional<double> {
    const bool is = solid(from);
    double nearer = from, d = from + fine;
    for (; d < end && inside(d) && solid(d) == is; d += d < border ? fine : d < near ? middle : coarse)
      nearer = d;
    if (d >= end || !inside(d))
      return {};
    for (int k = 0; k < halvings; ++k)
      (solid(0.5 * (nearer + d)) == is ? nearer : d) = 0.5 * (nearer + d);
    return d;
  };
  const bool within = solid(rounding);
  const auto face = within ? change(rounding, border) : rounding;
  if (!face)
    return 0;
  const auto next = change(*face, std::numeric_limits<double>::infinity());
  if (!next)
    return {};
  return (*next - (within ? *face : 0)) * s.cell;
}

/// Towards above, at a point of a crack as it is drawn.
Vec2 up_at(const Cracks& c, int k) {
  const int crack = c.crack[k];
  const Vec2 along =
      c.plane0[std::min(k + 1, c.end_point(crack, true))] - c.plane0[std::max(k - 1, c.end_point(crack, false))];
  const double length = norm(along);
  return length > 0 ? (1 / length) * turned(along) : Vec2{};
}

/// At a point of a crack. Solids that are both farther than `near` are seen by the way, as from the mouth of a notch
/// between two rollers, and a crack belongs to a single solid only along its border.
Vec2 gaps_at(const Scene& scene, const Cracks& cracks, int k) {
  constexpr double near = 2, along = 0.05;  // cells
  constexpr double nothing = std::numeric_limits<double>::infinity();
  const Vec2 up = up_at(cracks, k);
  const double above = to_solid(scene, cracks.plane0[k], up).value_or(nothing),
               below = to_solid(scene, cracks.plane0[k], -up).value_or(nothing);
  const double reach = scene.cell * (std::isinf(std::max(above, below)) ? along : near);
  return std::min(above, below) <= reach ? Vec2{above, below} : Vec2{nothing, nothing};
}

bool is_between_solids(Vec2 gap) {
  return std::isfinite(gap.x) && std::isfinite(gap.y);
}

bool any_apart(const exec::Array<Vec2>& gaps) {
  return std::any_of(gaps.begin(), gaps.end(), [](Vec2 gap) { return is_between_solids(gap) && gap.x + gap.y > 0; });
}

}  // namespace

exec::Array<Vec2> first_gaps(const Scene& scene, const Cracks& cracks) {
  exec::Array<Vec2> gaps(cracks.points());
  for (int k = 0; k < cracks.points(); ++k)
    if (keeps_apart(cracks.contact[cracks.crack[k]].law))
      gaps[k] = gaps_at(scene, cracks, k);
  if (scene.bodies.size() < 2 && !any_apart(gaps))
    gaps.resize(0);
  return gaps;
}

bool starts_apart(const Scene& scene) {
  return scene.contact_rules.detection == ContactDetection::displacement &&
         any_apart(first_gaps(scene, make_cracks(scene, least_particle_distance(scene))));
}

/// What a particle sees of a crack.
struct ClosedGaps::Face {
  double rank = std::numeric_limits<double>::infinity();  ///< m, about the depth behind the face; infinite: no face
  double gap = 0;                                         ///< m
  Vec2 way;                                               ///< unit length, from the particle to the crack
};

ClosedGaps::ClosedGaps(const Cracks& cracks, double cell) : cracks_(cracks), cell_(cell), gap_(cracks.gap) {
  for (int c = 0; c < cracks.count(); ++c) {
    const int first = cracks.end_point(c, false), last = cracks.end_point(c, true);
    Vec2 low = cracks.plane0[first], high = low;
    carry_gaps(first, last);
    double widest = 0;
    for (int k = first; k <= last; ++k) {
      const Vec2 x = cracks.plane0[k];
      low = {std::min(low.x, x.x), std::min(low.y, x.y)};
      high = {std::max(high.x, x.x), std::max(high.y, x.y)};
      widest = std::max({widest, gap_[k].x, gap_[k].y});
    }
    const double out = widest + deep * cell;
    boxes_.push_back({low - Vec2{out, out}, high + Vec2{out, out}});
    (widest > 0 ? open_ : shut_).push_back(c);
  }
}

void ClosedGaps::carry_gaps(int first, int last) {
  std::vector<int> between;  // solids
  for (int k = first; k <= last; ++k)
    if (is_between_solids(gap_[k]))
      between.push_back(k);
  for (int k = first; k <= last; ++k) {
    const auto next = std::lower_bound(between.begin(), between.end(), k);
    const bool before = next == between.end() || (next != between.begin() && k - next[-1] < *next - k);
    gap_[k] = between.empty() ? Vec2{} : gap_[before ? next[-1] : *next];
  }
}

ClosedGaps::Face ClosedGaps::face(int crack, Vec2 x) const {
  if (!contains(boxes_[static_cast<size_t>(crack)], x))
    return {};
  const int first = cracks_.end_point(crack, false), last = cracks_.end_point(crack, true);
  double nearest = std::numeric_limits<double>::infinity(), gap = 0;
  Vec2 way;
  for (int k = first; k < last; ++k) {
    const Vec2 a = cracks_.plane0[k], along = cracks_.plane0[k + 1] - a;
    const double length = norm(along), t = dot(x - a, along) / (length * length), past = past_end * cell_ / length;
    const Vec2 foot = a + std::clamp(t, k == first ? -past : 0., k + 1 == last ? 1 + past : 1.) * along;
    const double distance = norm(foot - x);
    if (distance >= nearest || distance == 0)
      continue;
    nearest = distance;
    way = (1 / distance) * (foot - x);
    const double part = std::clamp(t, 0., 1.);
    const Vec2 gaps = (1 - part) * gap_[k] + part * gap_[k + 1];
    gap = cross(along, x - a) > 0 ? gaps.x : gaps.y;
  }
  const double depth = nearest - gap;
  if (depth < -0.5 * cell_ || depth > deep * cell_)
    return {};
  return {depth + 0.01 * nearest, gap, way};  // of two cracks before one face that it is nearer to
}

Vec2 ClosedGaps::place(Vec2 x) const {
  constexpr double parallel = 0.5;  // sine of the angle between two faces
  Face nearest, next;
  const auto take = [&](const std::vector<int>& cracks) {
    for (const int c : cracks)
      if (const Face f = face(c, x); f.rank < nearest.rank) {
        next = nearest;
        nearest = f;
      } else if (f.rank < next.rank) {
        next = f;
      }
  };
  take(open_);
  if (std::isinf(nearest.rank))
    return x;
  take(shut_);
  const double sine = cross(nearest.way, next.way);
  if (std::isinf(next.rank) || std::abs(sine) < parallel)
    return x + nearest.gap * nearest.way;
  return x + (1 / sine) * (next.gap * turned(nearest.way) - nearest.gap * turned(next.way));
}

}  // namespace riven
