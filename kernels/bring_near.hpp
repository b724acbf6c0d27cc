// Brings to the host what there is around some places, where the rest is to stay on the device: J and growth look at no
// more.
#pragma once
#include <vector>

#include "core/exec/parts.hpp"
#include "core/exec/space.hpp"
#include "core/state/state.hpp"

namespace riven {

/// Particles that were sorted into cells within `cells` of a place along each axis, and the nodes there; by whole
/// tiles.
template <class Real>
void bring_near(const exec::Space&, const State<Real, 2>&, const std::vector<Vec2>& places, double cells,
                exec::PartsOnHost&);

}  // namespace riven
