// The stable time step: CFL h / (c + |v|) over all particles, with the fastest wave of each particle's present state.
#pragma once
#include "core/exec/space.hpp"
#include "core/state/state.hpp"

namespace riven {

struct Speeds {
  double wave = 0;      ///< fastest wave, m/s
  double particle = 0;  ///< fastest particle, m/s
  double sum = 0;       ///< largest of wave + |v| of one particle, m/s
};

template <class Real>
Speeds measure_speeds(const exec::Space&, const Plan&, const State<Real, 2>&);

/// Sets Clock::dt and its limiter: waves, particle speed, the user's limit, or the end of the run.
template <class Real>
void choose_time_step(const Scene&, const Speeds&, State<Real, 2>&);

}  // namespace riven
