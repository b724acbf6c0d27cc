// The impulses that the velocity fields of a node give each other in a step, by contact and by the bridges at crack
// tips, and the energy that they take from the solid.
//
// Fields that meet are given one motion at several stages of the step, but particles take over only what changes the
// accelerations. From a step of dt they gain
//   sum_i dt m_i a_i . (v0_i + v2_i) / 2
// of kinetic energy, without an error, with v0 the velocity that they bring to node i and v2 the one that they bring
// after the step; and stress works on the velocities that strain the solid, with the impulses in them. Of the impulses
// P at the stages before, after, again and higher a node therefore takes
//   -W = -(P_after + P_higher + e P_before) . (v0 + v2) / 2 + f dt . (b P_before + g P_again) / m
// with f all other forces, e the share of early impulses that the transfer hands to particles, and b and g the shares
// of the step that the velocities before and after the update strain the solid: USF and USL 1 and 0, MUSL 0 and 1,
// USAVG 1/2 and 1/2. Without a second extrapolation v2 is v0 with what the step adds. With USAVG nothing else of
// contact is left in the balance of energy. (The work of the impulses on the nodes themselves, P . (v_first + v_last) /
// 2, is that on lumped masses: 256 random sets of cracks missed up to 7 % of their energy by it.)
#pragma once
#include <cstdint>

#include "core/exec/parallel.hpp"
#include "core/scene/scene.hpp"
#include "core/state/crack_fields.hpp"
#include "core/state/grid.hpp"
#include "kernels/field_motion.hpp"

namespace riven {

struct FieldImpulses {
  static constexpr int stages = 4;
  exec::Array<std::uint8_t> acted;  ///< [flagged] bit 1 << stage where fields acted on each other in this step
  exec::Array<Vec2> given;          ///< [4 (flagged + extra slots)] N s, to each field in each stage; of field 0 of all
                                    ///< flagged nodes first, then of the extra slots; holds where `acted` says so
};

inline namespace RIVEN_SIDE {

/// The stage that impulses count as: those on terms change the velocities of higher orders.
constexpr int kept_as(ContactStage stage) {
  return static_cast<int>(stage == ContactStage::term ? ContactStage::higher : stage);
}

/// Where a stage writes them down.
struct ImpulseNotes {
  std::uint8_t* acted;
  Vec2* given;
  int nodes;
  long flagged;

  ImpulseNotes(FieldImpulses& to, const Lattice& l)
      : acted(exec::data(to.acted)), given(exec::data(to.given)), nodes(l.nodes()), flagged(to.acted.size()) {}

  RIVEN_INLINE Vec2* at(long i, long slot) const {
    return given + FieldImpulses::stages * (slot < nodes ? i : flagged + slot - nodes);
  }
  /// One more impulse on a field of n = CrackFields::nodes[i].
  RIVEN_INLINE void add(ContactStage stage, long i, const NodeCracks& n, long slot, Vec2 impulse) const {
    const int s = kept_as(stage), bit = 1 << s;
    if (!(acted[i] & bit)) {
      acted[i] = static_cast<std::uint8_t>(acted[i] | bit);
      at(i, n.node)[s] = {};
      for (int f = 1; f < n.room(); ++f)
        at(i, long{nodes} + n.extra + f - 1)[s] = {};
    }
    at(i, slot)[s] += impulse;
  }
};

}  // namespace RIVEN_SIDE

/// Forgets those of the last step.
void clear_impulses(const CrackFields& fields, FieldImpulses& impulses);

/// How a step hands impulses on.
struct ImpulseRule {
  double early = 0;            ///< e
  StressUpdate update{};       ///< b and g
  bool high_gradient = false;  ///< velocities of a higher order strain the solid
};

struct ImpulseEnergy {
  double work = 0;   ///< J, W summed over nodes in a fixed order
  double early = 0;  ///< J, the part of it that P_higher and P_before did on particles
  RIVEN_FN ImpulseEnergy& operator+=(const ImpulseEnergy& o) {
    work += o.work;
    early += o.early;
    return *this;
  }
};

inline namespace RIVEN_SIDE {

/// Needs Grid::q as [vx vy ax ay] and, with MUSL and USAVG, Grid::again as [vx vy . .].
template <class Real>
ImpulseEnergy impulse_energy(const exec::Space& space, const Grid<Real>& grid, const CrackFields& fields,
                             FieldImpulses& impulses, const ImpulseRule& rule, double dt);

}  // namespace RIVEN_SIDE

}  // namespace riven
