// The branch cut of the known fields around a tip (auxiliary_fields.hpp), laid along the faces of a crack that bends.
//
// As written the fields have their cut along the straight line behind the tip. They go on beyond it as sqrt(z) does,
// and solve the same equations there: where they have turned by a full circle they are what they were with the other
// sign. So between that line and the crack the sign is turned round. The fields are smooth in all of the solid then,
// and part where it does.
#pragma once
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/fracture/way_from_tip.hpp"
#include "core/math/vec.hpp"

namespace riven {

class BranchCut {
 public:
  /// That along a crack's way from its tip; none where it is in line with the tip. Farther away the cut goes on
  /// straight away from the tip.
  static std::optional<BranchCut> along(const Cracks& cracks, const Tip& tip, Vec2 heading, const WayFromTip& way) {
    const Vec2 x = cracks.plane[cracks.end_point(tip.crack, tip.last)];
    bool bends = false;
    Vec2 last = x;
    way.each(cracks, tip, [&](int k) {
      const Vec2 at = cracks.plane[k], segment = last - at;
      const double off = cross(segment, heading);
      bends = bends || off * off > curved * curved * dot(segment, segment);
      last = at;
    });
    if (!bends)
      return std::nullopt;
    BranchCut cut;
    way.each(cracks, tip, [&](int k) { cut.add(cracks.plane[k] - x, heading); });
    cut.add(2 * (last - x), heading);
    return cut;
  }

  /// The sign of the fields at a place beside the crack, in the tip's frame (x along its heading).
  double sign(Vec2 r) const {
    const double distance = norm(r);
    if (r.x > ahead_ * distance)  // as most places are
      return 1;
    const Vec2 c = at(distance);
    const bool between = c.y > 0 ? r.y > 0 && cross(c, r) > 0 : r.y < 0 && cross(c, r) < 0;
    return between ? -1 : 1;
  }
  /// That on the face to the left of the heading, at a place on the crack.
  static double sign_on_left(Vec2 r) { return r.y < 0 ? -1 : 1; }

  /// Sine of the angle between a segment and the heading from which on the cut follows the crack.
  static constexpr double curved = 0.05;
  /// And that from which on the crack is bent.
  static constexpr double bent = 0.2;

 private:
  struct Point {
    Vec2 r;  ///< in the tip's frame
    double distance;
  };

  void add(Vec2 from_tip, Vec2 heading) {
    const Point p{{dot(from_tip, heading), cross(heading, from_tip)}, norm(from_tip)};
    points_.push_back(p);
    if (p.distance > 0)
      ahead_ = std::max(ahead_, p.r.x / p.distance);
  }

  /// Where the crack is as far from the tip.
  Vec2 at(double distance) const {
    const auto next = std::upper_bound(points_.begin() + 1, points_.end() - 1, distance,
                                       [](double d, const Point& p) { return d < p.distance; });
    const Point &a = next[-1], &b = *next;
    return a.r + ((distance - a.distance) / (b.distance - a.distance)) * (b.r - a.r);
  }

  std::vector<Point> points_;  ///< from the tip on
  double ahead_ = -1;          ///< largest cosine of the angle to the heading under which the tip sees them
};

}  // namespace riven
