// Elastic laws. A law is a small trivially copyable struct, evaluated for one particle at a time; it keeps the
// Kirchhoff stress over the reference density, tau/rho0 [m^2/s^2], as components xx, yy, xy.
//
// A law offers
//   keeps_F                        whether it needs the deformation gradient, or only its determinant
//   update(G, state)               takes the state through the deformation increment dF = I + G
//   energy(state)                  strain energy per mass, J/kg
//   wave_speed(state)              fastest small wave in the present state, m/s
//   thickness_ratio(J)             F33 for an in-plane area ratio J
//   stress_zz(state)               out-of-plane Kirchhoff stress over reference density
#pragma once
#include <cmath>

#include "core/exec/config.hpp"
#include "core/math/power.hpp"
#include "core/math/tensor.hpp"
#include "core/scene/scene.hpp"

namespace riven {

/// One particle as a law sees it. `J` is the ratio of present to first area; `F` is used by laws that keep it. Both are
/// in double whatever Real is: see Particles.
template <class Real>
struct LawState {
  Mat2<double> F;
  double J;
  Real xx, yy, xy;
};

/// Lame's constants over density, of the solid.
struct Elasticity {
  double lambda, mu;
  double nu;
};
inline Elasticity elasticity(const Material& m) {
  return {m.E * m.nu / ((1 + m.nu) * (1 - 2 * m.nu)) / m.density, m.E / (2 * (1 + m.nu)) / m.density, m.nu};
}

/// Isotropic linear elasticity between co-rotated Kirchhoff stress and logarithmic strain, in rate form:
///   tau <- R (tau + lambda tr(e) I + 2 mu e) R^T,   e = ln dU = E - E^2 / 2 + O(E^3),   E = dU - I,   I + G = R dU,
/// objective for increments of any rotation (Hughes and Winget 1980, with the exact polar decomposition). E alone would
/// take a strain to and fro for a stretch of its square: stresses that creep, and energy that does as dt.
/// In plane stress lambda is replaced by 2 lambda mu / (lambda + 2 mu).
template <class Real>
struct LinearElastic {
  static constexpr bool keeps_F = false;
  Real lambda, mu;  ///< in-plane constants over density
  Real lateral;     ///< -d ln F33 / d ln J: nu / (1 - nu) in plane stress, 0 in plane strain
  Real zz;          ///< tau_zz / (tau_xx + tau_yy): nu in plane strain, 0 in plane stress

  LinearElastic() = default;
  LinearElastic(const Material& m, Plane plane) {
    const Elasticity e = elasticity(m);
    const bool stress = plane == Plane::stress;
    lambda = Real(stress ? 2 * e.lambda * e.mu / (e.lambda + 2 * e.mu) : e.lambda);
    mu = Real(e.mu);
    lateral = Real(stress ? e.nu / (1 - e.nu) : 0);
    zz = Real(stress ? 0 : e.nu);
  }

  RIVEN_INLINE void update(const Mat2<Real>& G, LawState<Real>& p) const {
    const Rotation<Real> R = polar_rotation(G);
    // dU - I, in sums that have no unity in them; dU is symmetric, and its two shears are averaged
    const Real Exx = R.c_minus_1 + R.c * G.xx + R.s * G.yx, Eyy = R.c_minus_1 + R.c * G.yy - R.s * G.xy;
    const Real Exy = Real(0.5) * (R.c * (G.xy + G.yx) + R.s * (G.yy - G.xx));
    const Real half = Real(0.5), exx = Exx - half * (Exx * Exx + Exy * Exy), eyy = Eyy - half * (Eyy * Eyy + Exy * Exy);
    const Real exy = Exy - half * Exy * (Exx + Eyy), tr = lambda * (exx + eyy);
    const Real xx = p.xx + tr + Real(2) * mu * exx, yy = p.yy + tr + Real(2) * mu * eyy, xy = p.xy + Real(2) * mu * exy;
    // R (..) R^T about the mean stress, which does not turn
    const Real mean = Real(0.5) * (xx + yy), dev = Real(0.5) * (xx - yy);
    const Real c2 = R.c * R.c - R.s * R.s, s2 = Real(2) * R.s * R.c;
    const Real turned = c2 * dev - s2 * xy;
    p.xx = mean + turned;
    p.yy = mean - turned;
    p.xy = s2 * dev + c2 * xy;
    p.J += p.J * growth(G);
  }
  RIVEN_INLINE Real energy(const LawState<Real>& p) const {
    const Real tr = (p.xx + p.yy) / (Real(2) * (lambda + mu)), a = Real(1) / (Real(2) * mu);
    const Real exx = a * (p.xx - lambda * tr), eyy = a * (p.yy - lambda * tr), exy = a * p.xy;
    return Real(0.5) * (p.xx * exx + p.yy * eyy) + p.xy * exy;
  }
  /// The law is linear in the logarithmic strain: per present length, stiffness falls and density falls with J.
  RIVEN_INLINE Real wave_speed(const LawState<Real>&) const { return std::sqrt(lambda + Real(2) * mu); }
  RIVEN_INLINE double thickness_ratio(double J) const { return power_near_one(J, double(-lateral)); }
  RIVEN_INLINE Real stress_zz(const LawState<Real>& p) const { return zz * (p.xx + p.yy); }
};

/// The same, keeping the deformation gradient for those who ask for displacement gradients.
template <class Real>
struct LinearElasticF : LinearElastic<Real> {
  static constexpr bool keeps_F = true;
  using LinearElastic<Real>::LinearElastic;

