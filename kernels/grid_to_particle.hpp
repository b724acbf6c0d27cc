// Grid to particles (Nairn and Aimene, section 2.1.1). With a = sum S f/m and v~ = sum S (p + f dt)/m of each
// particle's fields,
//   FLIP      V' = V + a dt
//   PIC       V' = (1 - alpha) (V + a dt) + alpha v~
//   XPIC(k)   V' = S v(k)(p) + dt a
//   FMPM(k)   V' = S v(k)(p~)
//   position  x' = x + v~ dt - a dt^2 / 2
// Where velocities are extrapolated a second time (MUSL, USAVG), positions change last, and but for faces that keep to
// the grid by the mean of the velocities before and those extrapolated again (Plan::cracks_move_again).
#pragma once
#include "core/exec/space.hpp"
#include "core/state/state.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

struct TransferRule {
  double keep = 1;     ///< weight of the particle's own updated velocity: 1 FLIP, 1 - alpha PIC, 0 XPIC and FMPM
  double high_dt = 0;  ///< XPIC: dt, adds dt a to the higher-order velocity
  bool high = false;   ///< read Grid::high (orders above one)
  bool high_gradient = false;  ///< strain rates from Grid::high (FMPM)
  double damping = 0;          ///< particle damping, 1/s
};

/// Numbers of one step, the same for every particle.
template <class Real>
struct StepNumbers {
  Real dt, keep, high_dt, damping;
  bool compare;  ///< velocities of particles and grid
};

TransferRule transfer_rule(const Plan&, double pic_fraction, double particle_damping, double dt);

/// Velocities and positions in one pass, and stresses too (USL).
template <class Real>
void grid_to_particle(const exec::Space&, const Plan&, State<Real, 2>&, const TransferRule&, bool with_stress);

/// Velocities only, and at once their momenta back to Grid::again by the old shape functions (MUSL, USAVG; Nairn 2003,
/// task 6c).
template <class Real>
void grid_to_particle_again(const exec::Space&, const Plan&, State<Real, 2>&, const TransferRule&);

}  // namespace RIVEN_SIDE

}  // namespace riven
