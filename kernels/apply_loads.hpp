// Forces on chosen particles: f_ij += sum f_p S_ip (Nairn 2003, eq. 28), into the fields that the particle sees. A step
// takes them as they are in its middle, so that their impulse is of second order in the step. A traction acts on the
// edge of the particle: along its normal the weights are those that balance the stress there (axis_at_edge). With S_ip
// a node just past an edge that goes on into its cell would bear the part s^2 of the traction, and s of the stress.
#pragma once
#include "core/exec/space.hpp"
#include "core/state/state.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// Adds the forces of this step to Grid::q and books their impulse.
template <class Real>
void apply_loads(const exec::Space&, const Plan&, State<Real, 2>&);

/// Books the work that the forces did while their particles moved.
template <class Real>
void settle_loads(const exec::Space&, const Plan&, State<Real, 2>&);

}  // namespace RIVEN_SIDE

}  // namespace riven
