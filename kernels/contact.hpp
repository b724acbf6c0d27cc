// Contact between the fields of every node that a crack passes (laws: core/laws/contact.hpp, solution of a node:
// core/laws/contact_sweep.hpp). With A, B and C the node's cracks, field = 1 (crosses A) + 2 (crosses B) + 4 (crosses
// C):
//   fields that differ by 1 meet across A with A's normal, by 2 across B with B's and by 4 across C with C's (of two
//   cracks: J.A. Nairn and Y.E. Aimene, Modeling Multiple Crack Propagation in the Material Point Method, section
//   2.1.3); fields that differ on several cracks with none between them, such as (0,3) without 1 and 2, or (0,7)
//   without all others, meet with the sum of these cracks' normals, each turned to point from the one to the other, and
//   the strictest of their laws.
//
// Detection, for laws whose faces may part (stick, frictionless, Coulomb):
//   volume        apart if V_rel < V_sep, held together if V_rel > V_contact, by velocity between (J.A. Nairn, CMES 4
//                 (2003), eqs. 8-12)
//   velocity      in contact when the fields approach each other along n (eq. 12)
//   displacement  in contact when they approach so fast that the gap closes in this step; the impulse leaves just the
//                 velocity that closes it (J.A. Nairn, CMES 92 (2013) 271-299; J.A. Nairn, S.G. Bardenhagen, G.D.
//                 Smith, Comp. Part. Mech. 5 (2018) 285-296). The gap compares current and first mean positions,
//                 delta_n = n.(x_below - x_above) - n0.(X_below - X_above),
//                 X where particles would lie at first if the solids touched across the crack
//                 (core/state/first_gaps.hpp): the gap at first for every rigid motion of both solids as one, and from
//                 there on the jump of displacement for small rotations; negative in compression.
//                 Beyond 0.2 cells nothing touches: no face closes that far in a stable step, but a field of next to no
//                 mass may have any velocity.
// Stopping faces at a distance instead would let them creep together by one stop after another, each a loss of energy;
// ignoring the gap until it is negative would leave them a whole step's approach inside each other.
//
// By displacement, faces that pressed on each other stay together in the stages without forces as far as the solid
// about them goes on: see pressed_faces.hpp.
// Friction holds the faces of a node if it holds those of the nodes around: see friction_around.hpp.
//
// Stages: before the forces and after a second extrapolation momenta change; after the update velocities change, and
// the accelerations by dv/dt, so that bonded fields move their particles as one field would (Nairn and Aimene,
// section 2.1.3). Interface tractions are forces: they act once per step, with the impulse of the whole step, in the
// stage `after`, where v - a dt is the velocity before the forces and a all other forces; adding F = impulse/dt to the
// forces would give the same v and a. In the other stages an interface only keeps together what it is too stiff to let
// go.
#pragma once
#include <algorithm>
#include <limits>

#include "core/exec/parallel.hpp"
#include "core/scene/scene.hpp"
#include "core/state/crack_fields.hpp"
#include "core/state/cracks.hpp"
#include "core/state/grid.hpp"
#include "kernels/contact_sums.hpp"
#include "kernels/field_impulses.hpp"
#include "kernels/field_motion.hpp"

namespace riven {

/// What contact did, summed over nodes in a fixed order.
struct ContactReport {
  long touching = 0;  ///< pairs of fields that pushed or held each other
  long apart = 0;     ///< pairs whose faces may part and did not touch
  long early = 0;     ///< nodes that touched although V_rel < V_sep (where volumes were summed)
  long pressing = 0;  ///< nodes whose faces pressed in the momentum update (displacement)
  long capped = 0;    ///< nodes whose pairs were not solved within the limit of sweeps
  int capped_node = std::numeric_limits<int>::max();  ///< the first of them, by number
  double penetration = 0;                             ///< m, largest -delta_n of a touching pair (displacement)
  double gap = 0;                                     ///< m, largest delta_n at which a pair pushed (displacement)

  RIVEN_FN ContactReport& operator+=(const ContactReport& o) {
    touching += o.touching;
    apart += o.apart;
    early += o.early;
    pressing += o.pressing;
    capped += o.capped;
    capped_node = std::min(capped_node, o.capped_node);
    penetration = std::max(penetration, o.penetration);
    gap = std::max(gap, o.gap);
    return *this;
  }
};

/// Contact that waits for faces to close (contact.when = "auto").
struct ContactWatch {
  bool on = true;       ///< contact acts in this step
  bool closed = false;  ///< faces have been seen to touch, not long ago
  long last = 0;        ///< step in which they were seen last,
  Vec2 place;           ///< m, at this node
  int crack = -1;       ///< of this crack
};

inline namespace RIVEN_SIDE {

/// Applies contact to all flagged nodes; adds to the report. `sums` as contact_sums() prepared them, of what the
/// detection and the laws need: positions for displacement, volumes for volume, areas for interfaces. Bonded and
/// ignored cracks need none. Keeps CrackFields::pressed. Throws Error (internal) if sums are missing.
template <class Real>
void contact(const exec::Space& space, Grid<Real>& grid, CrackFields& fields, const Cracks& cracks,
             const ContactRules& rules, ContactStage stage, double dt, const ContactParticles<Real>& of,
             ContactSums& sums, FieldImpulses& impulses, ContactReport& report);

}  // namespace RIVEN_SIDE

}  // namespace riven
