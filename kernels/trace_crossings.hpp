// Trace: every particle-node pair of a marked cell against the cell's segments.
//
// A first test in single precision, over the nodes of one particle at a time, sorts out the segments that surely are
// not crossed; what remains goes through the exact test (core/fracture/crossing.hpp). A pair that crosses a crack is
// recorded, and counted for its node, crack and side. A crack that ends on another one is crossed beyond its end, too,
// by paths that come over that one (beyond_end.hpp). Pairs in which the particle has no weight on the node are kept,
// but count for nothing.
//
// What was found holds until the particle and the cracks have moved by more than the clearance that was measured with
// it (kernels/clearance.hpp); until then records and counts stay as they are. The outcome is the same as without. How
// far particles have moved is known tile by tile, so that most blocks of particles need not even be read.
#pragma once
#include "core/exec/space.hpp"
#include "core/state/bodies.hpp"
#include "core/state/crack_fields.hpp"
#include "core/state/cracks.hpp"
#include "core/state/grid.hpp"
#include "core/state/particles.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// Brings `records` and `tally` up to date. `domains`: [bodies]. `tile_move`: [tiles] how far (m) a particle
/// of the tile has moved along an axis since the last trace, at most; null if that is not known.
template <class Shape, class Real>
void trace_crossings(const exec::Space& space, const Particles<Real, 2>& particles,
                     const DomainSetting<Real, 2>* domains, const Lattice& lattice, const Cracks& cracks,
                     const double* tile_move, CrackFields& fields);

}  // namespace RIVEN_SIDE

}  // namespace riven
