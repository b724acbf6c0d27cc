// What a trace begins with, on the host: cracks and the tiles around them are few.
#pragma once
#include "core/exec/space.hpp"
#include "core/state/crack_fields.hpp"
#include "core/state/cracks.hpp"
#include "core/state/grid.hpp"
#include "core/state/particles.hpp"

namespace riven {

/// Forgets all crossings, after a sort or when room ran out.
void begin_traces(const Tiles& tiles, long particles, const Lattice& lattice, const Cracks& cracks,
                  CrackFields& fields);

/// Follows the cracks' points; notes how far they have moved since the last trace.
void follow_moves(const exec::Space& space, const Lattice& lattice, const Cracks& cracks, CrackFields& fields);

}  // namespace riven
