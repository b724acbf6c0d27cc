// The cells around a place of the lattice, and the tiles whose particles may be in them.
#pragma once
#include <algorithm>

#include "core/state/grid.hpp"

namespace riven {

/// The cell of a place X, in cells from the origin of the lattice, as the shape function counts cells.
template <class Shape>
RIVEN_INLINE int cell_at(const Lattice& lattice, Vec2 X) {
  return Shape::cell(X.y) * lattice.nx + Shape::cell(X.x);
}

/// f(cell) for a cell and the eight around it, on the lattice or not; those of a node's number hold the particles that
/// may see the node.
template <class F>
RIVEN_FN void each_cell_around(const Lattice& lattice, long cell, const F& f) {
  for (int j = -1; j <= 1; ++j)
    for (int i = -1; i <= 1; ++i)
      f(cell + long{j} * lattice.nx + i);
}

/// f(tile) for the tiles of all particles that may be in the given cell or at most `reach` cells away from it along
/// each axis. Particles may have drifted by one cell since they were sorted into their tile.
template <class F>
RIVEN_FN void each_tile_around(const Lattice& lattice, int cell, int reach, const F& f) {
  const auto tile = [](int at, int n) { return std::clamp(at, 0, n - 1) / Lattice::tile; };
  const int i = cell % lattice.nx, j = cell / lattice.nx, far = reach + 1;
  for (int ty = tile(j - far, lattice.ny); ty <= tile(j + far, lattice.ny); ++ty)
    for (int tx = tile(i - far, lattice.nx); tx <= tile(i + far, lattice.nx); ++tx)
      f(ty * lattice.tiles_x() + tx);
}

}  // namespace riven
