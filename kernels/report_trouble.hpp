// When a simulation goes wrong: finds the first offending particle and says where it is, which limit it broke and
// what to try.
#pragma once
#include "core/plan/plan.hpp"
#include "core/state/state.hpp"

namespace riven {

template <class Real>
[[noreturn]] void particle_left_grid(const State<Real, 2>&, long particle);

/// Throws Error (unstable) if the last step left a number that is none, or a det F that is not positive.
template <class Real>
void check_particles(const State<Real, 2>&);

/// Throws Error (unstable): steps of less than `least` (s) would take a run nowhere.
[[noreturn]] void time_stands_still(const Clock&, double least);

template <class Real>
long fastest_particle(const Particles<Real, 2>&);

/// The work of a load is booked with the particles' moves, which lag behind their momentum: when a body at rest is
/// loaded at once, its energy, as the square of the steps, is ahead of the work by up to this part of it, and where it
/// rises faster by as many times as `power` says. USL and USF strain by the velocity at one end of the step: where
/// displacements rise as the n-th power of the steps N, which is the third under a load that rises steadily and the
/// fourth under one that starts smoothly, strain energy is off by n (n - 1) / (2 n - 1) / N besides. MUSL strains by
/// the velocity at the end, too, and is ahead by 0.62 / N where grips move off at once.
double work_lag(const Plan& plan, long step, double power = 1);

/// Throws Error (unstable) if kinetic + strain + sinks outgrew the work done by more than the plan allows of the
/// largest energy, with what the transfer took and without: that of a higher order gives back some of what contact
/// takes. Where the plan watches energy, with it alone.
template <class Real>
void check_energy(const Plan&, const State<Real, 2>&);

}  // namespace riven
