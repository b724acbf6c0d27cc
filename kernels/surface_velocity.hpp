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
#pragma once
#include <cmath>

#include "core/math/vec.hpp"

namespace riven {

/// Motion of a node's field, as one point sees it.
struct NodeMotion {
  double weight, wide_weight;  ///< m_i N_i and m_i B_i, kg
  Vec2 offset;                 ///< node - point, m
  Vec2 before, acceleration;   ///< velocity before the forces, m/s, and m/s^2
};

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
  Vec2 operator()(Vec2 d) const {
    const double dp = dot(d, p), dq = dot(d, q);
    return (stretch_p * dp + (shear - spin) * dq) * p + ((shear + spin) * dp + stretch_q * dq) * q;
  }
};

/// L from C, the mean of r r^T, and Q, that of u r^T (its columns), with r the nodes' offsets from x^ and u their
/// velocities less v^. `h`: the cell.
inline FittedGradient fit_gradient(double Cxx, double Cxy, double Cyy, Vec2 Qx, Vec2 Qy, double h) {
  const double lambda = 1e-3 * h * h, mu = 1e-9 * h * h;
  // the direction of half the angle of (difference, Cxy)
  const double middle = 0.5 * (Cxx + Cyy), difference = 0.5 * (Cxx - Cyy);
  const double radius = std::sqrt(difference * difference + Cxy * Cxy);
  const Vec2 near = difference < 0 ? Vec2{Cxy, radius - difference} : Vec2{radius + difference, Cxy};
  const double size = norm(near);
  const Vec2 p = size > 0 ? near * (1 / size) : Vec2{1, 0}, q = turned(p);
  const double Cp = middle + radius, Cq = std::fmax(0.0, middle - radius);
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

/// The motion at the point. `h`: the cell.
inline PointMotion fit_motion(const NodeMotion* node, int count, double h) {
  PointMotion m;
  Vec2 near, wide, velocity;
  double wide_mass = 0;
  for (int i = 0; i < count; ++i) {
    m.mass += node[i].weight;
    m.before += node[i].weight * node[i].before;
    m.acceleration += node[i].weight * node[i].acceleration;
    near += node[i].weight * node[i].offset;
    wide_mass += node[i].wide_weight;
    wide += node[i].wide_weight * node[i].offset;
    velocity += node[i].wide_weight * node[i].before;
  }
  if (!(m.mass > 0))
    return {};
  m.before *= 1 / m.mass;
  m.acceleration *= 1 / m.mass;
  near *= 1 / m.mass;
  wide *= 1 / wide_mass;
  velocity *= 1 / wide_mass;
  double Cxx = 0, Cxy = 0, Cyy = 0;
  Vec2 Qx, Qy;
  for (int i = 0; i < count; ++i) {
    const double w = node[i].wide_weight / wide_mass;
    const Vec2 r = node[i].offset - wide, u = node[i].before - velocity;
    Cxx += w * r.x * r.x;
    Cxy += w * r.x * r.y;
    Cyy += w * r.y * r.y;
    Qx += (w * r.x) * u;
    Qy += (w * r.y) * u;
  }
  const FittedGradient L = fit_gradient(Cxx, Cxy, Cyy, Qx, Qy, h);
  m.before += L(-near);
  m.spin = L.spin;
  return m;
}

}  // namespace riven
