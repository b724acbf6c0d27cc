// Velocity and acceleration at a point from the nodes around it, which may have very different masses.
//
// Mass-weighted, renormalised functions (Nairn et al., eqs. 4-6) are not led astray by nodes that the body barely
// reaches. But on one side of a crack nearly all mass is on the nodes away from it, and what they give is the motion of
//   x* = sum m_i N_i x_i / sum m_i N_i,
// up to 0.4 cells inside the body. Surfaces moved by it slide over each other by 0.8 cells for each radian that the
// body turns, and draw apart or overlap by 0.8 cells times the strain. So the motion is carried on from x* to the
// point,
//   v(x_s) = v* + L (x_s - x*),    v* = sum m_i N_i v_i / sum m_i N_i,
// by the gradient of the linear field that fits the nodes around best,
//   sum W_i (|v_i - v^ - L (x_i - x^)|^2 + lambda |sym L|^2 + mu |skew L|^2) -> min,    W_i = m_i B_i,
// x^ and v^ being the means with these weights. A rigid motion is met exactly, and so is a homogeneous one but for
// lambda. B_i is the quadratic B-spline, whose nodes are spread by half a cell in every direction wherever the point
// lies, so that L is smooth in x_s; lambda keeps what nodes in one row cannot tell, stretching across the row, out of
// L, and mu << lambda all where there is a single node. v is the velocity before the forces, an average of the
// particles' that is sound even where m is tiny; the acceleration f/m is not, and remains mass-weighted. Where a force
// goes by how far faces have opened, as that of a cohesive law, these must open by what the force does to v(x_s): v is
// then fitted before and after. With c a of the velocity that they gain by a, c < 1, an opening of frequency w swings
// ever further, by a factor of 1 + (1 - c) (w dt)^4 / 2 or so in a step.
//
// A force F on the surface goes to the nodes by the transposed of v(x_s), so that the nodes do with it the work that
// the surface does: with d = x_s - x*, F . L d = sum W_i (G r_i) . v_i, where G is the gradient of the same fit to F
// d^T, and
//   f_i = m_i N_i / (sum m N) F + W_i / (sum W) G (x_i - x^).
// The second part adds up to nothing but the moment of F about x*. It sets a node in motion by B_i / (sum W) G r_i,
// whatever little mass that has. So lambda grows where all mass but a small part of it lies in one row, whose spread
// across the row, Cq, is small:
//   lambda = least + (thin h^2)^2 / (Cq + least),   least = 1e-3 h^2,   thin = 0.01,
// and no node is hurled off by more than 1 / (2 thin) times what F does to the mass around. By `least` alone a corner
// that draws away from a pressed face takes up as much work as all the faces do.
#pragma once
#include <algorithm>
#include <cmath>

#include "core/math/vec.hpp"

namespace riven {

struct PointMotion {
  double mass = 0;  ///< 0 where no mass was found
  Vec2 before;      ///< velocity before the forces, m/s
  Vec2 acceleration;
  double spin = 0;  ///< rad/s
  RIVEN_INLINE Vec2 after(double dt) const { return before + dt * acceleration; }
};

/// The gradient L of a fit in the principal directions p, q of C.
struct FittedGradient {
  Vec2 p, q;
  double stretch_p, stretch_q, shear, spin;
  RIVEN_INLINE Vec2 operator()(Vec2 d) const {
    const double dp = dot(d, p), dq = dot(d, q);
    return (stretch_p * dp + (shear - spin) * dq) * p + ((shear + spin) * dp + stretch_q * dq) * q;
  }
};

/// L from C, the mean of r r^T, and Q, that of u r^T (its columns), with r the nodes' offsets from x^ and u their
/// velocities less v^. `h`: the cell.
RIVEN_INLINE FittedGradient fit_gradient(double Cxx, double Cxy, double Cyy, Vec2 Qx, Vec2 Qy, double h) {
  constexpr double thin = 0.01;
  const double area = h * h, mu = 1e-9 * area;
  // the direction of half the angle of (difference, Cxy)
  const double middle = 0.5 * (Cxx + Cyy), difference = 0.5 * (Cxx - Cyy);
  const double radius = std::sqrt(difference * difference + Cxy * Cxy);
  const Vec2 near = difference < 0 ? Vec2{Cxy, radius - difference} : Vec2{radius + difference, Cxy};
  const double size = norm(near);
  const Vec2 p = size > 0 ? near * (1 / size) : Vec2{1, 0}, q = turned(p);
  const double Cp = middle + radius, Cq = std::max(0.0, middle - radius);
  const double least = 1e-3 * area, lambda = least + thin * thin * area * area / (Cq + least);
  const Vec2 Qp = p.x * Qx + p.y * Qy, Qq = q.x * Qx + q.y * Qy;
  // shear g and spin w:  (Cp + Cq + 2 lambda) g + (Cp - Cq) w = S,  (Cp - Cq) g + (Cp + Cq + 2 mu) w = A
  const double spread = Cp + Cq, uneven = Cp - Cq, S = dot(Qq, p) + dot(Qp, q), A = dot(Qp, q) - dot(Qq, p);
  const double det = 4 * Cp * Cq + 2 * (lambda + mu) * spread + 4 * lambda * mu;
  return {p,
          q,
          dot(Qp, p) / (Cp + lambda),
          dot(Qq, q) / (Cq + lambda),
          (S * (spread + 2 * mu) - A * uneven) / det,
          (A * (spread + 2 * lambda) - S * uneven) / det};
}

/// Nodes around a point along one axis: their distances r from it and their weights N and B.
struct AxisWeights {
  static constexpr int width = 3;
  double r[width], near[width], wide[width];
};

/// Sums over the nodes around a point of what a fit needs: m masses, r offsets from the point, v velocities before the
/// forces, a accelerations.
struct SurfaceSums {
  double near = 0, near_rx = 0, near_ry = 0;                  ///< m N [1 rx ry]
  double wide = 0, wide_rx = 0, wide_ry = 0;                  ///< m B [1 rx ry]
  double wide_rxrx = 0, wide_rxry = 0, wide_ryry = 0;         ///< m B [rx^2 rx ry ry^2]
  double near_ax = 0, near_ay = 0, near_vx = 0, near_vy = 0;  ///< m N a, m N v
  double wide_vx = 0, wide_vy = 0;                            ///< m B v
  double rx_vx = 0, rx_vy = 0, ry_vx = 0, ry_vy = 0;          ///< m B rx v, m B ry v

