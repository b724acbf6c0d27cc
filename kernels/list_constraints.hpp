// What fixed nodes, symmetry planes and grips hold in a step, as a list of velocity fields.
#pragma once
#include "core/state/state.hpp"
#include "kernels/contact_sums.hpp"

namespace riven {

/// Lists the fields of this step and evaluates the prescribed velocities at t and t + dt. Beside cracks what lies on
/// one side of them holds the fields of that side. The fields of particles must be known.
template <class Real>
void list_constraints(const Scene&, const Plan&, State<Real, 2>&);

/// Marks the components of the fields beside cracks whose motion is prescribed, and clears what they resist.
/// `early_impulse` as ContactSums has it.
void mark_prescribed(const Constraints&, const CrackFields&, long slots, double early_impulse, ContactSums&);

}  // namespace riven
