// The tasks of the step that end cracks at their tips.
#pragma once
#include "kernels/simulation.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// Tips end their cracks between nodes (bridge_tips.hpp), at each stage at which contact acts, and after it.
template <class Real>
void bridge_before_update(SimulationOf<Real>&);
template <class Real>
void bridge_after_update(SimulationOf<Real>&);
template <class Real>
void bridge_term(SimulationOf<Real>&, bool last);
template <class Real>
void bridge_after_extrapolation(SimulationOf<Real>&);

}  // namespace RIVEN_SIDE

}  // namespace riven
