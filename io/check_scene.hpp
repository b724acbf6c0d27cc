// Checks of a scene for meaning: parts that do not fit each other.
#pragma once
#include "core/scene/scene.hpp"

namespace riven {

/// Throws Error (bad_input) with the place of the first part that cannot be simulated as written: no body, equal
/// names, a grid that is not whole cells, too small for what is in it or too large for memory, symmetry planes off the
/// grid lines, fixed nodes without a node, bodies and grips without a particle, beyond a
/// symmetry plane or in the same place, loads and probes without a body, cracks
/// without length or outside every body, interfaces without stiffness.
void check_scene(const Scene& s);

}  // namespace riven
