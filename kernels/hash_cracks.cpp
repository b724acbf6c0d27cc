#include "kernels/hash_cracks.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/exec/atomic.hpp"
#include "core/exec/scan.hpp"
#include "core/fracture/beyond_end.hpp"
#include "core/fracture/crack_path.hpp"
#include "core/fracture/crossing.hpp"
#include "core/math/shape.hpp"
#include "kernels/cells_around.hpp"
#include "kernels/segment_bins.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

namespace {

constexpr const char* label = "hash cracks: clear";

/// Cells, and tiles, of one task.
constexpr long cells_of_task = 512, tiles_of_task = 16;

/// The cracks that particles of a tile may see: those of the cells that they may be in.
struct CracksOfTile {
  Lattice lattice;
  const int *cell_index, *cell_start, *cell_segment, *crack;

  /// f(crack), for most of them once.
  template <class F>
  RIVEN_FN void each(int tile, const F& f) const {
    constexpr int room = 8;
    int known[room], count = 0, last = -1;
    const int i0 = tile % lattice.tiles_x() * Lattice::tile, j0 = tile / lattice.tiles_x() * Lattice::tile;
    const int i1 = after(i0, lattice.nx), j1 = after(j0, lattice.ny);
    for (int j = j0 > 0 ? j0 - 1 : 0; j < j1; ++j)
      for (int i = i0 > 0 ? i0 - 1 : 0; i < i1; ++i) {
        const int cell = cell_index[j * lattice.nx + i];
        if (cell < 0)
          continue;
        for (int s = cell_start[cell]; s < cell_start[cell + 1]; ++s) {
          const int now = crack[cell_segment[s]];
          if (now == last)
            continue;
          last = now;
          int k = 0;
          while (k < count && known[k] != now)
            ++k;
          if (k < count)
            continue;
          if (count < room)
            known[count++] = now;
          f(now);
        }
      }
  }

 private:
  /// Behind the last cell, along an axis of n, that particles of a tile from `first` on may be in.
  static RIVEN_FN int after(int first, int n) { return first + Lattice::tile < n ? first + Lattice::tile + 1 : n; }
};

/// Tiles that can reach a marked cell, and the cracks that are seen there.
void mark_tiles(const exec::Space& space, const Lattice& lattice, const Cracks& cracks, CrackFields& fields) {
  const long tiles = long{lattice.tiles_x()} * lattice.tiles_y();
  fields.tile_marked.renew(tiles);
  exec::parallel_zero(space, label, fields.tile_marked);
  int* const marked = exec::data(fields.tile_marked);
  exec::launch_some(space, fields.cells.size(), cells_of_task,
                    [=, cell = exec::data(std::as_const(fields.cells))] RIVEN_KERNEL(long c) {
                      each_tile_around(lattice, cell[c], 0, [&](int tile) { exec::atomic_set(marked[tile], 1); });
                    });
  const auto listed = exec::begin_scan<int>(space, tiles, [=] RIVEN_KERNEL(long t) { return marked[t]; });
  const int used = listed.total;
  fields.marked_tiles.renew(used);
  int* const list = exec::data_to_fill(fields.marked_tiles);
  exec::end_scan(listed, [=] RIVEN_KERNEL(long t, int before) {
    if (marked[t] == 0)
      return 0;
    list[before] = static_cast<int>(t);
    marked[t] = before + 1;
    return 1;
  });

  const CracksOfTile seen{lattice, exec::data(std::as_const(fields.cell_index)),
                          exec::data(std::as_const(fields.cell_start)), exec::data(std::as_const(fields.cell_segment)),
                          exec::data(cracks.crack)};
  exec::Array<int> counts(used);
  int* const count = exec::data_to_fill(counts);
  exec::launch_some(space, used, tiles_of_task, [=] RIVEN_KERNEL(long m) {
    int n = 0;
    seen.each(list[m], [&](int) { ++n; });
    count[m] = n;
  });
  const auto cracks_seen = exec::begin_scan<int>(space, used, [=] RIVEN_KERNEL(long m) { return count[m]; });
  const int total = cracks_seen.total;
  fields.tile_crack_start.renew(used + 1);
  fields.tile_crack.renew(total);
  int *const start = exec::data_to_fill(fields.tile_crack_start), *const crack = exec::data_to_fill(fields.tile_crack);
  exec::end_scan(cracks_seen, [=] RIVEN_KERNEL(long m, int before) {
    start[m] = before;
    return count[m];
  });
  exec::launch(space, 1, [=] RIVEN_KERNEL(long) { start[used] = total; });
  exec::launch_some(space, used, tiles_of_task, [=] RIVEN_KERNEL(long m) {
    int at = start[m];
    seen.each(list[m], [&](int c) { crack[at++] = c; });
  });
}

/// What nodes ask for, up to one of them.
struct NodeNeeds {
  int candidates = 0, slots = 0, thirds = 0;
  RIVEN_FN NodeNeeds& operator+=(const NodeNeeds& o) {
    return candidates += o.candidates, slots += o.slots, thirds += o.thirds, *this;
  }
};

/// Of a node that sees so many cracks.
RIVEN_FN NodeNeeds needs_of(int seen) {
  return {seen, (1 << (seen < most_held ? seen : +most_held)) - 1, seen > 2};
}

/// The cracks whose segments are near to a node, as fill_bins() lists these.
struct CracksOfNode {
  const int *start, *segment, *crack;

