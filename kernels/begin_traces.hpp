// What a trace begins with that knows nothing.
#pragma once
#include "core/exec/space.hpp"
#include "core/state/crack_fields.hpp"
#include "core/state/cracks.hpp"
#include "core/state/grid.hpp"
#include "core/state/particles.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// Forgets all crossings, after a sort or when room ran out.
void begin_traces(const exec::Space& space, const Tiles& tiles, long particles, const Lattice& lattice,
                  const Cracks& cracks, CrackFields& fields);

}  // namespace RIVEN_SIDE

}  // namespace riven
