// The momentum update on the grid, for every slot (Nairn and Aimene, eq. 1; Nairn 2003, task 4):
//   a = f / m - kappa v,   v~ = p / m + a dt.
#pragma once
#include <algorithm>

#include "core/exec/space.hpp"
#include "core/plan/plan.hpp"
#include "core/state/state.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// Sums that only scenes with body forces or grid damping need.
struct GridSums {
  double mass = 0;            ///< kg
  Vec2 momentum;              ///< sum m (v + v~) / 2, kg m/s
  Vec2 moment;                ///< sum m x, kg m
  double damping_work = 0;    ///< taken by grid damping in this step, J
  Vec2 damping_impulse;       ///< given to the body by grid damping, N s
  double damping_torque = 0;  ///< about the origin, N m s
  RIVEN_FN GridSums& operator+=(const GridSums& o) {
    mass += o.mass;
    momentum += o.momentum;
    moment += o.moment;
    damping_work += o.damping_work;
    damping_impulse += o.damping_impulse;
    damping_torque += o.damping_torque;
    return *this;
  }
};

/// Grid::q: [px py . .] -> [vx vy . .] in all slots; slots without mass become zero.
template <class Real>
void momenta_to_velocities(const exec::Space&, State<Real, 2>&);

/// q: [px py fx fy], or [vx vy fx fy] when `from_velocity`, -> [v~x v~y ax ay].
template <class Real>
void advance_grid(const exec::Space&, State<Real, 2>&, bool from_velocity, double damping);

/// Grid::again: [px py . .] -> [v' w] in all slots, w being what particles move by: from Grid::q = [v~ a] and v = v~ -
/// a dt that is (v + v')/2 (Plan::cracks_move_again) or, around faces that keep to the grid, v~ - (a + b v) dt / 2, b
/// the particle damping.
template <class Real>
void velocities_again(const exec::Space&, const Plan&, double particle_damping, State<Real, 2>&);

/// Sums over the step's start and end, once velocities and accelerations are constrained.
template <class Real>
GridSums grid_sums(const exec::Space&, const State<Real, 2>&, double damping);

/// Masses below this are rounding remains, not matter: a node that a particle gives the part s^2 of its mass bears the
/// part s of its force. In float more of them are, and their inverses must not overflow.
template <class Real>
double mass_cutoff(const State<Real, 2>& s) {
  return (sizeof(Real) == sizeof(double) ? 1e-24 : 1e-16) * s.particle_mass;
}

/// kg, of less a surface bears nothing and is borne by nothing: a part of the mass of a full cell of the lightest body.
/// Along a face a surface sees half of that mass, at a corner a quarter, half a cell off the solid this much. What lies
/// farther off, as where a crack has cut a body whose parts draw apart, would set next to no mass in motion with more
/// energy than the whole body has.
template <class Real>
double least_mass_borne(const State<Real, 2>& s) {
  constexpr double part = 0.05;
  const double h = s.grid.lattice.h;
  return part * h * h / *std::max_element(s.specific_area.begin(), s.specific_area.end());
}

}  // namespace RIVEN_SIDE

}  // namespace riven