  RIVEN_INLINE void add(double mN, double mB, double rx, double ry, Vec2 v, Vec2 a) {
    const double Bx = mB * rx, By = mB * ry;
    near += mN;
    near_rx += mN * rx;
    near_ry += mN * ry;
    wide += mB;
    wide_rx += Bx;
    wide_ry += By;
    wide_rxrx += Bx * rx;
    wide_rxry += Bx * ry;
    wide_ryry += By * ry;
    near_ax += mN * a.x;
    near_ay += mN * a.y;
    near_vx += mN * v.x;
    near_vy += mN * v.y;
    wide_vx += mB * v.x;
    wide_vy += mB * v.y;
    rx_vx += Bx * v.x;
    rx_vy += Bx * v.y;
    ry_vx += By * v.x;
    ry_vy += By * v.y;
  }
};

/// How the mass lies around a point.
struct MassAround {
  double near, wide;     ///< 1 / sum m N and 1 / sum m B
  Vec2 arm, centre;      ///< x_s - x* and x^ - x_s
  double Cxx, Cxy, Cyy;  ///< mean of (x - x^) (x - x^)^T

  explicit RIVEN_INLINE MassAround(const SurfaceSums& s)
      : near(1 / s.near),
        wide(1 / s.wide),
        arm(-near * Vec2{s.near_rx, s.near_ry}),
        centre{wide * s.wide_rx, wide * s.wide_ry},
        Cxx(wide * s.wide_rxrx - centre.x * centre.x),
        Cxy(wide * s.wide_rxry - centre.x * centre.y),
        Cyy(wide * s.wide_ryry - centre.y * centre.y) {}

  RIVEN_INLINE FittedGradient fit(Vec2 Qx, Vec2 Qy, double h) const { return fit_gradient(Cxx, Cxy, Cyy, Qx, Qy, h); }
};

/// The second part of a force on a surface. `h`: the cell.
struct TurningForce {
  double wide;
  Vec2 centre;
  FittedGradient G;

  RIVEN_INLINE TurningForce(const MassAround& mass, Vec2 F, double h)
      : wide(mass.wide), centre(mass.centre), G(mass.fit(mass.arm.x * F, mass.arm.y * F, h)) {}
  /// On the node of mass m at r from the point, whose weight is B.
  RIVEN_INLINE Vec2 on(double m, double B, Vec2 r) const { return (m * wide * B) * G(r - centre); }
};

/// The motion at the point, zeros where there is no mass; without branches. `h`: the cell.
RIVEN_INLINE PointMotion fit_motion(const SurfaceSums& s, double h) {
  const MassAround mass(s);
  const Vec2 r = mass.centre, v = mass.wide * Vec2{s.wide_vx, s.wide_vy};
  const FittedGradient L =
      mass.fit(mass.wide * Vec2{s.rx_vx, s.rx_vy} - r.x * v, mass.wide * Vec2{s.ry_vx, s.ry_vy} - r.y * v, h);
  const Vec2 before = mass.near * Vec2{s.near_vx, s.near_vy} + L(mass.arm);
  const bool some = s.near > 0;
  const auto kept = [some](double value) RIVEN_LANE { return some ? value : 0.; };
  return {kept(s.near),
          {kept(before.x), kept(before.y)},
          {kept(mass.near * s.near_ax), kept(mass.near * s.near_ay)},
          kept(L.spin)};
}

inline namespace RIVEN_SIDE {

/// Several surfaces side by side, those of a point following each other, and the nodes around them, row by row, as each
/// surface sees them.
template <class Real>
struct alignas(exec::line) SurfaceLanes {
  static constexpr int lanes = exec::lanes > 1 ? 16 : 2, nodes = AxisWeights::width * AxisWeights::width;
  double x[lanes], y[lanes];
  Real mass[nodes][lanes];
  Real q[nodes][lanes][4];  ///< [vx vy ax ay]
};

/// Their motions.
struct alignas(exec::line) MotionLanes {
  static constexpr int lanes = SurfaceLanes<double>::lanes, numbers = 6;
  double value[numbers][lanes];

  RIVEN_INLINE PointMotion motion(int lane) const {
    const auto at = [&](int n) { return value[n][lane]; };
    return {at(0), {at(1), at(2)}, {at(3), at(4)}, at(5)};
  }
  RIVEN_INLINE void put(int lane, const PointMotion& m) {
    value[0][lane] = m.mass;
    value[1][lane] = m.before.x;
    value[2][lane] = m.before.y;
    value[3][lane] = m.acceleration.x;
    value[4][lane] = m.acceleration.y;
    value[5][lane] = m.spin;
  }
};

}  // namespace RIVEN_SIDE

}  // namespace riven
