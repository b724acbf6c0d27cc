// Laws of contact between the two faces of a crack, for one pair of velocity fields at one node.
//
// With a the field above and b the field below the crack, n the normal from above to below, t = n turned by +90
// degrees and u = v_a - v_b the velocity of approach and of sliding, a pair exchanges the impulse
//   on a: -(lambda n + tau t),   on b: +(lambda n + tau t),     lambda > 0 pressing the faces apart.
// Momentum is kept whatever lambda and tau are. With m = m_a m_b / (m_a + m_b), u^ the velocity that the pair would
// have without its own impulse, and g >= 0 the gap between the faces:
//
//   frictionless  0 <= lambda,  u_n <= g/dt,  lambda (g/dt - u_n) = 0;   tau = 0
//   Coulomb       the same, and tau = m u^_t brought within [-mu lambda, mu lambda]
//   stick         u = 0 if the fields approach each other and the gap is closed (eq. 13)
//   bonded        u = 0 always
//   interface     tractions D_n delta_n, D_t delta_t over the contact area, below
//
// Source: J.A. Nairn, CMES 4 (2003) 649-663, eqs. 13-18. There u_n = 0 ends every contact; its eq. 17 carries the sign
// of p_b - p_a and its eq. 19 lacks one of the masses, so both were derived anew from eqs. 14-16. That faces may still
// approach at g/dt, and so close in this step instead of stopping short of each other, is the condition of J.J. Moreau
// (unilateral contact on velocities) with the displacement check of J.A. Nairn, CMES 92 (2013) 271-299. The relative
// motion loses kinetic energy in every case: the normal part ends between its value and 0, friction opposes sliding.
// Stick is no limit of Coulomb (with mu infinite a node may have several solutions); it waits until the gap is closed,
// because faces that it stopped short of each other would creep together.
//
// Interface (Nairn, CMES 92 (2013) 271-299): T_i = D_i delta_i pulls the faces together, delta the jump of displacement
// (below minus above). Along each direction the two masses are an oscillator of w^2 = A D / m. It is integrated exactly
// over the step from u0, the velocity before the step's forces, and delta; the other forces being steady,
//   u1 = cos(phi) u0 + phi sin(phi) delta/dt + sin(phi)/phi (u^ - u0),   phi = w dt.
// Beyond a quarter period a step cannot follow the oscillation. There phi in the rotation about the rest point is held
// at pi/2 while the rest point keeps the true stiffness; written for both,
//   u1 = cos(p) u0 + p sin(p) (delta/dt + (u^ - u0)/phi^2),   p = min(phi, pi/2).
// So D = 0 gives u1 = u^ (free) and D -> infinity with delta = 0 gives u1 = 0 (bonded), and the map of (delta, u) over
// a step has no eigenvalue outside the unit circle for any D, whether delta moves with u1 or with (u0 + u1)/2.
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/math/vec.hpp"
#include "core/scene/scene.hpp"

namespace riven {

/// A linear relation between a pair's final velocity along one direction and the velocity u^ that it would have
/// without its own impulse: u1 = give u^ + bias. give = 1, bias = 0: no impulse; give = 0: u1 = bias.
struct PairResponse {
  double give = 1;
  double bias = 0;  ///< m/s
};

/// What friction bears along faces, over what presses them together: tau / lambda within [-back, forward].
struct FrictionBounds {
  double back = 0, forward = 0;

