// The background grid: a regular Cartesian lattice of nodes, data in slots.
//
// Field 0 of node n is slot n. Fields 1..7 of a node that may see a crack follow behind the plain grid:
//   slot(n, f) = n_nodes + extra[n] + f - 1,   f >= 1,
// with extra[n] = -1 where no crack can be seen. A node that can see one crack owns one extra slot, a node that
// can see two owns three, one that can see more owns seven.
#pragma once
#include <cmath>

#include "core/exec/array.hpp"
#include "core/math/vec.hpp"

namespace riven {

/// Where the nodes are. Node (i, j) lies at origin + h (i, j), and has number j nx + i. The walls are the
/// user's box; four or more layers of ghost nodes lie outside of it, up to whole tiles.
struct Lattice {
  int nx = 0, ny = 0;          ///< nodes along each axis, ghosts included; multiples of tile
  double h = 0;                ///< cell edge, m
  Vec2 origin;                 ///< position of node (0, 0)
  int wall_lower[2] = {0, 0};  ///< node index of the walls along each axis
  int wall_upper[2] = {0, 0};

  static constexpr int tile = 8;    ///< edge of a tile in nodes
  static constexpr int ghosts = 4;  ///< node layers below the walls; at least as many above

  RIVEN_INLINE int nodes() const { return nx * ny; }
  RIVEN_INLINE int tiles_x() const { return nx / tile; }
  RIVEN_INLINE int tiles_y() const { return ny / tile; }
  /// Number of cell (i, j) in the order in which particles are sorted: tile by tile, row by row in each.
  RIVEN_INLINE int sorted_cell(int i, int j) const {
    return (j / tile * tiles_x() + i / tile) * tile * tile + j % tile * tile + i % tile;
  }
  RIVEN_INLINE Vec2 position(int node) const { return position(node % nx, node / nx); }
  /// Rounded once, by fma, so that every kernel sees a node at the same place to the last bit.
  RIVEN_INLINE Vec2 position(int i, int j) const { return {std::fma(h, i, origin.x), std::fma(h, j, origin.y)}; }
};

/// A lattice whose walls are the given box, with ghost layers around it.
/// Throws Error (bad input) if the box is no whole number of cells or too large to number.
Lattice make_lattice(Vec2 lower, Vec2 upper, double cell);

/// Entries of the full mass matrix (kernels/full_mass.hpp) that a node holds, and one that takes nothing.
inline constexpr int full_mass_entries = 16;

/// Node data. All node vectors are groups of four, so that one kernel serves them all. After particle-to-grid q holds
/// [px py fx fy], after the grid is advanced [vx vy ax ay].
template <class Real>
struct Grid {
  Lattice lattice;
  exec::Array<Real> mass;       ///< [slots]
  exec::Array<Real> q;          ///< [4 slots]
  exec::Array<Real> again;      ///< [4 slots] [px py . .] of the second extrapolation (MUSL, USAVG), then [v w]
  exec::Array<Real> high;       ///< [4 slots] [vx vy . .], higher-order velocity (XPIC, FMPM)
  exec::Array<Real> term;       ///< [4 slots] one term of the higher-order series
  exec::Array<Real> next;       ///< [4 slots] the term after it
  exec::Array<Real> full_mass;  ///< [full_mass_entries nodes] see kernels/full_mass.hpp

  int slots() const { return static_cast<int>(mass.size()); }
};

}  // namespace riven
