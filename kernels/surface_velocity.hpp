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
// x^ and v^ being the means with these weights. A rigid motion is met exactly, and so is a homogeneous one. B_i is the
// quadratic B-spline, whose nodes are spread by half a cell in every direction wherever the point lies, so that L is
// smooth in x_s; lambda keeps what nodes in one row cannot tell, stretching across the row, out of L, and mu << lambda
// all where there is a single node. v is the velocity before the forces, an average of the particles' that is sound
// even where m is tiny; the acceleration f/m is not, and remains mass-weighted.
//
// A force F on the surface goes to the nodes by the transposed of v(x_s), so that the nodes do with it the work that
// the surface does: with d = x_s - x*, F . L d = sum W_i (G r_i) . v_i, where G is the gradient of the same fit to F
// d^T, and
//   f_i = m_i N_i / (sum m N) F + W_i / (sum W) G (x_i - x^).
// The second part adds up to nothing but the moment of F about x*.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/math/quad.hpp"
#include "core/math/vec.hpp"

namespace riven {

struct PointMotion {
  double mass = 0;  ///< 0 where no mass was found
  Vec2 before;      ///< velocity before the forces, m/s
  Vec2 acceleration;
  double spin = 0;  ///< rad/s
  Vec2 after(double dt) const { return before + dt * acceleration; }
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
  const double lambda = 1e-3 * h * h, mu = 1e-9 * h * h;
  // the direction of half the angle of (difference, Cxy)
  const double middle = 0.5 * (Cxx + Cyy), difference = 0.5 * (Cxx - Cyy);
  const double radius = std::sqrt(difference * difference + Cxy * Cxy);
  const Vec2 near = difference < 0 ? Vec2{Cxy, radius - difference} : Vec2{radius + difference, Cxy};
  const double size = norm(near);
  const Vec2 p = size > 0 ? near * (1 / size) : Vec2{1, 0}, q = turned(p);
  const double Cp = middle + radius, Cq = std::max(0.0, middle - radius);
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
  int base;  ///< the first
  double r[width], near[width], wide[width];
};

/// Sums along one row of nodes, m being masses and q [vx vy ax ay] after the forces.
struct RowSums {
  Quad<double> near_q{}, wide_q{}, r_q{};  ///< m N q, m B q, m B rx q
  Quad<double> mass{};                     ///< m B [1 rx rx^2 .], [. . . m N]
  double near_r = 0;                       ///< m N rx

  RIVEN_INLINE void add(double m, const Quad<double>& q, const AxisWeights& x, int i) {
    const double N = x.near[i], B = x.wide[i], Br = B * x.r[i];
    const Quad<double> mq = m * q;
    near_q += N * mq;
    wide_q += B * mq;
    r_q += Br * mq;
    mass += m * Quad<double>{B, Br, Br * x.r[i], N};
    near_r += m * N * x.r[i];
  }
};

/// Sums over all rows.
struct MotionSums {
  Quad<double> near_q{}, wide_q{}, rx_q{}, ry_q{};  ///< m N q, m B q, m B rx q, m B ry q
  Quad<double> wide{}, wide_ry{}, wide_ry2{};       ///< m B [1 rx rx^2 .], m B ry [1 rx . .], m B ry^2 [1 . . .]
  Quad<double> near{}, near_ry{};                   ///< m N [. . . 1], m N ry [. . . 1]
  double near_rx = 0;

