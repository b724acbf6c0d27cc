// The part of the plane over which the J integral of a tip is taken, and the weight q that makes an area integral of
// the contour integral.
//
// With Eshelby's tensor E_Kj = (W + K) F_jK - sigma_ij (F_iK - delta_iK), whose divergence is the term P_K - B_K of
// j_integral.hpp, Green's theorem turns the contour integral of Nairn and Aimene, eq. 9, into
//   J_K = - int E_Kj dq/dx_j dA + int q (P_K - B_K) dA + sum over crack faces int q E_Kj n_j ds
// for any q that is 1 at the tip and 0 outside (Li, Shih and Needleman, Eng. Fract. Mech. 21 (1985) 405-421; n points
// out of the solid). Here q falls from 1 to 0 across each edge of a rectangle (+x, +y, -x, -y) about the tip, as the
// mean over all rectangles within one cell of it, so that J is the mean of the contour integrals over these. Nothing
// is extrapolated to the grid and back, the rectangle may lie anywhere between grid lines, and what goes wrong where a
// contour meets a crack in the middle of an interval, twice in one interval, or at a corner cannot go wrong: such
// places are points of the area like any other.
#pragma once
#include <algorithm>
#include <cmath>

#include "core/exec/config.hpp"
#include "core/math/vec.hpp"

namespace riven {

/// Edges of the rectangle: numbers of JDomain::reach.
enum Edge { right = 0, top = 1, left = 2, bottom = 3 };

/// q and its slopes at a place. Along each axis only the edge on that side of the tip has a slope.
struct JWeight {
  double q;
  int edge_x, edge_y;
  double slope_x, slope_y;  ///< 1/m, how fast q falls towards these edges
  RIVEN_INLINE Vec2 gradient() const {
    return {edge_x == right ? -slope_x : slope_x, edge_y == top ? -slope_y : slope_y};
  }
  RIVEN_INLINE double slope(int edge) const { return edge == edge_x ? slope_x : edge == edge_y ? slope_y : 0; }
};

struct JDomain {
  Vec2 tip;
  double reach[4] = {0, 0, 0, 0};  ///< m, from the tip to each edge
  double ramp[4] = {0, 0, 0, 0};   ///< m, q falls from reach - ramp to reach + ramp; at most the reach
  double steep[4] = {0, 0, 0, 0};  ///< 1/m, one over the ramps

  RIVEN_INLINE double outer(int edge) const { return reach[edge] + ramp[edge]; }
  RIVEN_INLINE double inner(int edge) const { return reach[edge] - ramp[edge]; }

  /// q = Q(x) R(y) at an offset r from the tip.
  RIVEN_INLINE JWeight at(Vec2 r) const {
    const bool x = r.x > 0, y = r.y > 0;
    const double w = x ? steep[right] : steep[left], h = y ? steep[top] : steep[bottom];
    const double s = place((std::fabs(r.x) - (x ? reach[right] : reach[left])) * w), Q = fall(s);
    const double t = place((std::fabs(r.y) - (y ? reach[top] : reach[bottom])) * h), R = fall(t);
    return {Q * R, x ? right : left, y ? top : bottom, (1 - std::fabs(s)) * w * R, (1 - std::fabs(t)) * h * Q};
  }
  RIVEN_INLINE double weight(Vec2 r) const { return at(r).q; }
  /// What the slope towards an edge adds up to over the area: the length of the edge.
  RIVEN_INLINE double length(int edge) const {
    return edge % 2 == 0 ? reach[top] + reach[bottom] : reach[right] + reach[left];
  }

 private:
  /// From -1, where q begins to fall towards an edge, to 1, where it has become 0.
  RIVEN_INLINE static double place(double s) {
    const double low = s > -1.0 ? s : -1.0;
    return low < 1.0 ? low : 1.0;
  }
  RIVEN_INLINE static double fall(double s) { return s < 0 ? 1 - 0.5 * (1 + s) * (1 + s) : 0.5 * (1 - s) * (1 - s); }
};

}  // namespace riven
