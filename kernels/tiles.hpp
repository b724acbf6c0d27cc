// Runs a kernel over the tiles of particles, and hides the race between tiles that write to the same nodes.
//
//   ordered  tiles of one colour at a time, straight into the grid: no two tiles of a colour share a node, and every
//            node is summed in the same order on any number of threads
//   atomic   all tiles at once, each into a buffer of its own, flushed with atomic additions where tiles overlap
//
// Particles may have drifted by one cell since they were sorted, and see nodes up to one more away: a tile of 8 x 8
// cells writes to the nodes -2 .. 9 around its corner, and shares all but the nodes 2 .. 5 with its neighbours.
#pragma once
#include "core/exec/parallel.hpp"
#include "core/state/particles.hpp"
#include "kernels/block.hpp"

namespace riven {

inline constexpr int tile_margin = 2;
inline constexpr int tile_reach = Lattice::tile + 2 * tile_margin;

/// body(tile, first, last) for every tile that holds particles; bodies only read the grid.
template <class Body>
void each_tile(const exec::Space& space, const char* label, const Tiles& tiles, const Body& body) {
  exec::parallel_tasks(space, label, static_cast<long>(tiles.by_colour.size()),
                       [body, list = tiles.by_colour.data(), start = tiles.start.data()](long t) {
                         body(list[t], long{start[list[t]]}, long{start[list[t] + 1]});
                       });
}

namespace detail {

template <bool Mass, class Real>
void flush(const Lattice& lattice, int corner_x, int corner_y, const Real* mass, const Real* q, Real* grid_mass,
           Real* grid_q, bool shared) {
  for (int j = 0; j < tile_reach; ++j) {
    const int y = corner_y + j;
    if (y < 0 || y >= lattice.ny)
      continue;
    for (int i = 0; i < tile_reach; ++i) {
      const int x = corner_x + i, n = j * tile_reach + i;
      if (x < 0 || x >= lattice.nx)
        continue;
      const Quad<Real> v = quad_at<Real>(q + 4L * n);
      if constexpr (Mass) {
        if (mass[n] == Real(0))
          continue;
      } else {
        if (v[0] == Real(0) && v[1] == Real(0) && v[2] == Real(0) && v[3] == Real(0))
          continue;
      }
      const long g = static_cast<long>(y) * lattice.nx + x;
      const bool inner = i >= 2 * tile_margin && i < Lattice::tile && j >= 2 * tile_margin && j < Lattice::tile;
      const bool atomic = shared && !inner;
      for (int c = 0; c < 4; ++c)
        if (v[c] != Real(0))
          add(grid_q[4 * g + c], v[c], atomic);
      if constexpr (Mass)
        add(grid_mass[g], mass[n], atomic);
    }
  }
}

}  // namespace detail

/// body(tile, first, last, target) for every tile that holds particles; bodies add to the nodes of `target` and to
/// the extra slots. With Mass false nothing is added to the masses.
template <bool Mass, class Real, class Body>
void scatter_tiles(const exec::Space& space, const char* label, ScatterKind kind, const Tiles& tiles,
                   const Lattice& lattice, Real* grid_mass, Real* grid_q, const Body& body) {
  const exec::Stopwatch watch(space.timers(), label);
  const int* list = tiles.by_colour.data();
  const int* start = tiles.start.data();
  if (kind == ScatterKind::ordered) {
    const NodeTarget<Real> whole{grid_mass, grid_q, lattice.nx, 0, 0};
    for (int colour = 0; colour < 4; ++colour) {
      const int* some = list + tiles.colour_start[colour];
      exec::launch(space, tiles.colour_start[colour + 1] - tiles.colour_start[colour],
                   [=](long t) { body(some[t], long{start[some[t]]}, long{start[some[t] + 1]}, whole); });
    }
    return;
  }
  const bool shared = space.threads() > 1;
  exec::launch(space, static_cast<long>(tiles.by_colour.size()), [=](long t) {
    const int tile = list[t];
    const int corner_x = tile % lattice.tiles_x() * Lattice::tile - tile_margin;
    const int corner_y = tile / lattice.tiles_x() * Lattice::tile - tile_margin;
    alignas(64) Real mass[Mass ? tile_reach * tile_reach + 1 : 1] = {};  // one more: see add_row
    alignas(64) Real q[4 * tile_reach * tile_reach] = {};
    body(tile, long{start[tile]}, long{start[tile + 1]}, NodeTarget<Real>{mass, q, tile_reach, corner_x, corner_y});
    detail::flush<Mass>(lattice, corner_x, corner_y, mass, q, grid_mass, grid_q, shared);
  });
}

}  // namespace riven
