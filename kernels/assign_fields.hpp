// Assign: from the crossings of all pairs, the cracks that each node holds, and the field v(p,i) of each pair.
//
// A node holds the three cracks with most crossings (ties to the lower number, as neither the number of a crack nor the
// order of the particles may matter otherwise). The side from which more pairs cross is opposite to the node's (tie:
// above). Field = 1 (crosses the first) + 2 (crosses the second) + 4 (crosses the third). Two kinds of crossings count
// as none and are warned of (Nairn et al., appendix): 1, from the other side; 2, of a crack that the node does not
// hold. The paper has two cracks at a node and allocates fields in order of arrival; up to two cracks this gives the
// same fields, 1 and 2 possibly swapped.
//
// Of a node behind a crack on which another one ends that it holds, too, it is noted that it is so (beyond_end.hpp):
// both fields before that crack meet the one behind.
#pragma once
#include "core/exec/space.hpp"
#include "core/state/bodies.hpp"
#include "core/state/crack_fields.hpp"
#include "core/state/cracks.hpp"
#include "core/state/grid.hpp"
#include "core/state/particles.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// Trace and assign: fills `nodes` and `fields` from the present positions. The hash must not be due. Particles are
/// sorted by tiles, from which they have moved by one cell at most. `domains`: [bodies]. `tile_move`: see
/// trace_crossings.hpp.
template <class Shape, class Real>
void determine_fields(const exec::Space& space, const Particles<Real, 2>& particles,
                      const DomainSetting<Real, 2>* domains, const Lattice& lattice, const Cracks& cracks,
                      CrackFields& fields, const double* tile_move = nullptr);

}  // namespace RIVEN_SIDE

}  // namespace riven
