// Fields whose motion is prescribed, as contact meets them: nothing that pushes on them moves them, so that in those
// components they have no 1/m, and all of a relative velocity is the other field's to lose. What they so resist comes
// from who prescribes their motion, and is part of its reaction.
//
// With W = 1/m_a + 1/m_b of each component that is free, impulses lambda n + tau t across and along a pair change its
// relative velocity by
//   u_n -= (n.W n) lambda + (n.W t) tau,   u_t -= (n.W t) lambda + (t.W t) tau.
#pragma once
#include <algorithm>
#include <cmath>
#include <utility>

#include "kernels/contact_meetings.hpp"
#include "kernels/field_impulses.hpp"
#include "kernels/field_motion.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// How firm a prescribed field stands, from 0 to 1: one that reaches a node with next to none of its mass is no wall
/// there, a cell ahead of where its matter ends.
RIVEN_INLINE double firmness(double mass, double of_node) {
  constexpr double none = 0.02, all = 0.1;
  return std::clamp((mass / of_node - none) / (all - none), 0., 1.);
}

struct PrescribedFields {
  const std::uint8_t* mask;  ///< ContactSums::prescribed; null where no motion is prescribed beside cracks
  Vec2* resisted;            ///< ContactSums
  double early_impulse;      ///< ContactSums

  RIVEN_INLINE unsigned of(long slot) const { return mask ? mask[slot] : 0; }
  /// Is the motion of both fields prescribed along the normal? Then they meet as who prescribes it has it.
  RIVEN_INLINE bool both_given(const long* slot, const Meeting& m) const {
    constexpr double along = 0.35;  // 20 degrees
    const unsigned both = of(slot[m.above]) & of(slot[m.below]);
    const double x = std::abs(m.normal.x), y = std::abs(m.normal.y);
    return both == 3 || (both == 1 && y < along * x) || (both == 2 && x < along * y);
  }
  /// W of two fields, of each component.
  RIVEN_INLINE Vec2 yielding(const long* slot, const double* mass) const {
    Vec2 w;
    for (int f = 0; f < 2; ++f) {
      const unsigned held = of(slot[f]);
      const double gives = 1 - firmness(mass[f], mass[0] + mass[1]);
      w += (1 / mass[f]) * Vec2{held & 1u ? gives : 1., held & 2u ? gives : 1.};
    }
    return w;
  }

  /// Gives an impulse to a field; `velocity`: what it makes of the field where that is free.
  template <class Real, ContactStage stage>
  RIVEN_INLINE void give(const FieldMotion<Real, stage>& motion, const ImpulseNotes& notes, long index,
                         const NodeCracks& n, long slot, Vec2 impulse, Vec2 velocity, double dt) const {
    if (const unsigned held = of(slot)) {
      const Vec2 kept{held & 1u ? impulse.x : 0, held & 2u ? impulse.y : 0}, own = motion.velocity_of(slot);
      impulse -= kept;
      velocity = {held & 1u ? own.x : velocity.x, held & 2u ? own.y : velocity.y};
      const double share = stage == ContactStage::before ? early_impulse : stage == ContactStage::again ? 0 : 1;
      if (share > 0) {
        resisted[slot] -= share * kept;
        notes.add(ContactStage::after, index, n, slot, share * kept);
      }
    }
    motion.change(slot, impulse, velocity, dt);
    notes.add(stage, index, n, slot, impulse);
  }
};

inline PrescribedFields prescribed_fields(ContactSums& sums) {
  const bool none = sums.prescribed.empty();
  return {none ? nullptr : exec::data(std::as_const(sums.prescribed)), none ? nullptr : exec::data(sums.resisted),
          sums.early_impulse};
}

/// 1 / w; 0 for 0, where nothing yields.
RIVEN_INLINE double inverse_or_none(double w) {
  return w > 0 ? 1 / w : 0;
}

/// n.W n, n.W t and t.W t.
struct Yield {
  double nn, nt, tt;

  RIVEN_INLINE Yield(Vec2 W, Vec2 n)
      : nn(n.x * n.x * W.x + n.y * n.y * W.y), nt(n.x * n.y * (W.y - W.x)), tt(n.y * n.y * W.x + n.x * n.x * W.y) {}
};

/// Masses of the relative motion across (x) and along (y).
RIVEN_INLINE Vec2 reduced_masses(Vec2 yielding, Vec2 normal) {
  const Yield w(yielding, normal);
  return {inverse_or_none(w.nn), inverse_or_none(w.tt)};
}

/// pair_impulse() of a touching_pair() where W differs along the axes; `velocity`: of approach, across and along. Faces
/// stick if friction bears that, or slide one way or the other. Where only one component of their relative motion is
/// free they slide as the other one has it, and friction is what those who prescribe that feel of it.
RIVEN_INLINE PairImpulse coupled_impulse(const ContactPair& p, Vec2 yielding, Vec2 velocity) {
  constexpr double none = 1e-6, at_rest = 1e-9, jams = 0.05;
  const auto [nn, nt, tt] = Yield(yielding, p.normal);
  const double det = nn * tt - nt * nt;
  const double across = velocity.x - p.across.bias;
  if (!(nn > 0) || (p.unilateral && across <= 0))
    return {0, 0};
  double slope = 0;
  if (!p.friction.none() && det > none * nn * tt) {
    const double lambda = (tt * across - nt * velocity.y) / det, tau = (nn * velocity.y - nt * across) / det;
    if ((lambda >= 0 || !p.unilateral) && p.friction.within(tau, lambda) == tau)
      return {lambda, tau};
    slope = tau > 0 ? p.friction.forward : -p.friction.back;
  } else if (!p.friction.none()) {
    const double slides = velocity.y - nt / nn * across;
    if (std::abs(slides) > at_rest * (std::abs(velocity.x) + std::abs(velocity.y)))
      slope = slides > 0 ? p.friction.forward : -p.friction.back;
  }
  const double w = across > 0 ? nn + slope * nt : nn - slope * nt, lambda = across / w;
  if (!(w > jams * nn))  // friction would take more than all of what yields
    return {across / nn, 0};
  return {lambda, slope * std::abs(lambda)};
}

}  // namespace RIVEN_SIDE

}  // namespace riven
