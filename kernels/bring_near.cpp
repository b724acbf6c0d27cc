#include "kernels/bring_near.hpp"

#include <algorithm>
#include <cmath>

#include "core/exec/parallel.hpp"
#include "kernels/field_slots.hpp"

namespace riven {

namespace {

/// The tiles around places, ascending.
std::vector<int> tiles_near(const Lattice& l, const std::vector<Vec2>& places, double cells) {
  std::vector<bool> near(static_cast<size_t>(l.tiles_x() * l.tiles_y()));
  const auto tile = [](double X, int n) {
    return std::clamp(static_cast<int>(std::floor(X)), 0, n - 1) / Lattice::tile;
  };
  for (const Vec2 place : places) {
    const Vec2 X = (place - l.origin) * (1 / l.h);
    for (int j = tile(X.y - cells, l.ny); j <= tile(X.y + cells, l.ny); ++j)
      for (int i = tile(X.x - cells, l.nx); i <= tile(X.x + cells, l.nx); ++i)
        near[static_cast<size_t>(j * l.tiles_x() + i)] = true;
  }
  std::vector<int> list;
  for (size_t t = 0; t < near.size(); ++t)
    if (near[t])
      list.push_back(static_cast<int>(t));
  return list;
}

/// Appends a range, or lengthens the last one if it follows that.
void append(std::vector<exec::Range>& list, long first, long last) {
  if (first == last)
    return;
  if (!list.empty() && list.back().last == first)
    list.back().last = last;
  else
    list.push_back({first, last});
}

/// Of numbers of the nodes of tiles, four each: those of field 0, then those of the others.
std::vector<exec::Range> ranges_of_nodes(const Lattice& l, const CrackFields& fields, const std::vector<int>& tiles) {
  std::vector<exec::Range> list, others;
  const FieldSlots slots(fields, l.nodes());
  for (const int t : tiles)
    for (int j = 0; j < Lattice::tile; ++j) {
      const int first = (t / l.tiles_x() * Lattice::tile + j) * l.nx + t % l.tiles_x() * Lattice::tile;
      append(list, 4L * first, 4L * (first + Lattice::tile));
      for (int node = first; node < first + Lattice::tile; ++node)
        if (const int count = slots.count(node); count > 1)
          append(others, 4 * slots.of(node, 1), 4 * (slots.of(node, count - 1) + 1));
    }
  list.insert(list.end(), others.begin(), others.end());
  return list;
}

}  // namespace

template <class Real>
void bring_near(const exec::Space& space, const State<Real, 2>& s, const std::vector<Vec2>& places, double cells,
                exec::PartsOnHost& parts) {
  if (!space.on_device() || places.empty())
    return;
  const exec::Stopwatch watch(space.timers(), "bring what is near");
  const std::vector<int> tiles = tiles_near(s.grid.lattice, places, cells);
  std::vector<exec::Range> particles;
  const int* start = s.particles.tiles.start.data();
  for (const int t : tiles)
    append(particles, start[t], start[t + 1]);
  const auto& p = s.particles;
  parts.bring(particles, p.x[0], p.x[1], p.v[0], p.v[1], p.F[0], p.F[1], p.F[2], p.F[3], p.J, p.stress[0], p.stress[1],
              p.stress[2], p.mass, p.x0[0], p.x0[1], p.body, p.id, s.fields.fields);
  parts.bring(ranges_of_nodes(s.grid.lattice, s.fields, tiles), s.grid.q);
}

#define RIVEN_BRING(Real)                                                                               \
  template void bring_near(const exec::Space&, const State<Real, 2>&, const std::vector<Vec2>&, double, \
                           exec::PartsOnHost&);
RIVEN_EACH_REAL(RIVEN_BRING)
#undef RIVEN_BRING

}  // namespace riven
