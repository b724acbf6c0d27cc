// The stable time step: CFL h / (c + |v|) over all particles, with the fastest wave of each particle's present state;
// beside cohesive cracks at most CFL sqrt(rho h / k), k being the stiffness (Pa/m) of the undamaged law: the nodes next
// to either face carry the mass rho h / 2 per area, and two such masses on the spring k swing with w^2 = 4 k / (rho h),
// so that w dt stays below 2 CFL, as it does for waves across one cell.
#pragma once
#include "core/exec/space.hpp"
#include "core/state/state.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

struct Speeds {
  double wave = 0;      ///< fastest wave, m/s
  double particle = 0;  ///< fastest particle, m/s
  double sum = 0;       ///< largest of wave + |v| of one particle, m/s
};

template <class Real>
Speeds measure_speeds(const exec::Space&, const Plan&, const State<Real, 2>&);

/// Sets Clock::dt and its limiter: waves, particle speed, cohesive laws, the user's limit, or the end of the run.
template <class Real>
void choose_time_step(const Scene&, const Speeds&, State<Real, 2>&);

/// From now on all time steps are `factor` times as long as they would be, the user's limit included.
void reduce_time_step(double factor, Clock&);

}  // namespace RIVEN_SIDE

}  // namespace riven
