#include "kernels/carry_traces.hpp"

#include <algorithm>
#include <limits>

#include "core/exec/atomic.hpp"
#include "core/exec/parallel.hpp"
#include "kernels/carry_points.hpp"
#include "kernels/lists_view.hpp"
#include "kernels/turned.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

namespace {

/// Cells, and nodes, of one task.
constexpr long some = 512;

/// The same points and segments in the former lists and the new ones: PointMap. Particles were traced, and nodes
/// measured, against what they saw: what has moved into their sight since is as good as new.
struct SameSegments {
  const int *now_of, *former_of;
  const std::uint8_t *is_new, *is_gone;

  /// Is any of these new, or has come in sight of what saw [was, was_end) before?
  RIVEN_FN bool any_new(const int* first, const int* last, const int* was, const int* was_end) const {
    for (; first < last; ++first)
      if (is_new[*first] || !std::binary_search(was, was_end, former_of[*first]))
        return true;
    return false;
  }
  RIVEN_FN bool any_gone(const int* first, const int* last) const { return any(is_gone, first, last); }

 private:
  static RIVEN_FN bool any(const std::uint8_t* flag, const int* first, const int* last) {
    for (; first < last; ++first)
      if (flag[*first])
        return true;
    return false;
  }
};

/// Turns the cells that see other segments than before.
struct CellTurner {
  ListsView now, was;
  Turning turning;
  SameSegments same;

  /// Where there are new ones. A particle may have come from the cell next to that of its trace, if that one saw
  /// nothing around it.
  RIVEN_FN void where_new(long c) const {
    const int cell = now.cells[c];
    const int former = was.cell_index[cell];
    if (former < 0)
      each_cell_around(now.lattice, cell, [&](long near) { turning.cell(near); });
    else if (same.any_new(now.cell_segment + now.cell_start[c], now.cell_segment + now.cell_start[c + 1],
                          was.cell_segment + was.cell_start[former], was.cell_segment + was.cell_start[former + 1]))
      turning.cell(cell);
  }
  /// Where some are gone.
  RIVEN_FN void where_gone(long c) const {
    if (same.any_gone(was.cell_segment + was.cell_start[c], was.cell_segment + was.cell_start[c + 1]))
      turning.cell(was.cells[c]);
  }
};

/// What trace and assign keep of nodes: CrackLists.
struct NodeKeep {
  NodeCracks* nodes;
  NodeClearance* clearance;
  double* follow_at;
  std::uint8_t *verdict, *held;
};
struct FormerNodes {
  const NodeCracks* nodes;
  const NodeClearance* clearance;
  const double* follow_at;
  const std::uint8_t *verdict, *held;
};

/// What a node holds, and its distance from the segments, if these are the same.
struct NodeCarrier {
  ListsView now, was;
  Turning turning;
  SameSegments same;
  NodeKeep to;
  FormerNodes from;
  std::uint8_t* recount;

  RIVEN_FN void carry(long n) const {
    NodeCracks& node = to.nodes[n];
    const int first = now.candidate_start[n], last = now.candidate_start[n + 1], former = was.node_index[node.node];
    for (int e = 2 * first; e < 2 * last; ++e)
      to.verdict[e] = fourth_crack;
    recount[n] = former < 0;
    to.clearance[n] = NodeClearance{};
    to.clearance[n].travel = -std::numeric_limits<double>::max();  // to be measured
    to.follow_at[n] = -1;
    if (former < 0)
      return;
    for (int k = 0; k < most_held; ++k) {
      node.crack[k] = from.nodes[former].crack[k];
      node.side[k] = from.nodes[former].side[k];
    }
    node.behind = from.nodes[former].behind;
    to.held[n] = from.held[former];
    const int was_first = was.candidate_start[former], was_last = was.candidate_start[former + 1];
    for (int e = first, o = was_first; e < last; ++e) {
      while (o < was_last && was.candidate[o] < now.candidate[e])
        ++o;
      if (o < was_last && was.candidate[o] == now.candidate[e])
        std::copy_n(from.verdict + 2 * o, 2, to.verdict + 2 * e);
    }
    const int* const seen = was.node_segment + was.segment_start[was_first];
    const int* const seen_end = was.node_segment + was.segment_start[was_last];
    if (same.any_new(now.node_segment + now.segment_start[first], now.node_segment + now.segment_start[last], seen,
                     seen_end) ||
        same.any_gone(seen, seen_end)) {
      turning.node(node.node);
      recount[n] = 1;
      return;
    }
    to.clearance[n] = from.clearance[former];
    to.follow_at[n] = from.follow_at[former];
    if (int& near = to.clearance[n].near; near >= 0)
      near = same.now_of[near];
  }
};

/// Records of particles in the new numbers, and their counts.
struct RecordCarrier {
  ListsView now, was;
  const NodeCracks* former_nodes;
  const int* tile_start;
  const TileTrace* tiles;
  CrossingMemory* memory;
  CrossingRecord* records;
  double* limit;
  std::uint32_t* fields;
  int* tally;

