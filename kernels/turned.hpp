// Has particles traced whose last trace no longer holds, whatever clearance it left.
#pragma once
#include <atomic>

#include "core/state/crack_fields.hpp"
#include "kernels/cells_around.hpp"

namespace riven {

/// Those whose cell it was.
inline void turn_cell(const Lattice& lattice, long cell, CrackFields& fields) {
  if (cell < 0 || cell >= lattice.nodes())
    return;
  std::atomic_ref<int>(fields.turned[cell]).store(fields.traces, std::memory_order_relaxed);
  each_tile_around(lattice, static_cast<int>(cell), 0, [&](int tile) {
    if (const int m = fields.tile_marked[tile])
      std::atomic_ref<int>(fields.tiles[m - 1].turned).store(1, std::memory_order_relaxed);
  });
}

/// Those that see the node.
inline void turn_node(const Lattice& lattice, int node, CrackFields& fields) {
  each_cell_around(lattice, node, [&](long cell) { turn_cell(lattice, cell, fields); });
}

}  // namespace riven
