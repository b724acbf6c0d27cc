// Energies and momenta of all particles, summed in a fixed order.
#pragma once
#include "core/exec/space.hpp"
#include "core/state/state.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// Brings the ledger's present values up to date: kinetic, strain and cohesive energy, momentum and angular momentum
/// about the origin, and their scales. On the way, StepWatch::deformation.
template <class Real>
void tally(const exec::Space&, const Plan&, State<Real, 2>&);

/// Books the impulse and the energy that damping of the particles' own velocities takes in this step.
template <class Real>
void book_particle_damping(const exec::Space&, const Plan&, double damping, State<Real, 2>&);

}  // namespace RIVEN_SIDE

}  // namespace riven
