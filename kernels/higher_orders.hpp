// Higher-order grid velocities of XPIC(k) and FMPM(k) (Hammerquist and Nairn 2017; Nairn and Hammerquist 2021): with S
// from grid to particles and S+ = m^-1 S^T M back, on all (node, field) pairs,
//   v(k) = sum_{j<k} (I - S+ S)^j v(1),   v(1) = m^-1 p  (XPIC: before the momentum update, FMPM: after it).
// Terms vanish where velocities are prescribed, and go together where faces touch and around tips (link_fields.hpp,
// bridge_tips.hpp), so that the sum keeps that. From the third order on S^T M S is built once a step (full_mass.hpp),
// but for the particles that see a node across a crack.
#pragma once
#include <functional>

#include "core/exec/space.hpp"
#include "core/state/state.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// Fills Grid::high from Grid::q = [v~ a]. `hold` is called with each term in Grid::next, and keeps from it what fields
/// may not do; with `last` Grid::high has it, too.
template <class Real>
void higher_orders(const exec::Space&, const Plan&, State<Real, 2>&, const std::function<void(bool last)>& hold);

}  // namespace RIVEN_SIDE

}  // namespace riven
