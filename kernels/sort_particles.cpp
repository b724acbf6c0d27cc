#include "kernels/sort_particles.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "core/exec/sort_by_key.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/report_trouble.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

namespace {

constexpr int cells_per_tile = Lattice::tile * Lattice::tile;

/// Drift in cells after which a sort pays although none is due. The particles that a node sees are looked for in three
/// cells along each axis up to a drift of a quarter, in five beyond; those of a tile spread over more nodes; and fewer
/// follow each other in one cell, to be taken together.
constexpr double worth_while = 0.24;

/// Steps since the last sort from which one pays then. It costs about a third of a step of two passes. Of the passes
/// of USAVG and USF most gain a tenth where particles are in their cells; with cracks, crossings are to be found anew.
long seldom(const Plan& plan) {
  return plan.stress_before() && !plan.cracks ? 8 : 64;
}

/// Sorting key of a position: tile by tile, cell by cell; -1 outside of the walls.
template <class Shape>
RIVEN_INLINE int key_of(const Lattice& l, double X, double Y) {
  const int i = Shape::cell(X), j = Shape::cell(Y);
  const bool inside =
      i >= l.wall_lower[0] - 1 && i <= l.wall_upper[0] + 1 && j >= l.wall_lower[1] - 1 && j <= l.wall_upper[1] + 1;
  return inside ? l.sorted_cell(i, j) : -1;
}

template <class Shape, class Real>
void find_keys(const exec::Space& space, const Lattice& lattice, const Particles<Real, 2>& p, exec::Array<int>& keys) {
  const Lattice l = lattice;
  const double *x = exec::data(p.x[0]), *y = exec::data(p.x[1]);
  const double ox = l.origin.x, oy = l.origin.y, inv = 1 / l.h;
  int* key = exec::data_to_fill(keys);
  exec::parallel_for(space, "sort particles: keys", p.count(),
                     [=] RIVEN_KERNEL(long i) { key[i] = key_of<Shape>(l, (x[i] - ox) * inv, (y[i] - oy) * inv); });
}

struct Least {
  long value = std::numeric_limits<long>::max();
  RIVEN_FN Least& operator+=(const Least& o) {
    value = o.value < value ? o.value : value;
    return *this;
  }
};

/// The first particle that no cell has, or the largest number.
long first_outside(const exec::Space& space, const exec::Array<int>& keys) {
  const int* key = exec::data(keys);
  return exec::parallel_sum<Least>(space, "sort particles: keys", keys.size(),
                                   [=] RIVEN_KERNEL(long i, Least& least) {
                                     if (key[i] < 0)
                                       least += Least{i};
                                   })
      .value;
}

/// Moves one array to the new order, through `spare`.
template <class T>
void permute(const exec::Space& space, exec::Array<T>& array, exec::Array<T>& spare, const int* order) {
  spare.resize(array.size());
  T* to = exec::data_to_fill(spare);
  const T* from = exec::data(std::as_const(array));
  exec::parallel_for(space, "sort particles: move", array.size(), [=] RIVEN_KERNEL(long i) { to[i] = from[order[i]]; });
  array.swap(spare);
}

}  // namespace

void find_loaded(const exec::Space& space, const exec::Array<int>& ids, Loads& loads) {
  if (loads.position.empty())
    return;
  exec::parallel_for(space, "sort particles: loads", ids.size(),
                     [id = exec::data(ids), position = exec::data_to_fill(loads.position)] RIVEN_KERNEL(long i) {
                       position[id[i]] = static_cast<int>(i);
                     });
}

void list_tiles(const Lattice& l, Tiles& t) {
  const exec::Array<int>& start = t.start;
  std::vector<int> filled, by_colour;
  for (int tile = 0; tile < l.tiles_x() * l.tiles_y(); ++tile)
    if (start[tile] < start[tile + 1])
      filled.push_back(tile);
  for (int c = 0; c < 4; ++c) {
    t.colour_start[c] = static_cast<int>(by_colour.size());
    std::copy_if(filled.begin(), filled.end(), std::back_inserter(by_colour),
                 [&](int tile) { return tile % l.tiles_x() % 2 + 2 * (tile / l.tiles_x() % 2) == c; });
  }
  t.colour_start[4] = static_cast<int>(by_colour.size());
  for (const auto& [list, to] : {std::pair{&filled, &t.filled}, std::pair{&by_colour, &t.by_colour}}) {
    to->resize(static_cast<long>(list->size()));
    std::copy(list->begin(), list->end(), to->begin());
  }
}

template <class Real>
bool sort_due(const Plan& plan, const State<Real, 2>& s) {
  const bool never = s.particles.tiles.start.empty();
  // the next step may move particles as far as the last one did, and a little more
  const double drift = (s.watch.drift + 1.5 * s.watch.largest_move) / s.grid.lattice.h;
  return never || drift > 0.95 || (drift > worth_while && s.clock.step - s.watch.sorted_at >= seldom(plan));
}

template <class Real>
void sort_particles(const exec::Space& space, const Plan& plan, State<Real, 2>& s) {
  auto& p = s.particles;
  const Lattice l = s.grid.lattice;
  exec::Array<int> key(p.count()), start, order;
  with_shape(plan.shape, [&](auto shape) { find_keys<typename decltype(shape)::type>(space, l, p, key); });
  if (const long lost = first_outside(space, key); lost < p.count())
    particle_left_grid(s, lost);
  exec::sort_by_key(space, "sort particles: order", key, l.nodes(), start, order);
  const int tiles = l.tiles_x() * l.tiles_y();
  p.tiles.start.resize(tiles + 1);
  exec::parallel_for(space, "sort particles: tiles", tiles + 1,
                     [to = exec::data_to_fill(p.tiles.start), from = exec::data(std::as_const(start))] RIVEN_KERNEL(
                         long t) { to[t] = from[t * cells_per_tile]; });
  if (plan.contact || plan.anchors())
    p.tiles.cell_start.swap(start);

  std::tuple<exec::Array<double>, exec::Array<float>, exec::Array<int>, exec::Array<std::uint8_t>> spare;
  p.each_array([&](auto& a) {
    permute(space, a, std::get<std::remove_reference_t<decltype(a)>>(spare), exec::data(std::as_const(order)));
  });
  ++p.tiles.order;
  list_tiles(l, p.tiles);
  for (auto* a : {&s.watch.tile_move, &s.watch.tile_J, &s.watch.tile_finite, &s.watch.tile_worn, &s.watch.tile_apart})
    a->resize(tiles);
  s.watch.drift = 0;
  s.watch.sorted_at = s.clock.step;
  find_loaded(space, p.id, s.loads);
}

#define RIVEN_SORT_PARTICLES(Real)                            \
  template bool sort_due(const Plan&, const State<Real, 2>&); \
  template void sort_particles(const exec::Space&, const Plan&, State<Real, 2>&);
RIVEN_EACH_REAL(RIVEN_SORT_PARTICLES)
#undef RIVEN_SORT_PARTICLES

}  // namespace RIVEN_SIDE

}  // namespace riven
