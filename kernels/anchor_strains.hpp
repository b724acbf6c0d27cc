// Holds the deformation gradients of particles to where these are.
//
// F follows the gradients of the grid's velocity, each at the place of the particle, and what these miss of the true
// one is made up so that the forces on the nodes are none. As long as a body stays on its nodes that remains so. Once
// the particles have come to other places of their cells, the stresses that the nodes did not see are forces: they move
// the body, which makes others. In a disk that turns with a crack held open, strain energy doubled in one revolution,
// and J rose with it. Where the particles were at first is known. So each time that they are sorted, as they have then
// come to other nodes, the way back d = X - x is put to the nodes with its gradient D = F^-1 - I,
//   m_ij d_ij = sum_p m_p S_ip (d_p + D_p (x_i - x_p)),   m_ij D_ij = sum_p m_p S_ip D_p,
// and taken for
//   d(x) = sum_i S_i(x) (d_ij + D_ij (x - x_i) / 2),
// which is exact for quadratic ways. What the particles miss of that is added to the nodes' d, and F goes a part of the
// way to what d(x) makes of it:
//   F_c = (I + grad d)^-1,   F' = exp(share (F_c F^-1 - I)) F,
// the law taking the stresses along. Waves of a few cells lose energy by it, too: Energy::anchoring has what it took.
//
// Where the particles of a node were not one solid at first, d is no function of x. Particles that see a node with
// those of two bodies, or with some whose ways differ by a good part of a cell, are left as they are.
#pragma once
#include "core/exec/space.hpp"
#include "core/plan/plan.hpp"
#include "core/state/state.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// To be called once the fields of this step are known and before anything is put to the grid: Grid::q is used. Needs
/// the particles' x0 and F.
template <class Real>
void anchor_strains(const exec::Space& space, const Plan& plan, State<Real, 2>& s);

}  // namespace RIVEN_SIDE

}  // namespace riven
