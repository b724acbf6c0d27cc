// Particles to grid, for every velocity field j of node i (Nairn 2003, eqs. 26 and 28; Nairn and Aimene, eq. 1):
//   m_ij = sum m_p S_ip,   p_ij = sum m_p v_p S_ip,   f_ij = sum -m_p (tau_p/rho0) . G_ip + m_p b S_ip.
#pragma once
#include "core/exec/space.hpp"
#include "core/state/state.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// Zeroes node groups of all slots, and masses where forces come with them.
template <class Real>
void clear_grid(const exec::Space&, State<Real, 2>&, bool with_forces);

/// Masses and momenta; forces too unless they come after the stresses (`with_forces`).
/// `gravity`: body force per mass, m/s^2.
template <class Real>
void particle_to_grid(const exec::Space&, const Plan&, State<Real, 2>&, bool with_forces, Vec2 gravity);

}  // namespace RIVEN_SIDE

}  // namespace riven
