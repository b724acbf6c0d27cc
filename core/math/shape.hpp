// Shape functions on the regular grid. Each is a product of one-dimensional functions; the number of nodes along
// an axis is the shape function's own property, and so is the neighbour count that follows from it.
//
// X is a particle's position in cells from node 0, in double so that its place in its cell is sharp whatever Real is.
// `axis` gives the first node it sees, the values s and the gradients g of its `width` nodes, per cell or, where it is
// told how many cells there are to a unit of length, per that:
//   linear    N(r) = 1 - |r|                                          (Sulsky et al. 1994)
//   uGIMP     the hat function averaged over the particle's domain    (Bardenhagen and Kober 2004, eq. 36)
//   B-spline  quadratic, node-centred; the ghost node outside a wall is folded onto the two nodes inside by linear
//             extrapolation, N_0 += 2 N_-1, N_1 -= N_-1, so that sum N_i = 1 and sum N_i x_i = x up to the wall.
#pragma once
#include <algorithm>
#include <cmath>

#include "core/exec/config.hpp"

namespace riven {

template <class Real, int Width>
struct Axis {
  int base;  ///< number of the first node along this axis
  Real s[Width];
  Real g[Width];
};

/// The least weight of a node whose gradient is not zero. A particle right on a node would give the next one none: that
/// node, without mass, would lose the force on it and have no velocity to strain the particle by.
template <class Real>
inline constexpr Real least_weight = Real(0x1p-52);

/// What the one-dimensional functions need to know about a particle and the grid along one axis.
template <class Real>
struct AxisSetting {
  Real half = Real(0.25);    ///< half of the particle's domain, in cells (uGIMP)
  Real inv_4half = Real(1);  ///< 1 / (4 half)
  int wall_lower = 0;        ///< node numbers of the walls (B-spline)
  int wall_upper = 0;
};

struct Linear {
  static constexpr int width = 2;
  static constexpr const char* name = "linear";

  /// The cell by which particles are sorted: the first node that they see.
  static RIVEN_INLINE int cell(double X) { return static_cast<int>(std::floor(X)); }
  template <class Real>
  static RIVEN_INLINE Axis<Real, 2> axis(double X, const AxisSetting<Real>&, Real cells = Real(1)) {
    const double f = std::floor(X);
    const Real least = least_weight<Real>, r = std::max(Real(X - f), least);  // a copy: std::max takes an address
    return {static_cast<int>(f), {Real(1) - r, r}, {-cells, cells}};
  }
  /// How far X may move, in cells, before it leaves its cell.
  static RIVEN_INLINE double to_next_cell(double X) {
    const double r = X - std::floor(X);
    return std::min(r, 1 - r);
  }
  /// The same, before it leaves its cell or a weight begins or ceases to be zero.
  template <class Real>
  static RIVEN_INLINE double to_other_weights(double X, const AxisSetting<Real>&) {
    return to_next_cell(X);
  }
};

struct UGimp {
  static constexpr int width = 3;
  static constexpr const char* name = "ugimp";

  static RIVEN_INLINE int cell(double X) { return static_cast<int>(std::floor(X + 0.5)); }
  template <class Real>
  static RIVEN_INLINE Axis<Real, 3> axis(double X, const AxisSetting<Real>& a, Real cells = Real(1)) {
    const double near = std::floor(X + 0.5);
    const Real r = Real(X - near), l = a.half;
    const Real c = std::min(std::max(r, -l), l);
    const Real below = l - c, above = l + c;
    const Real s0 = below * below * a.inv_4half + std::max(Real(0), c - r);
    const Real s2 = above * above * a.inv_4half + std::max(Real(0), r - c);
    const Real slope = Real(2) * a.inv_4half * cells, fall = slope * below, rise = slope * above;
    return {static_cast<int>(near) - 1, {s0, Real(1) - s0 - s2, s2}, {-fall, fall - rise, rise}};
  }
  static RIVEN_INLINE double to_next_cell(double X) { return 0.5 - std::abs(X - std::floor(X + 0.5)); }
  template <class Real>
  static RIVEN_INLINE double to_other_weights(double X, const AxisSetting<Real>& a) {
    const double r = std::abs(X - std::floor(X + 0.5));
    return std::min(0.5 - r, std::abs(r - a.half));
  }
};

struct BSpline {
  static constexpr int width = 3;
  static constexpr const char* name = "bspline";

