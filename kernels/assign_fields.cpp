#include "kernels/assign_fields.hpp"

#include <algorithm>
#include <climits>
#include <utility>

#include "core/exec/atomic.hpp"
#include "core/exec/bits.hpp"
#include "core/exec/parallel.hpp"
#include "core/math/shape.hpp"
#include "kernels/average_normals.hpp"
#include "kernels/cells_around.hpp"
#include "kernels/trace_crossings.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

namespace {

/// What nodes that may see cracks hold.
struct NodeHolder {
  ListsView lists;
  const int* start;        ///< Cracks
  const EndOnCrack* ends;  ///< CrackFields; null where there are none
  const int* tally;        ///< CrackFields, as all that follow
  NodeCracks* nodes;
  std::uint8_t *verdict, *held;
  TileTrace* tiles;

  /// Sees which cracks node f holds, and what a crossing of each entry means. If that has changed, tells the tiles
  /// whose particles may see the node.
  RIVEN_FN void hold(long f) const {
    NodeCracks& node = nodes[f];
    const int first = lists.candidate_start[f], last = lists.candidate_start[f + 1];
    int most[most_held] = {};
    const int found = most_crossed(first, last, most);
    NodeCracks now;
    now.node = node.node;
    now.extra = node.extra;
    now.sees = node.sees;
    now.third = node.third;
    bool changed = false;
    int count = 0, held_at[most_held] = {};
    for (int c = first; c < last; ++c) {
      const int above = 2 * c, below = above + 1;
      std::uint8_t means[2] = {fourth_crack, fourth_crack};
      if (std::find(most, most + found, c) != most + found) {
        const bool from_above = tally[above] >= tally[below];
        now.crack[count] = lists.candidate[c];
        now.side[count] = from_above ? Side::above : Side::below;
        held_at[count] = c;
        means[from_above ? 0 : 1] = static_cast<std::uint8_t>(1 << count);
        means[from_above ? 1 : 0] = other_side;
        ++count;
      }
      for (int side = 0; side < 2; ++side) {
        changed = changed || verdict[above + side] != means[side];
        verdict[above + side] = means[side];
      }
    }
    for (int k = 0; count > 1 && ends != nullptr && k < count; ++k)
      look_behind(held_at[k], k, now);
    node = now;
    held[f] = static_cast<std::uint8_t>(count);
    if (changed)
      each_tile_around(lists.lattice, node.node, 1, [&](int tile) {
        if (const int m = lists.tile_marked[tile])
          exec::atomic_set(tiles[m - 1].changed, 1);
      });
  }

 private:
  /// Sees whether the node lies behind a crack on which the one that it holds as its k-th, its candidate c, ends.
  RIVEN_FN void look_behind(int c, int k, NodeCracks& node) const {
    const int crack = lists.candidate[c], *segment = lists.node_segment + lists.segment_start[c],
              *last = lists.node_segment + lists.segment_start[c + 1] - 1;
    const bool sees[2] = {*segment == start[crack], *last + 2 == start[crack + 1]};
    for (int end = 0; end < 2; ++end) {
      const EndOnCrack& on = ends[2 * crack + end];
      const int host = on.host < 0 || !sees[end] ? -1 : node.which(on.host);
      if (host >= 0 && node.side[host] == on.from)
        node.behind = static_cast<std::uint8_t>(1 + host + most_held * k);
    }
  }

  RIVEN_FN int crossings(int c) const { return tally[2 * c] + tally[2 * c + 1]; }

  /// The candidates of [first, last) by falling number of crossings, as many as a node can hold; returns how many.
  RIVEN_FN int most_crossed(int first, int last, int* most) const {
    int found = 0;
    for (int c = first; c < last; ++c) {
      if (crossings(c) == 0)
        continue;
      int at = found;
      while (at > 0 && crossings(most[at - 1]) < crossings(c))
        --at;
      if (at == most_held)
        continue;
      found = found < most_held ? found + 1 : found;
      std::copy_backward(most + at, most + found - 1, most + found);
      most[at] = c;
    }
    return found;
  }
};

/// The fields of the particles of marked tiles, and their slots, block by block.
struct FieldSetter {
  struct Warnings {
    int count[2];
  };

  Lattice lattice;
  int nodes_seen;  ///< by a particle
  const int *marked_tiles, *tile_start;
  const CrossingMemory* memory;  ///< CrackFields, as all that follow
  const CrossingRecord* records;
  const std::uint8_t* verdict;
  const NodeCracks* nodes;
  const int* extra;
  TileTrace* tiles;
  std::uint32_t* fields;
  std::uint16_t* crossing;
  int *block_slots, *slots;

