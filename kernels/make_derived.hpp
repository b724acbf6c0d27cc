// Takes a simulation up again whose members (each_member.hpp) another one has left.
#pragma once
#include "kernels/simulation.hpp"

namespace riven {

/// Makes what is a function of the members and what no step makes by itself: lists of tiles, places of loaded
/// particles, what the cracks' hash listed. `m`: as made from its scene, its members then replaced.
template <class Real>
void make_derived(SimulationOf<Real>& m);

}  // namespace riven
