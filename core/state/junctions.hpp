// Ends of cracks that are tied to other cracks.
#pragma once
#include "core/scene/scene.hpp"
#include "core/state/cracks.hpp"

namespace riven {

/// How far the end of a crack that has joined another reaches over it, in cells: so little that it moves nothing, so
/// much that rounding opens no gap between them.
constexpr double overshoot = 1e-6;

/// Ties the ends that begin on another crack, or on their own further along: those in a body that are nearer to it than
/// half a particle (`junction_reach` in make_tips.hpp). Where ends of several cracks meet, the others are tied to that
/// of the first crack. Ends that are nowhere tied drift apart by rounding, and paths from particles to nodes lead
/// through between them. Each tied end moves onto the crack that it meets.
void tie_from_start(const Scene& scene, Cracks& cracks);

/// Puts the ends that have joined cracks where these have gone to. They reach over the crack joined by `overshoot`
/// cells of edge `h` (m); their surfaces stay as they are.
void tie_junctions(Cracks& cracks, double h);

/// Puts the surfaces of a tied end on its own side of the crack that it has joined, `overshoot` before `place` (m).
void part_surfaces(Cracks& cracks, const Junction& junction, Vec2 place, double h);

}  // namespace riven
