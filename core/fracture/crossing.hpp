// Does the straight path from a particle to a node cross a crack? Signed areas with exact signs.
//
// The area of a triangle (Nairn, CMES 4 (2003) 649-663, eq. 33) is positive for counter-clockwise corners:
//   area(1, 2, 3) = x1 (y2 - y3) + x2 (y3 - y1) + x3 (y1 - y2).
// With particle 1, node 2 and the crack segment 3-4, the signs of (123) (124) (341) (342) tell that the path crosses
// with the particle above for (-++-), and, where the node lies on the crack, for (-++0) on the segment, (0++0) on its
// start and (-0+0) on its end; mirrored for below (the paper's Subtask 3). A crack is crossed if it is crossed an odd
// number of times (Subtask 4).
//
// That table lets paths from both sides cross a crack to a node that lies on it, and none from a particle that lies on
// it: the node would have to be given to one side by a count of paths, and the particle would hold the faces together.
// Here what lies on a crack is on one side of it:
//   - a node counts as below, so that paths from above cross to it, and from below do not;
//   - a particle counts as above.
// Nor does the table look beyond one segment. At a joint of two it would count a node on the joint twice and a path
// through the joint never, and so bond a crack whose joints fall on grid lines. A crack is one line, so here
//   - a node on a joint is one crossing: that of the segment which ends there, or, if the particle is in line with
//     that one, of the segment which starts there;
//   - a path through a joint takes the joint as lying on the positive side of the path: it counts once where the crack
//     passes from one side of the path to the other, and evenly where it only touches.
// A path through a tip crosses nothing, nor does one along the crack.
// Near open tips more is needed: crack_path.hpp.
#pragma once
#include <cmath>

#include "core/exec/config.hpp"
#include "core/math/vec.hpp"
#include "core/state/crack_fields.hpp"

namespace riven {

namespace detail {

RIVEN_INLINE int sign(double a) {
  return (a > 0) - (a < 0);
}

/// Adds b to the expansion e[0..n) without rounding (Shewchuk, Discrete Comput. Geom. 18 (1997) 305-363, figure 6).
RIVEN_INLINE void grow(double* e, int& n, double b) {
  for (int i = 0; i < n; ++i) {
    const double a = e[i], sum = b + a, part = sum - b;
    e[i] = (b - (sum - part)) + (a - part);
    b = sum;
  }
  e[n++] = b;
}

/// Sign of the area without rounding: six exact products, summed exactly. The products are written with fma so that a
/// compiler which contracts a * b + c cannot change them.
inline RIVEN_FN int exact_orientation(Vec2 a, Vec2 b, Vec2 c) {
  double e[12];
  int n = 0;
  const auto add_product = [&](double x, double y) {
    const double p = std::fma(x, y, 0.0);
    grow(e, n, std::fma(x, y, -p));
    grow(e, n, p);
  };
  add_product(a.x, b.y);
  add_product(-a.y, b.x);
  add_product(b.x, c.y);
  add_product(-b.y, c.x);
  add_product(c.x, a.y);
  add_product(-c.y, a.x);
  for (int i = n - 1; i >= 0; --i)
    if (e[i] != 0)
      return sign(e[i]);
  return 0;
}

}  // namespace detail

/// Exact sign of the signed area of the triangle a, b, c.
RIVEN_INLINE int orientation(Vec2 a, Vec2 b, Vec2 c) {
  const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x);
  const double area = left - right, size = std::fabs(left) + std::fabs(right);
  constexpr double rounding = 3.3306690738754716e-16;  // (3 + 16 eps) eps, Shewchuk section 4.2
  if (std::fabs(area) > rounding * size || size == 0)
    return detail::sign(area);
  return detail::exact_orientation(a, b, c);
}

/// How the path from particle p to node n crosses the segment point[0]-point[1] of a crack: +1 from above, -1 from
/// below, 0 not at all. `first` and `last` tell that point[0] and point[1] are the crack's tips; unless `first`,
/// point[-1] is read. `on_crack` is the side of a particle that lies on the segment: 0 for one that crosses nothing.
RIVEN_INLINE int crossing(Vec2 p, Vec2 n, const Vec2* point, bool first, bool last, int on_crack = 1) {
  const Vec2 a = point[0], b = point[1];
  const int at = orientation(a, b, p), from = at == 0 ? on_crack : at;
  if (from == 0)
    return 0;
  const int to = orientation(a, b, n);
  if (to == from)
    return 0;
  const int side_a = orientation(p, n, a), side_b = orientation(p, n, b);
  if (to == 0) {  // the node is in line with the segment: inside of it, on its end, on its start, or outside
    if (at <= 0)
      return 0;
    if (side_a * side_b < 0 || side_b == 0)
      return from;
    if (side_a == 0)
      return first || orientation(point[-1], a, p) == 0 ? from : 0;
    return 0;
  }
  if ((side_a == 0 && first) || (side_b == 0 && last))
    return 0;
  return (side_a < 0) != (side_b < 0) ? from : 0;
}

/// The crossings of one path with one crack, added up. An odd count crosses; the particle's side is the direction that
/// prevails, so that a path which enters a fold and leaves it again reports the side it comes from.
struct CrossingSum {
  int count = 0;
  int net = 0;
  RIVEN_INLINE void add(int c) {
    count += c != 0;
    net += c;
  }
  RIVEN_INLINE Side side() const { return count % 2 == 0 ? Side::none : net > 0 ? Side::above : Side::below; }
};

}  // namespace riven
