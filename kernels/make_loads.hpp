// Loads as the scene gives them: the particles that each acts on, and what they bear at a time.
#pragma once
#include "core/exec/space.hpp"
#include "core/state/state.hpp"

namespace riven {

/// Finds the particles of each [[load]] and their shares; bodies are as laid out at the start.
/// Throws Error (bad input) for a load that finds no particle, or is not finite somewhere.
template <class Real>
void make_loads(const Scene&, State<Real, 2>&);

/// What each particle of the group bears at time t (s), N.
void find_forces(const exec::Space&, const LoadGroup&, double t, Vec2* force);

}  // namespace riven
