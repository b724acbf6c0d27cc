// Fields whose motion is prescribed, as contact meets them: nothing that pushes on them moves them, so that in those
// components they have no 1/m, and all of a relative velocity is the other field's to lose. What they so resist comes
// from who prescribes their motion, and is part of its reaction.
//
// With W = 1/m_a + 1/m_b of each component that is free, the impulse across a pair of normal n and along it meets
//   1/m_n = n_x^2 W_x + n_y^2 W_y,   1/m_t = n_y^2 W_x + n_x^2 W_y
// (what couples the two, n_x n_y (W_x - W_y), is left to the next step: it is 0 unless just one component is prescribed
// and the crack runs aslant to that).
#pragma once
#include <cmath>

#include "kernels/contact_meetings.hpp"
#include "kernels/field_impulses.hpp"
#include "kernels/field_motion.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

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
      w += (1 / mass[f]) * Vec2{held & 1u ? 0. : 1., held & 2u ? 0. : 1.};
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
      resisted[slot] -= share * kept;
      notes.add(ContactStage::after, index, n, slot, share * kept);
    }
    motion.change(slot, impulse, velocity, dt);
    notes.add(stage, index, n, slot, impulse);
  }
};

/// 1 / w; 0 for 0, where nothing yields.
RIVEN_INLINE double inverse_or_none(double w) {
  return w > 0 ? 1 / w : 0;
}

/// Masses of the relative motion across (x) and along (y).
RIVEN_INLINE Vec2 reduced_masses(Vec2 yielding, Vec2 normal) {
  const double xx = normal.x * normal.x, yy = normal.y * normal.y;
  return {inverse_or_none(xx * yielding.x + yy * yielding.y), inverse_or_none(yy * yielding.x + xx * yielding.y)};
}

}  // namespace RIVEN_SIDE

}  // namespace riven