  /// f(crack, position of its first segment in the list) for the cracks near to node f, in ascending order.
  template <class F>
  RIVEN_FN void each(long node, const F& f) const {
    int last = -1;
    for (int s = start[node]; s < start[node + 1]; ++s)
      if (const int c = crack[segment[s]]; c != last) {
        f(c, s);
        last = c;
      }
  }
  RIVEN_FN NodeNeeds needs(long node) const {
    int n = 0;
    each(node, [&](int, int) { ++n; });
    return needs_of(n);
  }
};

/// Candidate cracks of each node from the segments near it, and the extra slots that they ask for.
void list_candidates(const exec::Space& space, const Lattice& lattice, const Cracks& cracks,
                     const exec::Array<int>& nodes, const exec::Array<int>& starts, CrackFields& fields) {
  const long flagged = nodes.size();
  const CracksOfNode near{exec::data(starts), exec::data(std::as_const(fields.node_segment)), exec::data(cracks.crack)};
  const auto needs = exec::begin_scan<NodeNeeds>(space, flagged, [=] RIVEN_KERNEL(long f) { return near.needs(f); });
  const NodeNeeds all = needs.total;
  const int segments = static_cast<int>(fields.node_segment.size());
  fields.nodes.renew(flagged);
  fields.candidate_start.renew(flagged + 1);
  fields.candidate.renew(all.candidates);
  fields.segment_start.renew(all.candidates + 1);
  fill_with_none(space, fields.extra, lattice.nodes());
  NodeCracks* const node = exec::data_to_fill(fields.nodes);
  int *const candidate_start = exec::data_to_fill(fields.candidate_start),
             *const candidate = exec::data_to_fill(fields.candidate),
             *const segment_start = exec::data_to_fill(fields.segment_start), *const extra = exec::data(fields.extra);
  exec::end_scan(needs, [=, number = exec::data(nodes)] RIVEN_KERNEL(long f, const NodeNeeds& before) {
    int at = before.candidates;
    near.each(f, [&](int crack, int first_segment) {
      segment_start[at] = first_segment;
      candidate[at++] = crack;
    });
    const int seen = at - before.candidates;
    NodeCracks here;
    here.node = number[f];
    here.extra = before.slots;
    here.sees = seen == 1 ? candidate[before.candidates] : seen == 2 ? -1 : -2;
    here.third = seen > 2 ? before.thirds : -1;
    node[f] = here;
    candidate_start[f] = before.candidates;
    extra[here.node] = before.slots;
    return needs_of(seen);
  });
  exec::launch(space, 1, [=] RIVEN_KERNEL(long) {
    candidate_start[flagged] = all.candidates;
    segment_start[all.candidates] = segments;
  });
  fields.extra_slots = all.slots;
  fields.normals.renew(flagged);
  fields.third_normals.renew(all.thirds);
}

/// The ends that lie on other cracks.
void list_ends(const Lattice& lattice, const Cracks& cracks, CrackFields& fields) {
  const Vec2* const at = std::as_const(fields.hashed).data();
  fields.ends.clear();
  for (const Junction& j : cracks.junctions) {
    const int a = cracks.end_point(j.other, false) + j.segment, end = cracks.end_point(j.crack, j.last);
    const auto at_end = [&](bool last) {
      return norm(at[cracks.end_point(j.other, last)] - at[end]) < 1e-3 * lattice.h;
    };
    const int from = orientation(at[a], at[a + 1], at[cracks.next_to_end(j.crack, j.last)]);
    if (j.other == j.crack || from == 0 || at_end(false) || at_end(true))
      continue;
    if (fields.ends.empty()) {
      fields.ends.resize(2 * cracks.count());
      std::fill(fields.ends.begin(), fields.ends.end(), EndOnCrack{});
    }
    fields.ends[2 * j.crack + j.last] = {j.other, from > 0 ? Side::above : Side::below};
  }
}

/// Where paths saw the points when the hash was made, with those ends that they see on other cracks as far beyond.
exec::Array<Vec2> points_seen(const Lattice& lattice, const Cracks& cracks, const CrackFields& fields) {
  exec::Array<Vec2> points = fields.hashed;
  each_end_on_crack(cracks, fields, [&](int end, bool last) {
    points[end] = BeyondEnd(fields.hashed.data() + end, last, seen_beyond * lattice.h).far;
  });
  return points;
}

}  // namespace