  static RIVEN_INLINE int cell(double X) { return static_cast<int>(std::floor(X + 0.5)); }
  template <class Real>
  static RIVEN_INLINE Axis<Real, 3> axis(double X, const AxisSetting<Real>& a, Real cells = Real(1)) {
    const double near = std::floor(X + 0.5);
    const Real r = Real(X - near);
    const int node = static_cast<int>(near);
    const Real below = Real(0.5) - r, above = Real(0.5) + r;
    Real s0 = Real(0.5) * below * below, s2 = Real(0.5) * above * above, s1 = Real(1) - s0 - s2;
    const Real fall = cells * below, rise = cells * above;
    // at a wall the functions become linear in the outer half cell; a particle that has slipped past the wall
    // keeps non-negative masses by being taken at the wall
    const bool low = node <= a.wall_lower, high = node >= a.wall_upper;
    const Real least = least_weight<Real>;
    const Real in = std::min(Real(1), std::max(least, r)), out = std::min(Real(1), std::max(least, -r));
    s0 = low ? Real(0) : high ? out : s0;
    s1 = low ? Real(1) - in : high ? Real(1) - out : s1;
    s2 = low ? in : high ? Real(0) : s2;
    const Real g0 = low ? Real(0) : high ? -cells : -fall;
    const Real g1 = low ? -cells : high ? cells : fall - rise;
    const Real g2 = low ? cells : high ? Real(0) : rise;
    return {node - 1, {s0, s1, s2}, {g0, g1, g2}};
  }
  static RIVEN_INLINE double to_next_cell(double X) { return 0.5 - std::abs(X - std::floor(X + 0.5)); }
  template <class Real>
  static RIVEN_INLINE double to_other_weights(double X, const AxisSetting<Real>& a) {
    const double near = std::floor(X + 0.5), r = std::abs(X - near);
    const int node = static_cast<int>(near);
    return node <= a.wall_lower || node >= a.wall_upper ? std::min(0.5 - r, r) : 0.5 - r;
  }
};

/// Weights along the normal of the edge of a body, half a particle beyond the last one, that balance a uniform stress
/// in the row of particles that ends there at X: s_i = +-d sum_k g_i(X -+ k d), d being the length of a particle. For
/// uGIMP these are the functions N_i at the edge itself, as g_i = (N_i(X + d/2) - N_i(X - d/2)) / d. `out` is +-1, or 0
/// for the functions at X.
template <class Shape, class Real>
RIVEN_INLINE Axis<Real, Shape::width> axis_at_edge(double X, const AxisSetting<Real>& setting, int out) {
  Axis<Real, Shape::width> edge = Shape::axis(X, setting);
  if (out == 0)
    return edge;
  const Real d = Real(2) * setting.half;
  for (int m = 0; m < Shape::width; ++m)
    edge.s[m] = 0;
  for (int k = 0, past = 0; past < Shape::width; ++k) {  // up to the particle that shares no node with the last one
    const Axis<Real, Shape::width> inner = Shape::axis(X - out * k * double(d), setting);
    past = out * (edge.base - inner.base);
    for (int m = 0; m < Shape::width; ++m)
      if (const int n = inner.base + m - edge.base; n >= 0 && n < Shape::width)
        edge.s[n] += out * d * inner.g[m];
  }
  return edge;
}

/// Nodes that one particle sees.
template <class Shape, int Dim>
inline constexpr int neighbours = [] {
  int n = 1;
  for (int d = 0; d < Dim; ++d)
    n *= Shape::width;
  return n;
}();

// INSTANTIATE(Shape, Real) for each shape.
#define RIVEN_EACH_SHAPE(INSTANTIATE, Real) \
  INSTANTIATE(Linear, Real) INSTANTIATE(UGimp, Real) INSTANTIATE(BSpline, Real)

}  // namespace riven
