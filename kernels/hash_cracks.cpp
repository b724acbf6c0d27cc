#include "kernels/hash_cracks.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "core/exec/atomic.hpp"
#include "core/exec/parallel.hpp"
#include "core/fracture/crack_path.hpp"
#include "core/math/shape.hpp"
#include "kernels/cells_around.hpp"

namespace riven {

namespace {

/// Segments, and places, of one task.
constexpr long segments_of_task = 64, places_of_task = 1024;

/// For lattice place (i, j) the box [i + lower, i + upper] x [j + lower, j + upper], in cells.
struct Reach {
  double lower, upper;
  int border;  ///< places this near to the edge of the lattice are left out
};

/// A CSR of the segments whose distance to the box of a place is within the margin.
struct Bins {
  exec::Array<int>& index;  ///< [nodes] position in the lists, or -1
  exec::Array<int>& place;
  exec::Array<int>& start;
  exec::Array<int>& segment;
};

/// f(place) for every place whose box meets the segment a-b (in cells).
template <class F>
void each_place(Vec2 a, Vec2 b, Reach reach, const Lattice& lattice, const F& f) {
  const double lower = reach.lower - CrackFields::margin, upper = reach.upper + CrackFields::margin;
  const auto first = [&](double x) { return std::max(reach.border, static_cast<int>(std::ceil(x - upper))); };
  const auto last = [&](double x, int n) {
    return std::min(n - 1 - reach.border, static_cast<int>(std::floor(x - lower)));
  };
  const int i0 = first(std::min(a.x, b.x)), i1 = last(std::max(a.x, b.x), lattice.nx);
  const int j0 = first(std::min(a.y, b.y)), j1 = last(std::max(a.y, b.y), lattice.ny);
  const Vec2 d = b - a;
  const double center = (lower + upper) / 2, reach_across = (upper - lower) / 2 * (std::fabs(d.x) + std::fabs(d.y));
  for (int j = j0; j <= j1; ++j)
    for (int i = i0; i <= i1; ++i)
      if (std::fabs(cross(d, Vec2{i + center, j + center} - a)) <= reach_across)
        f(j * lattice.nx + i);
}

void fill(const exec::Space& space, const Lattice& lattice, const Cracks& cracks, const exec::Array<Vec2>& points,
          Reach reach, Bins bins) {
  const long nodes = lattice.nodes(), segments = std::max(0, cracks.points() - 1);
  const auto places_of = [&, crack = cracks.crack.data(), point = points.data()](long k, const auto& f) {
    if (crack[k] != crack[k + 1])
      return;
    const auto at = [&](long n) { return (point[n] - lattice.origin) * (1 / lattice.h); };
    const Vec2 a = at(k), b = at(k + 1);
    each_place(a, b, reach, lattice, f);
  };
  bins.index.resize(nodes);
  std::memset(bins.index.data(), 0xff, static_cast<size_t>(nodes) * sizeof(int));
  int* index = bins.index.data();
  exec::launch_some(space, segments, segments_of_task,
                    [&](long k) { places_of(k, [&](int p) { exec::atomic_add(index[p], 1); }); });

  // index + 1 is now the count of each place
  const long places = std::count_if(index, index + nodes, [](int count) { return count >= 0; });
  bins.place.resize(places);
  bins.start.resize(places + 1);
  int used = 0, total = 0;
  for (int p = 0; p < nodes; ++p) {
    if (index[p] < 0)
      continue;
    const int count = index[p] + 1;
    bins.place[used] = p;
    bins.start[used] = total;
    index[p] = used++;
    total += count;
  }
  bins.start[used] = total;
  bins.segment.resize(total);
  exec::Array<int> cursor(used);
  exec::launch_some(space, segments, segments_of_task, [&](long k) {
    places_of(k, [&](int p) {
      const int at = exec::atomic_add(cursor[index[p]], 1);
      bins.segment[bins.start[index[p]] + at] = static_cast<int>(k);
    });
  });
  int* segment = bins.segment.data();
  exec::launch_some(space, used, places_of_task,
                    [&](long u) { std::sort(segment + bins.start[u], segment + bins.start[u + 1]); });
}

/// Tiles that can reach a marked cell, and the cracks that are seen there.
void mark_tiles(const Lattice& lattice, const Cracks& cracks, CrackFields& fields) {
  fields.tile_marked.resize(lattice.tiles_x() * lattice.tiles_y());
  fields.tile_marked.zero();
  std::vector<std::pair<int, int>> seen;  // tile, crack
  // a tile's cells mostly see the crack that was noted there last
  for (long c = 0; c < fields.cells.size(); ++c)
    each_tile_around(lattice, fields.cells[c], 0, [&](int tile) {
      int& noted = fields.tile_marked[tile];
      for (int s = fields.cell_start[c]; s < fields.cell_start[c + 1]; ++s) {
        const int crack = cracks.crack[fields.cell_segment[s]];
        if (noted != crack + 1)
          seen.emplace_back(tile, crack);
        noted = crack + 1;
      }
    });
  std::sort(seen.begin(), seen.end());
  seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
  fields.marked_tiles.resize(fields.tile_marked.size());
  int used = 0;
  for (int t = 0; t < fields.tile_marked.size(); ++t)
    if (fields.tile_marked[t]) {
      fields.marked_tiles[used++] = t;
      fields.tile_marked[t] = used;
    }
  fields.marked_tiles.resize(used);
  fields.tile_crack_start.resize(used + 1);
  fields.tile_crack_start.zero();
  fields.tile_crack.resize(static_cast<long>(seen.size()));
  for (size_t k = 0; k < seen.size(); ++k) {
    ++fields.tile_crack_start[fields.tile_marked[seen[k].first]];
    fields.tile_crack[static_cast<long>(k)] = seen[k].second;
  }
  for (int m = 0; m < used; ++m)
    fields.tile_crack_start[m + 1] += fields.tile_crack_start[m];
}

/// Candidate cracks of each node from the segments near it, and the extra slots that they ask for.
void list_candidates(const Lattice& lattice, const Cracks& cracks, const exec::Array<int>& node,
                     const exec::Array<int>& start, CrackFields& fields) {
  const long flagged = node.size();
  fields.nodes.resize(flagged);
  fields.normals.resize(flagged);
  fields.candidate_start.resize(flagged + 1);
  fields.candidate.resize(fields.node_segment.size());
  fields.segment_start.resize(fields.node_segment.size() + 1);
  fields.extra.resize(lattice.nodes());
  std::memset(fields.extra.data(), 0xff, static_cast<size_t>(lattice.nodes()) * sizeof(int));
  int total = 0, slots = 0, thirds = 0;
  for (long f = 0; f < flagged; ++f) {
    const int first = total;
    for (int s = start[f]; s < start[f + 1]; ++s) {
      const int c = cracks.crack[fields.node_segment[s]];
      if (total != first && fields.candidate[total - 1] == c)
        continue;
      fields.segment_start[total] = s;
      fields.candidate[total++] = c;
    }
    NodeCracks& here = fields.nodes[f] = NodeCracks{};
    here.node = node[f];
    here.extra = slots;
    const int seen = total - first;
    here.sees = seen == 1 ? fields.candidate[first] : seen == 2 ? -1 : -2;
    here.third = seen > 2 ? thirds++ : -1;
    fields.candidate_start[f] = first;
    fields.extra[node[f]] = slots;
    slots += (1 << std::min(seen, most_held)) - 1;
  }
  fields.candidate_start[flagged] = total;
  fields.segment_start[total] = start[flagged];
  fields.candidate.resize(total);
  fields.segment_start.resize(total + 1);
  fields.extra_slots = slots;
  fields.third_normals.resize(thirds);
}

}  // namespace

bool hash_due(const exec::Space& space, const Lattice& lattice, const Cracks& cracks, const CrackFields& fields) {
  const long points = cracks.points();
  if (fields.cell_index.size() != lattice.nodes() || fields.hashed.size() != points)
    return true;
  const double limit = 0.99 * CrackFields::margin * lattice.h;  // less a little for rounding
  const auto moved = [&, then = fields.hashed.data()](long k) {
    const Vec2 now = seen_point(cracks, static_cast<int>(k), lattice.h);
    return long{std::fabs(now.x - then[k].x) > limit || std::fabs(now.y - then[k].y) > limit};
  };
  return exec::parallel_reduce<long>(space, "hash cracks", points, moved) > 0;
}

template <class Shape>
void list_segments(const exec::Space& space, const Lattice& lattice, const Cracks& cracks, CrackFields& fields) {
  // paths lie between a place in the cell and the three by three nodes around the nearest one, which crack surfaces see
  // with every shape function; those that end at one node start at most one and a half cells away from it
  constexpr Reach cell = Shape::width == 3 ? Reach{-1, 1, 1} : Reach{-1, 2, 1};
  constexpr Reach node{-1.5, 1.5, 0};
  fill(space, lattice, cracks, fields.hashed, cell,
       {fields.cell_index, fields.cells, fields.cell_start, fields.cell_segment});
  mark_tiles(lattice, cracks, fields);
  exec::Array<int> flagged, start;
  fill(space, lattice, cracks, fields.hashed, node, {fields.node_index, flagged, start, fields.node_segment});
  list_candidates(lattice, cracks, flagged, start, fields);

  fields.tally.resize(2 * fields.candidate.size());
  fields.verdict.resize(fields.tally.size());
  fields.held.resize(fields.nodes.size());
  fields.held.zero();
  fields.recount.resize(fields.nodes.size());
  fields.clearance.resize(fields.nodes.size());
  fields.follow_at.resize(fields.nodes.size());
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

}  // namespace riven
