#include "kernels/carry_traces.hpp"

#include <algorithm>
#include <limits>

#include "core/exec/atomic.hpp"
#include "core/exec/parallel.hpp"
#include "core/fracture/crack_path.hpp"
#include "kernels/known_particles.hpp"
#include "kernels/turned.hpp"

namespace riven {

namespace {

/// Cells, and nodes, of one task.
constexpr long some = 512;

/// Points and segments of the former lists in the new ones.
class PointMap {
 public:
  PointMap(const CrackLists& former, const CrackLists& now)
      : former_of(now.serial.size()),
        now_of(former.serial.size()),
        is_new(now.serial.size()),
        is_gone(former.serial.size()) {
    exec::Array<int> by_serial(now.serial.size());
    for (int& k : by_serial)
      k = -1;
    for (int k = 0; k < former.serial.size(); ++k)
      by_serial[former.serial[k]] = k;
    for (int k = 0; k < now.serial.size(); ++k) {
      former_of[k] = by_serial[now.serial[k]];
      if (former_of[k] >= 0)
        now_of[former_of[k]] = k;
    }
    const auto stays = [&](int k) { return former_of[k] >= 0 && former.kind[former_of[k]] == now.kind[k]; };
    for (std::uint8_t& gone : is_gone)
      gone = 1;
    for (int k = 0; k < now.serial.size(); ++k) {
      const bool same = k + 1 < now.serial.size() && stays(k) && stays(k + 1) && former_of[k + 1] == former_of[k] + 1;
      is_new[k] = !same;
      if (same)
        is_gone[former_of[k]] = 0;
    }
  }

  exec::Array<int> former_of;        ///< [points] -1: a new one
  exec::Array<int> now_of;           ///< [former points]
  exec::Array<std::uint8_t> is_new;  ///< [points] the segment that starts here was not there before, or ended otherwise
  exec::Array<std::uint8_t> is_gone;  ///< [former points] and the other way round
};

bool any_of(const exec::Array<std::uint8_t>& flag, const int* first, const int* last) {
  return std::any_of(first, last, [&](int segment) { return flag[segment] != 0; });
}

class Carrier {
 public:
  Carrier(const exec::Space& space, const Tiles& tiles, const Lattice& lattice, const Cracks& cracks,
          CrackFields& fields)
      : space_(space),
        tiles_(tiles),
        lattice_(lattice),
        cracks_(cracks),
        f_(fields),
        was_(fields.former),
        map_(was_, fields) {}

  void carry() {
    points();
    tiles();
    exec::launch_some(space_, f_.cells.size(), some, [&](long c) { turn_where_new(c); });
    exec::launch_some(space_, was_.cells.size(), some, [&](long c) {
      if (any_of(map_.is_gone, was_.cell_segment.data() + was_.cell_start[c],
                 was_.cell_segment.data() + was_.cell_start[c + 1]))
        turn_cell(lattice_, was_.cells[c], f_);
    });
    exec::launch_some(space_, f_.nodes.size(), some, [&](long n) { node(n); });
    f_.tally.zero();
    exec::parallel_tasks(space_, "carry traces", f_.marked_tiles.size(), [&](long m) { records(m); });
  }

 private:
  void points() {
    f_.traced.resize(cracks_.points());
    for (int k = 0; k < cracks_.points(); ++k) {
      const int former = map_.former_of[k];
      f_.traced[k] =
          former >= 0 && was_.kind[former] == f_.kind[k] ? was_.traced[former] : seen_point(cracks_, k, lattice_.h);
    }
  }

  /// All are to be looked at, and to be given slots: nodes have others.
  void tiles() {
    for (const int tile : was_.marked_tiles)
      if (!f_.tile_marked[tile])
        std::fill(f_.fields.begin() + tiles_.start[tile], f_.fields.begin() + tiles_.start[tile + 1], 0u);
    const long marked = f_.marked_tiles.size(), blocks = f_.fields.size() / exec::lanes + marked + 1;
    f_.tiles.resize(marked);
    for (long m = 0; m < marked; ++m) {
      const int tile = f_.marked_tiles[m], former = was_.tile_marked[tile];
      TileTrace& t = f_.tiles[m] = former ? was_.tiles[former - 1] : TileTrace{};
      t.limit = 0;
      t.changed = 1;
      if (!former)
        t.known = add_known(tiles_.start[tile], tiles_.start[tile + 1], f_);
    }
    f_.block_limit.resize(blocks);
    f_.block_limit.zero();
    f_.crossing.resize(blocks);
    f_.block_slots.resize(blocks);
  }

