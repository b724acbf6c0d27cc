// Hash: which cells, tiles and nodes may see which segments, so that particles away from cracks do nothing and the
// others test few segments (Nairn et al., appendix on crack hashing; there cells list cracks, here segments).
//
// A path from a particle to a node lies in the box of its cell's nodes. A cell sees a segment that comes within a
// margin of this box; a node may see the cracks whose segments come within the margin of any path that ends there.
// So the lists stay valid until a crack point has moved by more than the margin.
#pragma once
#include "core/exec/space.hpp"
#include "core/state/crack_fields.hpp"
#include "core/state/cracks.hpp"
#include "core/state/grid.hpp"

namespace riven {

/// True when cracks have grown, or some crack point has moved by more than the margin, since the last hash.
bool hash_due(const exec::Space& space, const Lattice& lattice, const Cracks& cracks, const CrackFields& fields);

inline namespace RIVEN_SIDE {

/// Notes where the crack points are, and remakes all lists of `fields` down to `extra_slots`. Shape: Linear, UGimp or
/// BSpline, as the particles use it. Work in proportion to the segments, but for sweeps over the node numbers.
template <class Shape>
void hash_cracks(const exec::Space& space, const Lattice& lattice, const Cracks& cracks, CrackFields& fields);

/// The latter alone, with the points where CrackFields::hashed has them: the lists are a function of these, not of
/// where the cracks are by now.
template <class Shape>
void list_segments(const exec::Space& space, const Lattice& lattice, const Cracks& cracks, CrackFields& fields);

}  // namespace RIVEN_SIDE

}  // namespace riven
