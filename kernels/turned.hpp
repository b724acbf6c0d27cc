// Has particles traced whose last trace no longer holds, whatever clearance it left.
#pragma once
#include "core/exec/atomic.hpp"
#include "core/state/crack_fields.hpp"
#include "kernels/cells_around.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

struct Turning {
  Lattice lattice;
  const int* tile_marked;
  int* turned;       ///< CrackFields::turned
  TileTrace* tiles;  ///< [marked tiles]
  int traces;

  /// Those whose cell it was.
  RIVEN_FN void cell(long cell) const {
    if (cell < 0 || cell >= lattice.nodes())
      return;
    exec::atomic_set(turned[cell], traces);
    each_tile_around(lattice, static_cast<int>(cell), 0, [&](int tile) {
      if (const int m = tile_marked[tile])
        exec::atomic_set(tiles[m - 1].turned, 1);
    });
  }

  /// Those that see the node.
  RIVEN_FN void node(int node) const {
    each_cell_around(lattice, node, [&](long near) { cell(near); });
  }
};

inline Turning turning(const Lattice& lattice, CrackFields& f) {
  return {lattice, exec::data(std::as_const(f.tile_marked)), exec::data(f.turned), exec::data(f.tiles), f.traces};
}

}  // namespace RIVEN_SIDE

}  // namespace riven