  /// The fields of a marked tile's particles, and how many of them cross. The slots of a block are numbered from 0 on.
  RIVEN_KERNEL void set_fields(const exec::Team& team, Warnings& warned, long marked) const {
    TileTrace& tile = tiles[marked];
    if (!tile.changed)
      return;
    const long first_block = CrackFields::block_of(first(marked), marked);
    team.each(2, [&](long kind) { warned.count[kind] = 0; });
    team.each(blocks(marked), [&](long b) {
      crossing[first_block + b] = fields_of_block(first(marked) + b * exec::block, last(marked), tile.known, warned);
    });
    team.each(1, [&](long) {
      int crossed = 0;
      for (long b = first_block; b < first_block + blocks(marked); ++b) {
        block_slots[b] = nodes_seen * crossed;
        crossed += exec::bits_of(crossing[b]);
      }
      tile.crossing = crossed;
      std::copy(warned.count, warned.count + 2, tile.warnings);
    });
  }

  /// Writes the slots of a tile's particles that cross.
  template <class Shape>
  RIVEN_KERNEL void set_slots(const exec::Team& team, long marked) const {
    TileTrace& tile = tiles[marked];
    if (!tile.changed)
      return;
    const long first_block = CrackFields::block_of(first(marked), marked);
    team.each(blocks(marked), [&](long b) {
      const long begin = first(marked) + b * exec::block, end = std::min(begin + exec::block, last(marked));
      int* slot = slots + (block_slots[first_block + b] += tile.slots);
      for (long p = begin; p < end; ++p)
        if (fields[p] != 0)
          slot = put_slots<Shape>(p, tile.known, slot);
    });
    team.each(1, [&](long) { tile.changed = 0; });
  }

 private:
  RIVEN_FN long first(long marked) const { return tile_start[marked_tiles[marked]]; }
  RIVEN_FN long last(long marked) const { return tile_start[marked_tiles[marked] + 1]; }
  RIVEN_FN long blocks(long marked) const { return (last(marked) - first(marked) + exec::block - 1) / exec::block; }

  /// Sets `fields` of the particles from `begin` on; returns a bit for each that crosses.
  RIVEN_FN std::uint16_t fields_of_block(long begin, long last, int known, Warnings& warned) const {
    unsigned crossed = 0;
    for (long p = begin; p < std::min(begin + exec::block, last); ++p) {
      const CrossingMemory& m = memory[p + known];
      std::uint32_t word = 0;
      for (int r = m.first; r < m.first + m.count; ++r) {
        if (!records[r].weighs)
          continue;
        const std::uint8_t meaning = verdict[records[r].entry];
        if (meaning < other_side)
          word |= static_cast<std::uint32_t>(meaning) << (CrackFields::bits * records[r].neighbour);
        else
          exec::atomic_add(warned.count[meaning == fourth_crack], 1);
      }
      fields[p] = word;
      crossed |= static_cast<unsigned>(word != 0) << (p - begin);
    }
    return static_cast<std::uint16_t>(crossed);
  }

