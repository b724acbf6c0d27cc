// The part of the plane over which the J integral of a tip is taken, and the weight q that makes an area integral of
// the contour integral.
//
// With Eshelby's tensor E_Kj = (W + K) F_jK - sigma_ij (F_iK - delta_iK), whose divergence is the inertia term P_K of
// j_integral.hpp, Green's theorem turns the contour integral of Nairn and Aimene, eq. 9, into
//   J_K = - int E_Kj dq/dx_j dA + int q P_K dA + sum over crack faces int q E_Kj n_j ds
// for any q that is 1 at the tip and 0 outside (Li, Shih and Needleman, Eng. Fract. Mech. 21 (1985) 405-421; n points
// out of the solid). Here q falls from 1 to 0 across each edge of a rectangle (+x, +y, -x, -y) about the tip, as the
// mean over all rectangles within one cell of it, so that J is the mean of the contour integrals over these. Nothing
// is extrapolated to the grid and back, the rectangle may lie anywhere between grid lines, and what goes wrong where a
// contour meets a crack in the middle of an interval, twice in one interval, or at a corner cannot go wrong: such
// places are points of the area like any other.
#pragma once
#include <algorithm>

#include "core/exec/config.hpp"
#include "core/math/vec.hpp"

namespace riven {

/// Edges of the rectangle: numbers of JDomain::reach.
enum Edge { right = 0, top = 1, left = 2, bottom = 3 };

struct JDomain {
  Vec2 tip;
  double reach[4] = {0, 0, 0, 0};  ///< m, from the tip to each edge
  double ramp[4] = {0, 0, 0, 0};   ///< m, q falls from reach - ramp to reach + ramp; at most the reach

  RIVEN_INLINE double outer(int edge) const { return reach[edge] + ramp[edge]; }
  RIVEN_INLINE double inner(int edge) const { return reach[edge] - ramp[edge]; }

  /// q = Q(x) R(y) at an offset r from the tip.
  RIVEN_INLINE double weight(Vec2 r) const { return fall(r.x, 0) * fall(r.y, 1); }
  /// The slope of the weight across one edge, per m; dq/dx = slope(left) - slope(right).
  RIVEN_INLINE double slope(Vec2 r, int edge) const {
    const double along = edge % 2 == 0 ? r.x : r.y, across = edge % 2 == 0 ? r.y : r.x;
    const double s = ((edge < 2 ? along : -along) - reach[edge]) / ramp[edge];
    return std::max(0.0, 1 - std::fabs(s)) / ramp[edge] * fall(across, 1 - edge % 2);
  }
  RIVEN_INLINE Vec2 gradient(Vec2 r) const {
    return {slope(r, left) - slope(r, right), slope(r, bottom) - slope(r, top)};
  }
  /// What the slope across an edge adds up to over the area: the length of the edge.
  RIVEN_INLINE double length(int edge) const {
    return edge % 2 == 0 ? reach[top] + reach[bottom] : reach[right] + reach[left];
  }

 private:
  RIVEN_INLINE double fall(double r, int axis) const {
    const int edge = r > 0 ? axis : axis + 2;
    const double s = std::min(1.0, std::max(-1.0, (std::fabs(r) - reach[edge]) / ramp[edge]));
    return s < 0 ? 1 - 0.5 * (1 + s) * (1 + s) : 0.5 * (1 - s) * (1 - s);
  }
};

}  // namespace riven
