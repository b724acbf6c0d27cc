#include "kernels/assign_fields.hpp"

#include <algorithm>
#include <atomic>
#include <climits>
#include <utility>

#include "core/exec/parallel.hpp"
#include "core/math/shape.hpp"
#include "kernels/average_normals.hpp"
#include "kernels/cells_around.hpp"
#include "kernels/trace_crossings.hpp"

namespace riven {

namespace {

/// Tells the tiles whose particles may see the node that its cracks have changed.
void mark_changed(const Lattice& lattice, int node, CrackFields& fields) {
  each_tile_around(lattice, node, 1, [&](int tile) {
    if (const int m = fields.tile_marked[tile])
      std::atomic_ref<int>(fields.tiles[m - 1].changed).store(1, std::memory_order_relaxed);
  });
}

/// Which cracks a node holds, and what a crossing of each entry means. Returns whether that has changed.
bool hold_cracks(CrackFields& fields, long f) {
  NodeCracks& node = fields.nodes[f];
  const int first = fields.candidate_start[f], last = fields.candidate_start[f + 1];
  const auto crossings = [&](int c) { return fields.tally[2 * c] + fields.tally[2 * c + 1]; };
  int most[most_held] = {}, found = 0;  // candidates, by falling number of crossings
  for (int c = first; c < last; ++c) {
    if (crossings(c) == 0)
      continue;
    int at = found;
    while (at > 0 && crossings(most[at - 1]) < crossings(c))
      --at;
    if (at == most_held)
      continue;
    found = std::min(found + 1, most_held);
    std::copy_backward(most + at, most + found - 1, most + found);
    most[at] = c;
  }
  NodeCracks now;
  now.node = node.node;
  now.extra = node.extra;
  now.sees = node.sees;
  now.third = node.third;
  bool changed = false;
  int held = 0;
  for (int c = first; c < last; ++c) {
    const int above = 2 * c, below = above + 1;
    std::uint8_t means[2] = {fourth_crack, fourth_crack};
    if (std::find(most, most + found, c) != most + found) {
      const bool from_above = fields.tally[above] >= fields.tally[below];
      now.crack[held] = fields.candidate[c];
      now.side[held] = from_above ? Side::above : Side::below;
      means[from_above ? 0 : 1] = static_cast<std::uint8_t>(1 << held);
      means[from_above ? 1 : 0] = other_side;
      ++held;
    }
    for (int side = 0; side < 2; ++side) {
      changed = changed || fields.verdict[above + side] != means[side];
      fields.verdict[above + side] = means[side];
    }
  }
  node = now;
  fields.held[f] = static_cast<std::uint8_t>(held);
  return changed;
}

/// f(particle, record) for the records of each particle of a marked tile that weigh.
template <class F>
void each_record(const CrackFields& fields, long marked, long first, long last, const F& f) {
  const int known = fields.tiles[marked].known;
  for (long p = first; p < last; ++p) {
    const CrossingMemory& m = fields.memory[p + known];
    for (int r = m.first; r < m.first + m.count; ++r)
      if (fields.records[r].weighs)
        f(p, fields.records[r]);
  }
}

/// The fields of the particles of a marked tile.
void set_fields(CrackFields& fields, long marked, long first, long last) {
  TileTrace& tile = fields.tiles[marked];
  std::uint16_t* const crossing = fields.crossing.data() + CrackFields::block_of(first, marked);
  std::fill(fields.fields.begin() + first, fields.fields.begin() + last, 0u);
  std::fill(crossing, crossing + (last - first + exec::lanes - 1) / exec::lanes, std::uint16_t{0});
  tile.warnings[0] = tile.warnings[1] = tile.crossing = 0;
  each_record(fields, marked, first, last, [&](long p, const CrossingRecord& r) {
    const std::uint8_t verdict = fields.verdict[r.entry];
    if (verdict < other_side) {
      const long lane = p - first;
      tile.crossing += fields.fields[p] == 0;
      fields.fields[p] |= static_cast<std::uint32_t>(verdict) << (CrackFields::bits * r.neighbour);
      crossing[lane / exec::lanes] |= static_cast<std::uint16_t>(1u << (lane % exec::lanes));
    } else {
      ++tile.warnings[verdict == fourth_crack];
    }
  });
}

/// Makes room for the slots of the particles that cross.
void make_room(int neighbours, CrackFields& fields) {
  for (TileTrace& tile : fields.tiles)
    if (tile.crossing > tile.room) {
      tile.room = tile.crossing + tile.crossing / 4;
      tile.slots = static_cast<int>(fields.slots_used);
      fields.slots_used += long{neighbours} * tile.room;
    }
  if (fields.slots_used > fields.slots.size())
    fields.slots.resize(fields.slots_used + fields.slots_used / 4);
}

/// Writes the slots of a tile's particles that cross.
template <class Shape>
void set_slots(const Lattice& lattice, CrackFields& fields, long marked, long first, long last) {
  constexpr int N = Shape::width;
  TileTrace& tile = fields.tiles[marked];
  tile.changed = 0;
  int* slot = fields.slots.data() + tile.slots;
  for (long p = first; p < last; ++p) {
    const long lane = (p - first) % exec::lanes, block = CrackFields::block_of(p, marked);
    if (lane == 0)
      fields.block_slots[block] = static_cast<int>(slot - fields.slots.data());
    const std::uint32_t word = fields.fields[p];
    if (word == 0)
      continue;
    const CrossingRecord& any = fields.records[fields.memory[p + tile.known].first];
    const int corner = fields.nodes[any.node].node - any.neighbour / N * lattice.nx - any.neighbour % N;
    for (int n = 0; n < N * N; ++n) {
      const int node = corner + n / N * lattice.nx + n % N, field = CrackFields::field_of(word, n);
      *slot++ = field == 0 ? node : lattice.nodes() + fields.extra[node] + field - 1;
    }
  }
}

/// The node of the first warning of a kind, by particle number and neighbour.
template <class Real>
Vec2 first_warning(const CrackFields& fields, const Particles<Real, 2>& particles, const Lattice& lattice, int kind) {
  std::pair<int, int> first{INT_MAX, 0};
  int node = 0;
  for (long m = 0; m < fields.tiles.size(); ++m) {
    if (fields.tiles[m].warnings[kind] == 0)
      continue;
    const int* start = particles.tiles.start.data() + fields.marked_tiles[m];
    each_record(fields, m, start[0], start[1], [&](long p, const CrossingRecord& r) {
      const std::pair<int, int> here{particles.id[p], r.neighbour};
      if (fields.verdict[r.entry] != (kind == 0 ? other_side : fourth_crack) || !(here < first))
        return;
      first = here;
      node = fields.nodes[r.node].node;
    });
  }
  return lattice.position(node);
}

}  // namespace

template <class Shape, class Real>
void determine_fields(const exec::Space& space, const Particles<Real, 2>& particles,
                      const DomainSetting<Real, 2>* domains, const Lattice& lattice, const Cracks& cracks,
                      CrackFields& fields, const double* tile_move) {
  trace_crossings<Shape, Real>(space, particles, domains, lattice, cracks, tile_move, fields);
  exec::parallel_for(space, "assign fields", fields.nodes.size(), [&](long f) {
    if (fields.recount[f]) {
      fields.recount[f] = 0;
      if (hold_cracks(fields, f))
        mark_changed(lattice, fields.nodes[f].node, fields);
    }
    fields.normals[f] = {};
  });
  fields.third_normals.zero();
  exec::parallel_tasks(space, "assign fields", cracks.count(),
                       [&](long c) { add_normals(lattice, cracks, static_cast<int>(c), fields); });
  exec::parallel_for(space, "assign fields", fields.nodes.size(),
                     [&](long f) { finish_normals(lattice, cracks, f, fields); });
  exec::parallel_tasks(space, "assign fields", fields.tiles.size(), [&](long m) {
    const int* start = particles.tiles.start.data() + fields.marked_tiles[m];
    if (fields.tiles[m].changed)
      set_fields(fields, m, start[0], start[1]);
  });
  make_room(Shape::width * Shape::width, fields);
  exec::parallel_tasks(space, "assign fields", fields.tiles.size(), [&](long m) {
    const int* start = particles.tiles.start.data() + fields.marked_tiles[m];
    if (fields.tiles[m].changed)
      set_slots<Shape>(lattice, fields, m, start[0], start[1]);
  });
  long* const total[2] = {&fields.warning_both_sides, &fields.warning_fourth_crack};
  for (int kind = 0; kind < 2; ++kind) {
    long count = 0;
    for (const TileTrace& t : fields.tiles)
      count += t.warnings[kind];
    if (count > 0 && *total[kind] == 0)
      fields.warning_place[kind] = first_warning(fields, particles, lattice, kind);
    *total[kind] += count;
  }
}

#define RIVEN_DETERMINE(Shape, Real)                                                                        \
  template void determine_fields<Shape, Real>(const exec::Space&, const Particles<Real, 2>&,                \
                                              const DomainSetting<Real, 2>*, const Lattice&, const Cracks&, \
                                              CrackFields&, const double*);
#define RIVEN_DETERMINE_EACH(Real) RIVEN_EACH_SHAPE(RIVEN_DETERMINE, Real)
RIVEN_EACH_REAL(RIVEN_DETERMINE_EACH)
#undef RIVEN_DETERMINE_EACH
#undef RIVEN_DETERMINE

}  // namespace riven
