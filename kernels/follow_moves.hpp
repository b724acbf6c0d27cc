// How far cracks have moved between traces, on the host: points of cracks are few.
#pragma once
#include "core/exec/space.hpp"
#include "core/state/crack_fields.hpp"
#include "core/state/cracks.hpp"
#include "core/state/grid.hpp"

namespace riven {

/// Follows the cracks' points; notes how far they have moved since the last trace.
void follow_moves(const exec::Space& space, const Lattice& lattice, const Cracks& cracks, CrackFields& fields);

}  // namespace riven
