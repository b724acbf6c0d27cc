// Stress updates that are passes of their own (Nairn 2003, tasks 2 and 6c).
#pragma once
#include "core/exec/space.hpp"
#include "core/state/state.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// Before the momentum update (USF, USAVG): strains from Grid::q = [vx vy . .], then the forces of the new stresses
/// into the same groups.
template <class Real>
void update_stress_and_forces(const exec::Space&, const Plan&, State<Real, 2>&, Vec2 gravity);

/// After the second extrapolation (MUSL, USAVG): strains from Grid::again = [v w], then particles move by w.
template <class Real>
void update_stress_and_move(const exec::Space&, const Plan&, State<Real, 2>&);

}  // namespace RIVEN_SIDE

}  // namespace riven
