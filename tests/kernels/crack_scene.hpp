// Small scenes for the crack kernels: a grid of unit cells, particles where a test wants them, sorted by tile and cell.
#pragma once
#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "core/math/shape.hpp"
#include "core/state/bodies.hpp"
#include "core/state/cracks.hpp"
#include "core/state/grid.hpp"
#include "core/state/particles.hpp"
#include "kernels/assign_fields.hpp"
#include "kernels/hash_cracks.hpp"

namespace riven::crack_scene {

inline Lattice unit_cells(int cells_x, int cells_y) {
  return make_lattice({0, 0}, {double(cells_x), double(cells_y)}, 1);
}

inline DomainSetting<double, 2> quarter_cells(const Lattice& l) {
  DomainSetting<double, 2> d;
  for (int a = 0; a < 2; ++a)
    d.axis[a] = {0.25, 1, l.wall_lower[a], l.wall_upper[a]};
  return d;
}

inline Cracks cracks_of(const std::vector<std::vector<Vec2>>& lines, double resolution = 1e9,
                        SurfaceUpdate update = SurfaceUpdate::xpic) {
  Scene scene;
  scene.surface_update = update;
  for (const auto& points : lines) {
    CrackLine line;
    line.name = "crack " + std::to_string(scene.cracks.size());
    line.points = points;
    scene.cracks.push_back(line);
  }
  return make_cracks(scene, resolution);
}

/// Normal, now and of the first positions, of the k-th crack that a flagged node holds.
inline std::array<Vec2, 2> normals_of(const CrackFields& fields, long flagged, int k) {
  if (k < 2)
    return {fields.normals[flagged].now[k], fields.normals[flagged].first[k]};
  const ThirdNormal& third = fields.third_normals[fields.nodes[flagged].third];
  return {third.now, third.first};
}

/// use(particle, memory) for what is known of the particles of marked tiles.
template <class Use>
void each_known(const CrackFields& fields, const Tiles& tiles, const Use& use) {
  for (long m = 0; m < fields.marked_tiles.size(); ++m) {
    const int* start = tiles.start.data() + fields.marked_tiles[m];
    for (int p = start[0]; p < start[1]; ++p)
      use(p, fields.memory[p + fields.tiles[m].known]);
  }
}

/// Particles with the given ids, laid down in that order and then sorted.
template <class Shape>
Particles<double, 2> sorted_particles(const Lattice& l, const std::vector<Vec2>& x, const std::vector<int>& ids) {
  const auto cell = [&](int id, int axis) {
    const Vec2 at = (x[static_cast<size_t>(id)] - l.origin) * (1 / l.h);
    return Shape::cell(axis == 0 ? at.x : at.y);
  };
  const auto tile = [&](int id) { return cell(id, 1) / Lattice::tile * l.tiles_x() + cell(id, 0) / Lattice::tile; };
  std::vector<int> order = ids;
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    const auto key = [&](int id) { return std::array{tile(id), cell(id, 1), cell(id, 0)}; };
    return key(a) < key(b);
  });
  Particles<double, 2> p;
  const long n = static_cast<long>(order.size());
  for (auto& a : p.x)
    a.resize(n);
  p.body.resize(n);
  p.id.resize(n);
  p.tiles.start.resize(l.tiles_x() * l.tiles_y() + 1);
  p.tiles.cell_start.resize(l.nodes() + 1);
  for (long i = 0; i < n; ++i) {
    const int id = order[static_cast<size_t>(i)];
    p.id[i] = id;
    p.x[0][i] = x[static_cast<size_t>(id)].x;
    p.x[1][i] = x[static_cast<size_t>(id)].y;
    ++p.tiles.start[tile(id) + 1];
    ++p.tiles.cell_start[l.sorted_cell(cell(id, 0), cell(id, 1)) + 1];
  }
  for (exec::Array<int>* start : {&p.tiles.start, &p.tiles.cell_start})
    std::partial_sum(start->begin(), start->end(), start->begin());
  // another number for another order
  std::uint64_t hash = 14695981039346656037u;
  for (const auto* list : {&p.id, &p.tiles.start})
    for (const int n : *list)
      hash = (hash ^ static_cast<std::uint64_t>(n)) * 1099511628211u;
  p.tiles.order = static_cast<long>(hash >> 1);
  return p;
}

inline std::vector<int> in_order(size_t n) {
  std::vector<int> ids(n);
  std::iota(ids.begin(), ids.end(), 0);
  return ids;
}

}  // namespace riven::crack_scene
