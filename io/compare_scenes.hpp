// Is the scene that a run is to go on with the one that it began with?
#pragma once
#include "core/scene/scene.hpp"

namespace riven {

/// Throws Error (bad_input), naming the first keys that differ, unless the scenes are the same but for what may change
/// during a run: solver.time, solver.threads, solver.exec and [output]. Values are compared as they are written, and so
/// are the files that the scenes name.
void require_same_scene(const Scene& before, const Scene& now);

}  // namespace riven