  RIVEN_INLINE void update(const Mat2<Real>& G, LawState<Real>& p) const {
    p.J = det(p.F);
    LinearElastic<Real>::update(G, p);
    p.F = p.F + G * p.F;
  }
};

/// Compressible neo-Hookean solid,
///   W = mu/2 (tr b - 3) - mu ln J + lambda/4 (J^2 - 1) - lambda/2 ln J,
///   tau = mu (b - I) + lambda/2 (J^2 - 1) I                               (Simo and Pister 1984)
/// In plane stress tau_zz = 0 gives F33^2 = (2 mu + lambda) / (2 mu + lambda J2^2), J2 the in-plane determinant.
/// Evaluated in double whatever Real is: stress and energy are small differences of F from unity.
template <class Real>
struct NeoHookean {
  static constexpr bool keeps_F = true;
  double lambda, mu;
  double thinning;  ///< lambda in plane stress, 0 in plane strain (F33 = 1)

  NeoHookean() = default;
  NeoHookean(const Material& m, Plane plane) {
    const Elasticity e = elasticity(m);
    lambda = e.lambda;
    mu = e.mu;
    thinning = plane == Plane::stress ? e.lambda : 0;
  }

  RIVEN_INLINE double thickness_squared(double J2) const { return (2 * mu + thinning) / (2 * mu + thinning * J2 * J2); }
  RIVEN_INLINE void update(const Mat2<Real>& G, LawState<Real>& p) const {
    const Mat2<double> F = p.F + G * p.F;
    p.F = F;
    p.J = det(F);
    const double J2 = p.J * p.J, pressure = 0.5 * lambda * (J2 * thickness_squared(p.J) - 1);
    p.xx = Real(mu * (F.xx * F.xx + F.xy * F.xy - 1) + pressure);
    p.yy = Real(mu * (F.yx * F.yx + F.yy * F.yy - 1) + pressure);
    p.xy = Real(mu * (F.xx * F.yx + F.xy * F.yy));
  }
  RIVEN_INLINE double energy(const LawState<Real>& p) const {
    const double J2 = det(p.F), t = thickness_squared(J2), JJ = J2 * J2 * t, logJ = 0.5 * std::log(JJ);
    const double trace = p.F.xx * p.F.xx + p.F.xy * p.F.xy + p.F.yx * p.F.yx + p.F.yy * p.F.yy + t;
    return 0.5 * mu * (trace - 3) - mu * logJ + 0.25 * lambda * (JJ - 1) - 0.5 * lambda * logJ;
  }
  /// Largest root over all directions n of the acoustic tensor per present density in plane strain,
  ///   mu (n . b n) I + (mu + lambda/2 (J^2 + 1)) n (x) n;
  /// a bound of it in plane stress, where J holds the thickness and a free thickness makes waves slower.
  RIVEN_INLINE double wave_speed(const LawState<Real>& p) const {
    const double bxx = p.F.xx * p.F.xx + p.F.xy * p.F.xy, byy = p.F.yx * p.F.yx + p.F.yy * p.F.yy;
    const double bxy = p.F.xx * p.F.yx + p.F.xy * p.F.yy, half = 0.5 * (bxx - byy);
    const double largest = 0.5 * (bxx + byy) + std::sqrt(half * half + bxy * bxy), J = det(p.F);
    return std::sqrt(0.5 * lambda * (J * J * thickness_squared(J) + 1) + mu * (1 + largest));
  }
  RIVEN_INLINE double thickness_ratio(double J) const { return std::sqrt(thickness_squared(J)); }
  RIVEN_INLINE double stress_zz(const LawState<Real>& p) const {
    const double J = det(p.F), t = thickness_squared(J);
    return mu * (t - 1) + 0.5 * lambda * (J * J * t - 1);
  }
};

/// Bodies of different laws in one scene: both are evaluated and the body's own is kept, which costs both but has no
/// branch.
template <class Real>
struct AnyElastic {
  static constexpr bool keeps_F = true;
  LinearElastic<Real> linear;
  NeoHookean<Real> neo;
  bool is_linear;

  AnyElastic() = default;
  AnyElastic(const Material& m, Plane plane)
      : linear(m, plane), neo(m, plane), is_linear(m.law == LawKind::linear_elastic) {}

  RIVEN_INLINE void update(const Mat2<Real>& G, LawState<Real>& p) const {
    LawState<Real> a = p;
    linear.update(G, a);
    neo.update(G, p);
    p.xx = is_linear ? a.xx : p.xx;
    p.yy = is_linear ? a.yy : p.yy;
    p.xy = is_linear ? a.xy : p.xy;
  }
  RIVEN_INLINE double energy(const LawState<Real>& p) const { return is_linear ? linear.energy(p) : neo.energy(p); }
  RIVEN_INLINE double wave_speed(const LawState<Real>& p) const {
    return is_linear ? linear.wave_speed(p) : neo.wave_speed(p);
  }
  RIVEN_INLINE double thickness_ratio(double J) const {
    return is_linear ? linear.thickness_ratio(J) : neo.thickness_ratio(J);
  }
  RIVEN_INLINE double stress_zz(const LawState<Real>& p) const {
    return is_linear ? linear.stress_zz(p) : neo.stress_zz(p);
  }
};

}  // namespace riven