  template <class Shape>
  RIVEN_FN int* put_slots(long p, int known, int* slot) const {
    constexpr int N = Shape::width;
    const CrossingRecord& any = records[memory[p + known].first];
    const int corner = nodes[any.node].node - any.neighbour / N * lattice.nx - any.neighbour % N;
    for (int n = 0; n < N * N; ++n) {
      const int node = corner + n / N * lattice.nx + n % N, field = CrackFields::field_of(fields[p], n);
      *slot++ = field == 0 ? node : lattice.nodes() + extra[node] + field - 1;
    }
    return slot;
  }
};

/// What the fields of all tiles ask for.
struct Demand {
  long tiles = 0;  ///< without room for the slots of their particles
  long warnings[2] = {};
  RIVEN_FN Demand& operator+=(const Demand& o) {
    tiles += o.tiles;
    for (int kind = 0; kind < 2; ++kind)
      warnings[kind] += o.warnings[kind];
    return *this;
  }
};

Demand demand(const exec::Space& space, const CrackFields& fields) {
  return exec::parallel_sum<Demand>(space, "assign fields", fields.tiles.size(),
                                    [tile = exec::data(fields.tiles)] RIVEN_KERNEL(long m, Demand& sum) {
                                      sum.tiles += tile[m].crossing > tile[m].room;
                                      for (int kind = 0; kind < 2; ++kind)
                                        sum.warnings[kind] += tile[m].warnings[kind];
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

/// The node of the first warning of a kind, by particle number and neighbour.
template <class Real>
Vec2 first_warning(const CrackFields& fields, const Particles<Real, 2>& particles, const Lattice& lattice, int kind) {
  const CrossingVerdict verdict = kind == 0 ? other_side : fourth_crack;
  std::pair<int, int> first{INT_MAX, 0};
  int node = 0;
  for (long m = 0; m < fields.tiles.size(); ++m) {
    if (fields.tiles[m].warnings[kind] == 0)
      continue;
    const int* start = particles.tiles.start.data() + fields.marked_tiles[m];
    for (long p = start[0]; p < start[1]; ++p) {
      const CrossingMemory& memory = fields.memory[p + fields.tiles[m].known];
      for (int i = memory.first; i < memory.first + memory.count; ++i) {
        const CrossingRecord& r = fields.records[i];
        const std::pair<int, int> here{particles.id[p], r.neighbour};
        if (!r.weighs || fields.verdict[r.entry] != verdict || !(here < first))
          continue;
        first = here;
        node = fields.nodes[r.node].node;
      }
    }
  }
  return lattice.position(node);
}

/// What the nodes hold by the crossings of their particles, and the normals of what they hold.
void assign_nodes(const exec::Space& space, const Lattice& lattice, const Cracks& cracks, CrackFields& fields) {
  const ListsView lists = lists_view(lattice, fields);
  const NodeHolder holder{lists,
                          exec::data(cracks.start),
                          fields.ends.empty() ? nullptr : exec::data(std::as_const(fields.ends)),
                          exec::data(std::as_const(fields.tally)),
                          exec::data(fields.nodes),
                          exec::data(fields.verdict),
                          exec::data(fields.held),
                          exec::data(fields.tiles)};
  const long points = cracks.points();
  fields.segment_normals.renew(points);
  exec::launch_some(space, points - 1, exec::few,
                    [=, plane = exec::data(cracks.plane), first = exec::data(cracks.plane0),
                     out = exec::data_to_fill(fields.segment_normals)] RIVEN_KERNEL(long k) {
                      out[k] = segment_normal(lattice, plane, first, k);
                    });
  const NormalAverager averager{lists,
                                exec::data(cracks.plane),
                                exec::data(std::as_const(fields.segment_normals)),
                                exec::data(std::as_const(fields.nodes)),
                                exec::data(std::as_const(fields.held)),
                                exec::data_to_fill(fields.normals),
                                exec::data(fields.third_normals)};
  exec::parallel_for(
      space, "assign fields", fields.nodes.size(),
      [=, recount = exec::data(fields.recount)] RIVEN_KERNEL(long f) {
        if (recount[f]) {
          recount[f] = 0;
          holder.hold(f);
        }
        averager.find(f);
      },
      exec::few);
}

/// The fields of the particles of marked tiles, and their slots.
template <class Shape, class Real>
void assign_particles(const exec::Space& space, const Particles<Real, 2>& particles, const Lattice& lattice,
                      CrackFields& fields) {
  constexpr int seen = Shape::width * Shape::width;
  const auto setter = [&] {
    return FieldSetter{lattice,
                       seen,
                       exec::data(std::as_const(fields.marked_tiles)),
                       exec::data(particles.tiles.start),
                       exec::data(std::as_const(fields.memory)),
                       exec::data(std::as_const(fields.records)),
                       exec::data(std::as_const(fields.verdict)),
                       exec::data(std::as_const(fields.nodes)),
                       exec::data(std::as_const(fields.extra)),
                       exec::data(fields.tiles),
                       exec::data(fields.fields),
                       exec::data(fields.crossing),
                       exec::data(fields.block_slots),
                       exec::data(fields.slots)};
  };
  const FieldSetter first = setter();
  exec::parallel_teams<FieldSetter::Warnings>(space, "assign fields", fields.tiles.size(),
                                              [=] RIVEN_KERNEL(const exec::Team& team, FieldSetter::Warnings& warned,
                                                               long m) { first.set_fields(team, warned, m); });
  const Demand asked = demand(space, fields);
  if (asked.tiles > 0)
    make_room(seen, fields);
  const FieldSetter then = setter();
  exec::parallel_teams<char>(
      space, "assign fields", fields.tiles.size(),
      [=] RIVEN_KERNEL(const exec::Team& team, char&, long m) { then.template set_slots<Shape>(team, m); });
  long* const total[2] = {&fields.warning_both_sides, &fields.warning_fourth_crack};
  for (int kind = 0; kind < 2; ++kind) {
    if (asked.warnings[kind] > 0 && *total[kind] == 0)
      fields.warning_place[kind] = first_warning(fields, particles, lattice, kind);
    *total[kind] += asked.warnings[kind];
  }
}

}  // namespace

template <class Shape, class Real>
void determine_fields(const exec::Space& space, const Particles<Real, 2>& particles,
                      const DomainSetting<Real, 2>* domains, const Lattice& lattice, const Cracks& cracks,
                      CrackFields& fields, const double* tile_move) {
  trace_crossings<Shape, Real>(space, particles, domains, lattice, cracks, tile_move, fields);
  assign_nodes(space, lattice, cracks, fields);
  assign_particles<Shape>(space, particles, lattice, fields);
}

#define RIVEN_DETERMINE(Shape, Real)                                                                        \
  template void determine_fields<Shape, Real>(const exec::Space&, const Particles<Real, 2>&,                \
                                              const DomainSetting<Real, 2>*, const Lattice&, const Cracks&, \
                                              CrackFields&, const double*);
#define RIVEN_DETERMINE_EACH(Real) RIVEN_EACH_SHAPE(RIVEN_DETERMINE, Real)
RIVEN_EACH_REAL(RIVEN_DETERMINE_EACH)
#undef RIVEN_DETERMINE_EACH
#undef RIVEN_DETERMINE

}  // namespace RIVEN_SIDE

}  // namespace riven
