// What the hash lists, as a kernel sees it.
#pragma once
#include "core/state/crack_fields.hpp"
#include "core/state/grid.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// See CrackLists.
struct ListsView {
  Lattice lattice;
  const int *cell_index, *cells, *cell_start, *cell_segment;
  const int *tile_marked, *marked_tiles, *tile_crack_start, *tile_crack;
  const int *node_index, *candidate_start, *candidate, *segment_start, *node_segment;
};

inline ListsView lists_view(const Lattice& lattice, const CrackLists& l) {
  return {lattice,
          exec::data(l.cell_index),
          exec::data(l.cells),
          exec::data(l.cell_start),
          exec::data(l.cell_segment),
          exec::data(l.tile_marked),
          exec::data(l.marked_tiles),
          exec::data(l.tile_crack_start),
          exec::data(l.tile_crack),
          exec::data(l.node_index),
          exec::data(l.candidate_start),
          exec::data(l.candidate),
          exec::data(l.segment_start),
          exec::data(l.node_segment)};
}

}  // namespace RIVEN_SIDE

}  // namespace riven