  RIVEN_FN void carry(long p, int known) const {
    CrossingMemory& m = memory[p + known];
    CrossingRecord* const r = records + m.first;
    for (int i = 0; i < m.count; ++i)
      if (!renumber(r[i])) {
        m = CrossingMemory{};
        limit[p + known] = 0;
        fields[p] = 0;
        return;
      }
    for (int i = 0; i < m.count; ++i)
      if (r[i].weighs)
        exec::atomic_add(tally[r[i].entry], 1);
  }

 private:
  /// False if the node does not see the crack any more.
  RIVEN_FN bool renumber(CrossingRecord& r) const {
    const int crack = was.candidate[r.entry / 2];
    const int n = now.node_index[former_nodes[r.node].node];
    if (n < 0)
      return false;
    for (int c = now.candidate_start[n]; c < now.candidate_start[n + 1]; ++c)
      if (now.candidate[c] == crack) {
        r.node = n;
        r.entry = 2 * c + r.entry % 2;
        return true;
      }
    return false;
  }
};

/// Particles of tiles that are not marked any more cross nothing.
void clear_unmarked(const exec::Space& space, const Tiles& tiles, CrackFields& f) {
  exec::parallel_teams<char>(space, "carry traces", f.former.marked_tiles.size(),
                             [start = exec::data(tiles.start), marked = exec::data(std::as_const(f.tile_marked)),
                              former = exec::data(std::as_const(f.former.marked_tiles)),
                              fields = exec::data(f.fields)] RIVEN_KERNEL(const exec::Team& team, char&, long m) {
                               const int tile = former[m], first = start[tile];
                               if (!marked[tile])
                                 team.each(start[tile + 1] - first, [&](long i) { fields[first + i] = 0; });
                             });
}

}  // namespace

void carry_traces(const exec::Space& space, const Tiles& tiles, const Lattice& lattice, const Cracks& cracks,
                  CrackFields& f) {
  const PointMap map(f.former, f);
  carry_points(map, lattice, cracks, f);
  clear_unmarked(space, tiles, f);
  carry_tiles(tiles, f);
  const ListsView now = lists_view(lattice, f), was = lists_view(lattice, f.former);
  const SameSegments same{exec::data(map.now_of), exec::data(map.former_of), exec::data(map.is_new),
                          exec::data(map.is_gone)};
  const CellTurner cells{now, was, turning(lattice, f), same};
  exec::launch_some(space, f.cells.size(), some, [=] RIVEN_KERNEL(long c) { cells.where_new(c); });
  exec::launch_some(space, f.former.cells.size(), some, [=] RIVEN_KERNEL(long c) { cells.where_gone(c); });
  const CrackLists& former = f.former;
  const NodeCarrier nodes{now,
                          was,
                          turning(lattice, f),
                          same,
                          {exec::data(f.nodes), exec::data(f.clearance), exec::data(f.follow_at), exec::data(f.verdict),
                           exec::data(f.held)},
                          {exec::data(former.nodes), exec::data(former.clearance), exec::data(former.follow_at),
                           exec::data(former.verdict), exec::data(former.held)},
                          exec::data(f.recount)};
  exec::launch_some(space, f.nodes.size(), some, [=] RIVEN_KERNEL(long n) { nodes.carry(n); });
  exec::parallel_zero(space, "carry traces", f.tally);
  const RecordCarrier records{now,
                              was,
                              exec::data(former.nodes),
                              exec::data(tiles.start),
                              exec::data(std::as_const(f.tiles)),
                              exec::data(f.memory),
                              exec::data(f.records),
                              exec::data(f.limit),
                              exec::data(f.fields),
                              exec::data(f.tally)};
  exec::parallel_teams<char>(space, "carry traces", f.marked_tiles.size(),
                             [=] RIVEN_KERNEL(const exec::Team& team, char&, long m) {
                               const int* start = records.tile_start + records.now.marked_tiles[m];
                               const int first = start[0], known = records.tiles[m].known;
                               team.each(start[1] - first, [&](long i) { records.carry(first + i, known); });
                             });
}

}  // namespace RIVEN_SIDE

}  // namespace riven
