#include <cmath>

#include "core/error.hpp"
#include "core/state/grid.hpp"

namespace riven {

namespace {

int whole_cells(double length, double cell, const char* axis) {
  const double n = std::round(length / cell);
  if (n < 1 || std::abs(n * cell - length) > 1e-6 * cell)
    fail({Exit::bad_input, "the grid is not a whole number of cells", std::string("grid, along ") + axis,
          std::to_string(length / cell) + " cells", "a whole number", "another cell size, or another upper corner"});
  if (n > 1e5)
    fail({Exit::bad_input, "the grid has too many cells", std::string("grid, along ") + axis, std::to_string(n),
          "100000 along an axis", "larger cells"});
  return static_cast<int>(n);
}

int up_to_tiles(int nodes) {
  return (nodes + Lattice::tile - 1) / Lattice::tile * Lattice::tile;
}

}  // namespace

Lattice make_lattice(Vec2 lower, Vec2 upper, double cell) {
  Lattice l;
  l.h = cell;
  const int cells[2] = {whole_cells(upper.x - lower.x, cell, "x"), whole_cells(upper.y - lower.y, cell, "y")};
  for (int d = 0; d < 2; ++d) {
    l.wall_lower[d] = Lattice::ghosts;
    l.wall_upper[d] = Lattice::ghosts + cells[d];
  }
  l.nx = up_to_tiles(l.wall_upper[0] + 1 + Lattice::ghosts);
  l.ny = up_to_tiles(l.wall_upper[1] + 1 + Lattice::ghosts);
  l.origin = lower - cell * Vec2{double(Lattice::ghosts), double(Lattice::ghosts)};
  if (static_cast<double>(l.nx) * l.ny > 5e8)
    fail({Exit::bad_input, "the grid has too many nodes", "grid", std::to_string(static_cast<double>(l.nx) * l.ny),
          "500 million", "larger cells"});
  return l;
}

}  // namespace riven