  RIVEN_INLINE bool none() const { return back == 0 && forward == 0; }
  /// As much of tau as it bears.
  RIVEN_INLINE double within(double tau, double lambda) const {
    const double a = -back * lambda, b = forward * lambda;
    return std::clamp(tau, std::min(a, b), std::max(a, b));
  }
};

/// One pair of fields in contact. `below` and `above` number the fields of a node.
struct ContactPair {
  int above = 0, below = 0;
  Vec2 normal;                 ///< unit length, from above to below
  PairResponse across, along;  ///< along the normal and the tangent
  bool unilateral = false;     ///< the normal impulse may only press
  bool frictional = false;     ///< the tangential impulse is bounded by friction times the normal one
  FrictionBounds friction{};
};

/// Two fields that stick as soon as they approach each other.
struct StickingPair {
  int above = 0, below = 0;
  Vec2 normal;
};

/// Which of two laws holds its faces together more strictly; used where two cracks lie between two fields.
RIVEN_INLINE int strictness(ContactLaw law) {
  switch (law) {
    case ContactLaw::ignored: return 0;
    case ContactLaw::interface: return 1;
    case ContactLaw::frictionless: return 2;
    case ContactLaw::coulomb: return 3;
    case ContactLaw::stick: return 4;
    case ContactLaw::bonded: return 5;
  }
  return 0;
}

/// Coefficient of friction that faces bear.
RIVEN_INLINE double friction_of(const ContactSettings& s) {
  return s.law == ContactLaw::coulomb ? s.friction : 0;
}

/// May faces of this law part, but not overlap?
inline bool keeps_apart(ContactLaw law) {
  return law == ContactLaw::frictionless || law == ContactLaw::coulomb || law == ContactLaw::stick;
}

/// Does this law let faces bear tension?
inline bool holds_together(ContactLaw law) {
  return law == ContactLaw::bonded || law == ContactLaw::interface;
}

/// True if `a` is stricter than `b`; among equals the greater friction or stiffness decides.
RIVEN_INLINE bool stricter(const ContactSettings& a, const ContactSettings& b) {
  const int sa = strictness(a.law), sb = strictness(b.law);
  if (sa != sb)
    return sa > sb;
  if (a.law == ContactLaw::coulomb)
    return a.friction > b.friction;
  return a.law == ContactLaw::interface &&
         std::max(a.normal_stiffness, a.shear_stiffness) > std::max(b.normal_stiffness, b.shear_stiffness);
}

/// A frictionless or Coulomb pair. `gap` in m counts as closed when it is negative; with `held` the faces are known to
/// be pressed together and the normal impulse may have either sign (volume detection, V_rel > V_contact).
RIVEN_INLINE ContactPair touching_pair(const ContactSettings& s, int above, int below, Vec2 normal, double gap,
                                       double dt, bool held) {
  const double closing = held ? 0 : std::max(gap, 0.) / dt;
  const double mu = friction_of(s);
  return {above, below, normal, {0, closing}, {0, 0}, !held, true, {mu, mu}};
}

/// phi^2 = A D dt^2 / m, from which on the interface is too stiff for the step to follow its oscillation.
inline constexpr double stiff_phase2 = std::numbers::pi * std::numbers::pi / 4;

/// An interface over one step along one direction: phase2 = A D dt^2 / m, u0 the velocity of approach before the step's
/// forces (m/s), delta the opening of the faces (m).
RIVEN_INLINE PairResponse interface_response(double phase2, double u0, double delta, double dt) {
  if (phase2 <= 0)
    return {};
  const double p = std::sqrt(phase2 < stiff_phase2 ? phase2 : stiff_phase2), c = std::cos(p), ps = p * std::sin(p);
  return {ps / phase2, (c - ps / phase2) * u0 + ps * delta / dt};
}

/// An interface where velocities are made again without forces acting between (before the forces, and after a second
/// extrapolation): one that is too stiff to be followed keeps its faces together, another leaves them alone.
RIVEN_INLINE PairResponse interface_hold(double phase2) {
  return phase2 >= stiff_phase2 ? PairResponse{0, 0} : PairResponse{};
}

/// The impulse that a pair needs along one direction, given the velocity it would have without (kg m/s).
RIVEN_INLINE double response_impulse(const PairResponse& r, double reduced_mass, double free_velocity) {
  return reduced_mass * ((1 - r.give) * free_velocity - r.bias);
}

struct PairImpulse {
  double lambda, tau;
};

/// The impulse of a pair, given the velocities of approach and of sliding that it would have without, and the masses of
/// these motions; all across (x) and along (y).
RIVEN_INLINE PairImpulse pair_impulse(const ContactPair& p, Vec2 reduced_mass, Vec2 velocity) {
  double lambda = response_impulse(p.across, reduced_mass.x, velocity.x);
  if (p.unilateral)
    lambda = std::max(0., lambda);
  double tau = response_impulse(p.along, reduced_mass.y, velocity.y);
  return {lambda, p.frictional ? p.friction.within(tau, lambda) : tau};
}

}  // namespace riven
