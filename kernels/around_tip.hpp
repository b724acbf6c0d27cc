// What lies around the tip of a crack that grows: the way that it has come straight, tips that face it, and the ways
// that lead out of what is left of the solid.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "core/fracture/extend_crack.hpp"
#include "core/fracture/opening.hpp"
#include "core/state/state.hpp"
#include "kernels/particles_near.hpp"

namespace riven {

template <class Real>
class AroundTip {
 public:
  const Vec2 place, ahead;  ///< of the tip, m, and where its crack points, of unit length

  /// `particle`: size of one, m; `boxes`: around the cracks.
  AroundTip(State<Real, 2>& s, const Tip& tip, double particle, const std::vector<Rectangle>& boxes)
      : place(s.cracks.plane[s.cracks.end_point(tip.crack, tip.last)]),
        ahead(heading_of(s.cracks, tip)),
        s_(s),
        tip_(tip),
        particle_(particle),
        boxes_(boxes) {}

  /// How far the modes at the tip say where to go, 0 to 1: the square of the way that it has come straight on since it
  /// last turned sharply as it grew, over what it takes.
  double told() const {
    const double share = std::min(1.0, length_since_kink() / (told_by * s_.grid.lattice.h));
    return share * share;
  }

  /// The nearest tip that faces this one within a cell.
  Tip* facing_tip() const {
    Tip* nearest = nullptr;
    double least = s_.grid.lattice.h;
    for (Tip& t : s_.tips) {
      if (&t == &tip_ || !t.open || (t.crack != tip_.crack && !stops_growth(s_.cracks, t.crack)))
        continue;
      const Vec2 r = s_.cracks.plane[s_.cracks.end_point(t.crack, t.last)] - place;
      const double d = norm(r);
      if (!(d > 0 && d < least))
        continue;
      const Vec2 its = heading_of(s_.cracks, t);
      if (std::min({dot(r, ahead) / d, -dot(r, its) / d, -dot(ahead, its)}) > facing) {
        least = d;
        nearest = &t;
      }
    }
    return nearest;
  }

  /// Does a way lead out of the solid, or into another crack, within so many cells?
  bool leads_out(Vec2 way, double cells) const { return length_out(way, cells * s_.grid.lattice.h).has_value(); }

  /// The way nearest to straight on that leads out of the solid or into another crack within the contour of so many
  /// cells, or, at an angle, within the cells that the least contour takes: what is left of the solid there none can
  /// tell about.
  std::optional<Vec2> way_out(int contour) const {
    const double h = s_.grid.lattice.h;
    if (length_out(ahead, (0.5 * contour + 1) * h))
      return ahead;
    constexpr int angles = 5;
    for (int k = 1; k <= angles; ++k) {
      const double angle = k * std::numbers::pi / (2 * angles);
      const Vec2 on = std::cos(angle) * ahead, aside = std::sin(angle) * turned(ahead);
      const Vec2 ways[2] = {on + aside, on - aside};
      const std::optional<double> length[2] = {length_out(ways[0], 2.25 * h), length_out(ways[1], 2.25 * h)};
      if (length[0] || length[1])
        return ways[!length[0] || (length[1] && *length[1] < *length[0])];
    }
    return std::nullopt;
  }

 private:
  static constexpr double facing = 0.5;  ///< cosine of the angle up to which tips are in each other's way
  /// Cells from a kink to the tip from which on the modes say where to go. With less the grid does not part the kinked
  /// piece from the crack that it left: K_II / K_I is off by up to 0.1, which turned cracks by 7 to 9 degrees, and
  /// back.
  static constexpr double told_by = 1.5;
  static constexpr double straight = 0.966;  ///< cosine of the angle from which on a crack has a kink, 15 degrees

  /// m; without end if it has not turned.
  double length_since_kink() const {
    const int step = tip_.last ? -1 : 1, other = s_.cracks.end_point(tip_.crack, !tip_.last);
    double length = 0;
    const double grown = tip_.length + 0.5 * particle_;  // stretched, too
    for (int k = s_.cracks.end_point(tip_.crack, tip_.last); k != other && length < grown; k += step) {
      const Vec2 along = s_.cracks.plane[k] - s_.cracks.plane[k + step];
      if (dot(along, ahead) < straight * norm(along))
        return length;
      length += norm(along);
    }
    return std::numeric_limits<double>::infinity();
  }

  /// How far away the edge of the solid, or another crack, is, m; none beyond reach.
  std::optional<double> length_out(Vec2 way, double reach) const {
    const auto obstacle = first_obstacle(s_.cracks, tip_.crack, tip_.last, way, reach, 0, boxes_);
    const auto outside = [&](double d) { return !solid_ahead(s_, place + d * way, way, particle_); };
    const double limit = obstacle ? obstacle->distance : reach;
    double d = 0;
    while (d < limit && !outside(d))
      d += particle_;
    if (!(d < limit))
      return obstacle ? std::optional(obstacle->distance) : std::nullopt;
    double within = std::max(0., d - particle_);
    for (int halving = 0; halving < 10; ++halving) {
      const double middle = 0.5 * (within + d);
      (outside(middle) ? d : within) = middle;
    }
    return d;
  }

  State<Real, 2>& s_;
  const Tip& tip_;
  double particle_;
  const std::vector<Rectangle>& boxes_;
};

}  // namespace riven
