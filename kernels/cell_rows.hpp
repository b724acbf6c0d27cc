// Particles by the cells that they were sorted into.
#pragma once
#include <algorithm>

#include "core/state/grid.hpp"

namespace riven {

/// f(first, last) for the stretches of particles that were sorted into cells left .. right of row j; clipped to the
/// lattice. `cell_start`: Tiles::cell_start.
template <class Visit>
RIVEN_INLINE void each_stretch_of_row(const Lattice& lattice, const int* cell_start, int j, int left, int right,
                                      const Visit& f) {
  if (j < 0 || j >= lattice.ny)
    return;
  right = std::min(right, lattice.nx - 1);
  for (int i = std::max(left, 0), end = i; i <= right; i = end + 1) {
    end = std::min(right, i | (Lattice::tile - 1));  // cells of one tile follow each other
    f(cell_start[lattice.sorted_cell(i, j)], cell_start[lattice.sorted_cell(end, j) + 1]);
  }
}

}  // namespace riven
