// The fragments into which cracks have cut the solids. Particles that share a velocity field of a node are moved by it
// together; those that no chain of such nodes joins are in different fragments.
#pragma once
#include <vector>

#include "kernels/simulation.hpp"

namespace riven {

struct Fragment {
  double mass = 0;  ///< kg
  long particles = 0;
  Vec2 centre;  ///< m, of mass
};

/// All of them, the heaviest first. Sorts the particles and determines their fields for where they are now, as the next
/// step would.
template <class Real>
std::vector<Fragment> find_fragments(SimulationOf<Real>&);

}  // namespace riven
