// Cracks that end on the edge of a body, drawn on out of it.
#pragma once
#include "core/scene/scene.hpp"

namespace riven {

/// The scene with the mouths of its cracks open. Nodes beyond the edge of a body, up to a cell away, see particles on
/// either side of a crack: where it ends on the edge, or less than that beyond it, their paths lead past its end, and
/// hold its faces together. So ends that are mouths, or outside and no cell away from the solid behind them, go on
/// straight to two cells beyond it: half way to what solid is ahead if that is nearer, and no farther out of the grid
/// than a hundredth of a cell, which parts the nodes of a wall.
Scene draw_mouths(Scene scene);

}  // namespace riven
