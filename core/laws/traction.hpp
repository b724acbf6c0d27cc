// Laws of tractions between the two faces of a crack, for one point of it.
//
// With n the normal towards above and t the direction of the crack, an opening (delta_n, delta_t) = (u_upper - u_lower)
// of the faces makes the traction (T_n, T_t), positive where it pulls the faces together: the upper face bears
// -(T_n n + T_t t), the lower one +(T_n n + T_t t) (Nairn and Aimene, eq. 8). A pressure P is T_n = -P, T_t = 0,
// whatever the opening.
//
// A cohesive law is elastic with damage. Both modes soften along one curve f of an effective opening,
//   lambda^2 = (<delta_n>/c_n)^2 + (delta_t/c_t)^2,   T_n = s_n k(w) <delta_n>/c_n,   T_t = s_t k(w) delta_t/c_t,
// with s the strengths, c the critical openings, w the greatest lambda so far and k(w) = f(max(w, p)) / max(w, p); f
// rises linearly to 1 at the peak p and falls to 0 at 1. So k is the part of the first stiffness 1/p that damage has
// left, alike in both modes; unloading and loading again run along the straight line through the origin. The stored
// energy is W_Z = (T_n delta_n + T_t delta_t)/2. Damage takes
//   dOmega = -(s_n <delta_n>^2/c_n + s_t delta_t^2/c_t)/2 dk = (G_I a_n + G_II a_t) dg/g(1),   a_n + a_t = 1,
//   g(w) = int_0^w f - w f(w)/2,   a_n = (<delta_n>/c_n)^2/lambda^2,   G = s c g(1),
// which is never negative. Each mode alone dissipates its own toughness G, and along any path the dissipated parts obey
// Omega_I/G_I + Omega_II/G_II = 1 when nothing is left. Faces pressed together bear no cohesive T_n and take no damage
// from that: contact holds them apart.
//
// Source: one damage variable with strengths and toughnesses of each mode is the law of J.A. Nairn and Y.E. Aimene,
// Eng. Fract. Mech. 248 (2021) 107704, where damage begins and goes on when (T_n/S_n)^2 + (T_t/S_t)^2 = 1, with S the
// strengths that the damage has left. With one curve for both modes that ellipse is lambda = w.
#pragma once
#include <algorithm>
#include <cmath>

#include "core/exec/config.hpp"
#include "core/scene/scene.hpp"

namespace riven {

/// Opening (m) or traction (Pa) in a crack's own directions.
struct FacePair {
  double normal = 0, sliding = 0;
};

struct Pressure {
  double value = 0;  ///< Pa

  RIVEN_INLINE FacePair traction() const { return {-value, 0}; }
  /// Potential of the load over the area, J/m^2: int T . d delta at this pressure.
  RIVEN_INLINE double stored(FacePair opening) const { return -value * opening.normal; }
};

/// Traction over the strength as a function of the opening over the critical one.
struct SofteningCurve {
  TractionKind kind = TractionKind::triangular;
  double peak = 0;                     ///< where the traction is 1
  double knee = 0, knee_strength = 0;  ///< trilinear
  double decay = 0;                    ///< exponential

  RIVEN_INLINE double traction(double x) const {
    if (x <= peak)
      return x / peak;
    if (x >= 1)
      return 0;
    switch (kind) {
      case TractionKind::trilinear:
        return x < knee ? 1 - (1 - knee_strength) * (x - peak) / (knee - peak) : knee_strength * (1 - x) / (1 - knee);
      case TractionKind::exponential: {
        const double end = std::exp(-decay);
        return (std::exp(-decay * (x - peak) / (1 - peak)) - end) / (1 - end);
      }
      default: return (1 - x) / (1 - peak);
    }
  }
  /// int_0^x of the traction.
  RIVEN_INLINE double work(double x) const {
    if (x <= peak)
      return 0.5 * x * x / peak;
    x = std::min(x, 1.);
    const double f = traction(x), past = 0.5 * peak;
    switch (kind) {
      case TractionKind::trilinear: {
        const double first = std::min(x, knee);
        const double descent = 0.5 * (first - peak) * (1 + traction(first));
        return past + descent + (x > knee ? 0.5 * (x - knee) * (knee_strength + f) : 0);
      }
      case TractionKind::exponential: {
        const double end = std::exp(-decay), length = 1 - peak, y = (x - peak) / length;
        return past + length * ((1 - std::exp(-decay * y)) / decay - end * y) / (1 - end);
      }
      default: return past + 0.5 * (x - peak) * (1 + f);
    }
  }
  /// The part of the work that damage has taken, g in the header.
  RIVEN_INLINE double lost(double x) const { return x <= peak ? 0 : work(x) - 0.5 * std::min(x, 1.) * traction(x); }
};

/// What damage remembers at a point of a crack.
struct CohesiveHistory {
  double worst = 0;       ///< greatest effective opening so far; from 1 on nothing is left
  double dissipated = 0;  ///< J/m^2
};

struct Cohesive {
  SofteningCurve curve;
  FacePair strength, toughness, critical;  ///< Pa, J/m^2, m

