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

/// f(point, last) for the ends that lie on other cracks.
template <class F>
void each_end_on_crack(const Cracks& cracks, const CrackFields& fields, const F& f) {
  for (long e = 0; e < fields.ends.size(); ++e)
    if (const bool last = e % 2 != 0; fields.ends.data()[e].host >= 0)
      f(cracks.end_point(static_cast<int>(e / 2), last), last);
}

inline namespace RIVEN_SIDE {

/// Notes where the crack points are, and remakes all lists of `fields` down to `extra_slots`. Shape: Linear, UGimp or
/// BSpline, as the particles use it. Work in proportion to the segments, but for sweeps over the node numbers.
template <class Shape>
void hash_cracks(const exec::Space& space, const Lattice& lattice, const Cracks& cracks, CrackFields& fields);

/// Remakes the lists alone, with the points where CrackFields::hashed has them: they are a function of these, not of
/// where the cracks are by now.
template <class Shape>
void list_segments(const exec::Space& space, const Lattice& lattice, const Cracks& cracks, CrackFields& fields);

}  // namespace RIVEN_SIDE

}  // namespace riven
