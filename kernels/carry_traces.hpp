// Carries what was traced over to lists that a hash has remade: where cracks grow, that is in most steps, and only what
// lies near the new segments needs to be found again.
//
// A segment is the same as before if its two points are, and if they end it as before (a tip that has grown is a joint
// from then on). A particle keeps its crossings if its cell sees, by the former lists and by the new ones, no other
// segments than such; and nodes keep their counts and what these mean. All of it is rewritten in terms of the new
// numbers of points, nodes, candidates and tiles.
#pragma once
#include "core/exec/space.hpp"
#include "core/state/crack_fields.hpp"
#include "core/state/cracks.hpp"
#include "core/state/grid.hpp"
#include "core/state/particles.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// Remakes what trace and assign keep from `fields.former`. `fields.traces` must be the number of the trace to come.
void carry_traces(const exec::Space& space, const Tiles& tiles, const Lattice& lattice, const Cracks& cracks,
                  CrackFields& fields);

}  // namespace RIVEN_SIDE

}  // namespace riven
