// The part of anchor_cracks.hpp that is done on the host: the surfaces of each point go a part of their way.
#pragma once
#include "core/exec/space.hpp"
#include "core/state/cracks.hpp"

namespace riven {

/// From a surface to where the particles beside it say that it is.
struct WayBack {
  Vec2 d;              ///< m
  bool known = false;  ///< particles are there
};

/// `ways`: [2 points], of the upper and the lower surface of each. The faces are one at a tip, and stay so.
void return_surfaces(const exec::Space& space, const exec::Array<WayBack>& ways, double share, Cracks& cracks);

}  // namespace riven