  RIVEN_INLINE void add(const RowSums& row, const AxisWeights& y, int j) {
    const double N = y.near[j], B = y.wide[j], r = y.r[j];
    near_q += N * row.near_q;
    wide_q += B * row.wide_q;
    rx_q += B * row.r_q;
    ry_q += (B * r) * row.wide_q;
    wide += B * row.mass;
    wide_ry += (B * r) * row.mass;
    wide_ry2 += (B * r * r) * row.mass;
    near += N * row.mass;
    near_ry += (N * r) * row.mass;
    near_rx += N * row.near_r;
  }
};

/// What a fit needs of them, v being the velocity before the forces.
struct SurfaceSums {
  double near, near_rx, near_ry;                                   ///< m N [1 rx ry]
  double wide, wide_rx, wide_ry, wide_rxrx, wide_rxry, wide_ryry;  ///< m B [1 rx ry rx^2 rx ry ry^2]
  Vec2 near_a;                                                     ///< m N a
  Vec2 near_v, wide_v, rx_v, ry_v;                                 ///< m N v, m B v, m B rx v, m B ry v
};

RIVEN_INLINE SurfaceSums surface_sums(const MotionSums& s, double dt) {
  const auto before = [dt](const Quad<double>& q) { return Vec2{q[0] - dt * q[2], q[1] - dt * q[3]}; };
  return {s.near[3],        s.near_rx,        s.near_ry[3],   s.wide[0],     s.wide[1],
          s.wide_ry[0],     s.wide[2],        s.wide_ry[1],   s.wide_ry2[0], {s.near_q[2], s.near_q[3]},
          before(s.near_q), before(s.wide_q), before(s.rx_q), before(s.ry_q)};
}

/// How the mass lies around a point.
struct MassAround {
  double near, wide;     ///< 1 / sum m N and 1 / sum m B
  Vec2 arm, centre;      ///< x_s - x* and x^ - x_s
  double Cxx, Cxy, Cyy;  ///< mean of (x - x^) (x - x^)^T

  explicit RIVEN_INLINE MassAround(SurfaceSums s)
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

  TurningForce(const MassAround& mass, Vec2 F, double h)
      : wide(mass.wide), centre(mass.centre), G(mass.fit(mass.arm.x * F, mass.arm.y * F, h)) {}
  /// On the node of mass m at r from the point, whose weight is B.
  Vec2 on(double m, double B, Vec2 r) const { return (m * wide * B) * G(r - centre); }
};

/// The motion at the point, zeros where there is no mass; without branches. `h`: the cell.
RIVEN_INLINE PointMotion fit_motion(SurfaceSums s, double h) {
  const MassAround mass(s);
  const Vec2 r = mass.centre, v = mass.wide * s.wide_v;
  const FittedGradient L = mass.fit(mass.wide * s.rx_v - r.x * v, mass.wide * s.ry_v - r.y * v, h);
  const Vec2 before = mass.near * s.near_v + L(mass.arm);
  const bool some = s.near > 0;
  const auto kept = [some](double value) RIVEN_LANE { return some ? value : 0.; };
  return {kept(s.near),
          {kept(before.x), kept(before.y)},
          {kept(mass.near * s.near_a.x), kept(mass.near * s.near_a.y)},
          kept(L.spin)};
}

/// The motions of several surfaces, side by side; those of a point follow each other.
struct alignas(64) MotionLanes {
  static constexpr int lanes = 16, numbers = 6;
  double value[numbers][lanes];

  PointMotion motion(int lane) const {
    const auto at = [&](int n) { return value[n][lane]; };
    return {at(0), {at(1), at(2)}, {at(3), at(4)}, at(5)};
  }
};

/// Their sums.
struct alignas(64) SurfaceSumLanes {
  static constexpr int lanes = MotionLanes::lanes;
  static constexpr int numbers = sizeof(SurfaceSums) / sizeof(double);
  double value[numbers][lanes] = {};

  void put(int lane, const SurfaceSums& s) {
    double number[numbers];
    std::memcpy(number, &s, sizeof(number));
    for (int n = 0; n < numbers; ++n)
      value[n][lane] = number[n];
  }

  /// The motions that fit them; zeros where nothing was put.
  void fit(double h, MotionLanes& to) const {
#pragma omp simd
    for (int k = 0; k < lanes; ++k) {
      const auto at = [&, k](int n) RIVEN_LANE { return value[n][k]; };
      const auto pair = [&](int n) RIVEN_LANE { return Vec2{at(n), at(n + 1)}; };
      const PointMotion m = fit_motion({at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7), at(8), pair(9),
                                        pair(11), pair(13), pair(15), pair(17)},
                                       h);
      to.value[0][k] = m.mass;
      to.value[1][k] = m.before.x;
      to.value[2][k] = m.before.y;
      to.value[3][k] = m.acceleration.x;
      to.value[4][k] = m.acceleration.y;
      to.value[5][k] = m.spin;
    }
  }
};

}  // namespace riven