  /// A particle may have come from the cell next to that of its trace, if that one saw nothing around it.
  void turn_where_new(long c) {
    const int cell = f_.cells[c];
    if (was_.cell_index[cell] < 0)
      each_cell_around(lattice_, cell, [&](long near) { turn_cell(lattice_, near, f_); });
    else if (any_of(map_.is_new, f_.cell_segment.data() + f_.cell_start[c],
                    f_.cell_segment.data() + f_.cell_start[c + 1]))
      turn_cell(lattice_, cell, f_);
  }

  /// What a node holds, and its distance from the segments, if these are the same.
  void node(long n) {
    NodeCracks& node = f_.nodes[n];
    const int first = f_.candidate_start[n], last = f_.candidate_start[n + 1], former = was_.node_index[node.node];
    for (int e = 2 * first; e < 2 * last; ++e)
      f_.verdict[e] = fourth_crack;
    f_.recount[n] = former < 0;
    f_.clearance[n] = NodeClearance{};
    f_.clearance[n].travel = -std::numeric_limits<double>::max();  // to be measured
    f_.follow_at[n] = -1;
    if (former < 0)
      return;
    for (int k = 0; k < most_held; ++k) {
      node.crack[k] = was_.nodes[former].crack[k];
      node.side[k] = was_.nodes[former].side[k];
    }
    f_.held[n] = was_.held[former];
    const int was_first = was_.candidate_start[former], was_last = was_.candidate_start[former + 1];
    for (int e = first, o = was_first; e < last; ++e) {
      while (o < was_last && was_.candidate[o] < f_.candidate[e])
        ++o;
      if (o < was_last && was_.candidate[o] == f_.candidate[e])
        std::copy_n(&was_.verdict[2 * o], 2, &f_.verdict[2 * e]);
    }
    if (any_of(map_.is_new, f_.node_segment.data() + f_.segment_start[first],
               f_.node_segment.data() + f_.segment_start[last]) ||
        any_of(map_.is_gone, was_.node_segment.data() + was_.segment_start[was_first],
               was_.node_segment.data() + was_.segment_start[was_last])) {
      turn_node(lattice_, node.node, f_);
      return;
    }
    f_.clearance[n] = was_.clearance[former];
    f_.follow_at[n] = was_.follow_at[former];
    if (int& near = f_.clearance[n].near; near >= 0)
      near = map_.now_of[near];
  }

  /// Records of a tile's particles in the new numbers, and their counts.
  void records(long marked) {
    const int* start = tiles_.start.data() + f_.marked_tiles[marked];
    const int known = f_.tiles[marked].known;
    for (long p = start[0]; p < start[1]; ++p) {
      CrossingMemory& m = f_.memory[p + known];
      CrossingRecord* const r = f_.records.data() + m.first;
      if (!std::all_of(r, r + m.count, [&](CrossingRecord& one) { return renumber(one); })) {
        m = CrossingMemory{};
        f_.limit[p + known] = 0;
        f_.fields[p] = 0;
        continue;
      }
      for (int i = 0; i < m.count; ++i)
        if (r[i].weighs)
          exec::atomic_add(f_.tally[r[i].entry], 1);
    }
  }

  /// False if the node does not see the crack any more.
  bool renumber(CrossingRecord& r) const {
    const int crack = was_.candidate[r.entry / 2];
    const int n = f_.node_index[was_.nodes[r.node].node];
    if (n < 0)
      return false;
    for (int c = f_.candidate_start[n]; c < f_.candidate_start[n + 1]; ++c)
      if (f_.candidate[c] == crack) {
        r.node = n;
        r.entry = 2 * c + r.entry % 2;
        return true;
      }
    return false;
  }

  const exec::Space& space_;
  const Tiles& tiles_;
  const Lattice& lattice_;
  const Cracks& cracks_;
  CrackFields& f_;
  const CrackLists& was_;
  const PointMap map_;
};

}  // namespace

void carry_traces(const exec::Space& space, const Tiles& tiles, const Lattice& lattice, const Cracks& cracks,
                  CrackFields& fields) {
  Carrier(space, tiles, lattice, cracks, fields).carry();
}

}  // namespace riven
