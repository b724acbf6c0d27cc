// What holds fields that touch together in higher orders.
//
// The series of higher orders, v(k) = sum_j (I - m^-1 M)^j v(1), knows the fields of each side of a crack alone: where
// faces press on each other its terms part or close them anew, and what stops that once the sum is made does not see
// that the next terms undo it. With order 4 a bar with a shut crack across, pressed and at rest, so made 20 % of its
// energy in 3000 steps; with 2 and 3 it did not. So every term loses what the fields that touched in the momentum
// update may not do: with P the projection that takes from each pair its relative velocity across the crack, and along
// it where faces stick, by the least change of momentum,
//   v(k) = sum_j (P (I - m^-1 M))^j v(1),
// the series of the solid whose faces do not part, whose terms shrink as those of a solid without cracks do. Of a node
// that sees several cracks fields that touch go together altogether.
#pragma once
#include "kernels/contact_sums.hpp"
#include "kernels/field_impulses.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// Changes Grid::next, and Grid::high if that has this term (`last`), as ContactSums::links has it; notes the impulses.
template <class Real>
void link_fields(const exec::Space& space, Grid<Real>& grid, const CrackFields& fields, double dt, bool last,
                 ContactSums& sums, FieldImpulses& impulses);

}  // namespace RIVEN_SIDE

}  // namespace riven
