// The crack tasks of the step, for the shape function of the plan.
#pragma once
#include "kernels/simulation.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

template <class Real>
void hash_if_due(SimulationOf<Real>&);
template <class Real>
void find_fields(SimulationOf<Real>&);
template <class Real>
void load_faces(SimulationOf<Real>&);
template <class Real>
void move_with_grid(SimulationOf<Real>&);

}  // namespace RIVEN_SIDE

}  // namespace riven