  Cohesive() = default;
  explicit Cohesive(const TractionSettings& s)
      : curve{s.kind, s.peak, s.knee, s.knee_strength, s.decay},
        strength{s.strength, s.shear_strength > 0 ? s.shear_strength : s.strength},
        toughness{s.toughness, s.shear_toughness > 0 ? s.shear_toughness : s.toughness} {
    const double area = curve.work(1);
    critical = {toughness.normal / (strength.normal * area), toughness.sliding / (strength.sliding * area)};
  }

  RIVEN_INLINE double effective(FacePair opening) const {
    const double n = std::max(opening.normal, 0.) / critical.normal, t = opening.sliding / critical.sliding;
    return std::sqrt(n * n + t * t);
  }
  RIVEN_INLINE FacePair traction(FacePair opening, const CohesiveHistory& h) const {
    const double at = std::max({h.worst, effective(opening), curve.peak}), k = curve.traction(at) / at;
    return {k * strength.normal * std::max(opening.normal, 0.) / critical.normal,
            k * strength.sliding * opening.sliding / critical.sliding};
  }
  /// W_Z, J/m^2.
  RIVEN_INLINE double stored(FacePair opening, const CohesiveHistory& h) const {
    const FacePair T = traction(opening, h);
    return 0.5 * (T.normal * opening.normal + T.sliding * opening.sliding);
  }
  /// Brings the history up to an opening; gives what damage took meanwhile, J/m^2.
  RIVEN_INLINE double damage(FacePair opening, CohesiveHistory& h) const {
    const double before = h.worst, now = effective(opening);
    if (now <= before)
      return 0;
    h.worst = now;
    const double n = std::max(opening.normal, 0.) / critical.normal / now;
    const double toughness_now = toughness.normal * n * n + toughness.sliding * (1 - n * n);
    const double taken = toughness_now * (curve.lost(now) - curve.lost(before)) / curve.work(1);
    h.dissipated += taken;
    return taken;
  }
  /// Pa/m, of the stiffer direction, before any damage.
  RIVEN_INLINE double stiffness() const {
    return std::max(strength.normal / critical.normal, strength.sliding / critical.sliding) / curve.peak;
  }
};

/// The law of one crack.
struct TractionLaw {
  enum class Kind { none, pressure, cohesive } kind = Kind::none;
  Pressure pressure;  ///< of this step
  Cohesive cohesive;

  TractionLaw() = default;
  explicit TractionLaw(const TractionSettings& s)
      : kind(s.kind == TractionKind::pressure ? Kind::pressure : Kind::cohesive) {
    if (kind == Kind::cohesive)
      cohesive = Cohesive(s);
  }

  RIVEN_INLINE FacePair traction(FacePair opening, const CohesiveHistory& h) const {
    return kind == Kind::pressure   ? pressure.traction()
           : kind == Kind::cohesive ? cohesive.traction(opening, h)
                                    : FacePair{};
  }
  RIVEN_INLINE double stored(FacePair opening, const CohesiveHistory& h) const {
    return kind == Kind::pressure ? pressure.stored(opening) : kind == Kind::cohesive ? cohesive.stored(opening, h) : 0;
  }
};

}  // namespace riven
