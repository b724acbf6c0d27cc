// The summary of a simulation as it stands.
#pragma once
#include "io/summary.hpp"
#include "kernels/simulation.hpp"

namespace riven {

/// All but `status`, `message`, `retries` and the probes. `wall_seconds`: that the steps so far have taken.
template <class Real>
Summary summarize(const SimulationOf<Real>& simulation, double wall_seconds);

}  // namespace riven