template <class Shape>
void list_segments(const exec::Space& space, const Lattice& lattice, const Cracks& cracks, CrackFields& fields) {
  // paths lie between a place in the cell and the three by three nodes around the nearest one, which crack surfaces see
  // with every shape function; those that end at one node start at most one and a half cells away from it
  constexpr Reach cell = Shape::width == 3 ? Reach{-1, 1, 1} : Reach{-1, 2, 1};
  constexpr Reach node{-1.5, 1.5, 0};
  list_ends(lattice, cracks, fields);
  exec::Array<Vec2> beyond;
  if (!fields.ends.empty())
    beyond = points_seen(lattice, cracks, fields);
  const exec::Array<Vec2>& points = fields.ends.empty() ? fields.hashed : beyond;
  fill_bins(space, lattice, cracks, points, cell,
            {fields.cell_index, fields.cells, fields.cell_start, fields.cell_segment});
  mark_tiles(space, lattice, cracks, fields);
  exec::Array<int> flagged, start;
  fill_bins(space, lattice, cracks, points, node, {fields.node_index, flagged, start, fields.node_segment});
  list_candidates(space, lattice, cracks, flagged, start, fields);

  fields.tally.renew(2 * fields.candidate.size());
  fields.verdict.renew(fields.tally.size());
  fields.held.renew(fields.nodes.size());
  exec::parallel_zero(space, label, fields.held);
  fields.recount.renew(fields.nodes.size());
  fields.clearance.renew(fields.nodes.size());
  fields.follow_at.renew(fields.nodes.size());
  fields.serial = cracks.serial;
  fields.kind.resize(cracks.points());
  for (PointKind& kind : fields.kind)
    kind = PointKind::joint;
  for (int c = 0; c < cracks.count(); ++c)
    for (const bool last : {false, true})
      fields.kind[cracks.end_point(c, last)] = cracks.is_open(c, last) ? PointKind::open_end : PointKind::end;
}

template <class Shape>
void hash_cracks(const exec::Space& space, const Lattice& lattice, const Cracks& cracks, CrackFields& fields) {
  const exec::Stopwatch watch(space.timers(), "hash cracks");
  if (!fields.relisted)
    std::swap(static_cast<CrackLists&>(fields), fields.former);
  fields.relisted = true;
  fields.hashed.resize(cracks.points());
  for (int k = 0; k < cracks.points(); ++k)
    fields.hashed[k] = seen_point(cracks, k, lattice.h);
  list_segments<Shape>(space, lattice, cracks, fields);
}

#define RIVEN_HASH(Shape)                                                                            \
  template void hash_cracks<Shape>(const exec::Space&, const Lattice&, const Cracks&, CrackFields&); \
  template void list_segments<Shape>(const exec::Space&, const Lattice&, const Cracks&, CrackFields&);
RIVEN_HASH(Linear)
RIVEN_HASH(UGimp)
RIVEN_HASH(BSpline)
#undef RIVEN_HASH

}  // namespace RIVEN_SIDE

}  // namespace riven
