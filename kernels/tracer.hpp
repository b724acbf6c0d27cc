// Traces the particles of one tile after another.
#pragma once
#include <bit>
#include <limits>

#include "core/fracture/crossing.hpp"
#include "core/math/shape.hpp"
#include "core/state/bodies.hpp"
#include "core/state/cracks.hpp"
#include "core/state/particles.hpp"
#include "kernels/clearance.hpp"
#include "kernels/crossing_paths.hpp"
#include "kernels/crossing_records.hpp"
#include "kernels/local_tally.hpp"

namespace riven {

/// What a trace reads.
template <class Real>
struct TraceInput {
  const Particles<Real, 2>& particles;
  const DomainSetting<Real, 2>* domains;  ///< [bodies]
  const Lattice& lattice;
  const Cracks& cracks;
};

template <class Shape, class Real>
class Tracer {
 public:
  Tracer(const TraceInput<Real>& input, CrackFields& fields, Recorder& recorder, LocalTally& tally)
      : in_(input), fields_(fields), recorder_(recorder), tally_(tally), inv_h_(1 / input.lattice.h) {}

  /// Particles first .. last - 1.
  void trace(long first, long last) {
    for (long block = first; block < last; block += exec::lanes) {
      int cell[exec::lanes];
      cells_of(block, cell);
      int seen = -1;
      for (int k = 0; k < exec::lanes; ++k)
        seen &= fields_.cell_index[cell[k]];
      if (seen == -1)
        continue;  // the index of every cell is -1
      const long count = std::min<long>(exec::lanes, last - block);
      for (int k = 0; k < count; ++k)
        if (fields_.cell_index[cell[k]] >= 0)
          particle(block + k, cell[k]);
    }
  }

 private:
  static constexpr int width = Shape::width;
  static constexpr int nodes = width * width;

  /// The crossings of one crack on the path to one node, and the sum of its normals turned along the path.
  struct Found {
    CrossingSum sum;
    int segment = 0;
    std::int64_t normal[4] = {0, 0, 0, 0};
  };

  Real place_x(long p) const { return (in_.particles.x[0][p] - Real(in_.lattice.origin.x)) * Real(inv_h_); }
  Real place_y(long p) const { return (in_.particles.x[1][p] - Real(in_.lattice.origin.y)) * Real(inv_h_); }

  /// Cells of a whole block of particles. A particle that has left the grid (reported by those who move it) is put
  /// into a cell at the edge, and those see no cracks.
  void cells_of(long block, int* cell) const {
    const int nx = in_.lattice.nx, ny = in_.lattice.ny;
    for (int k = 0; k < exec::lanes; ++k) {
      int i = Shape::cell(place_x(block + k)), j = Shape::cell(place_y(block + k));
      i = i < 0 ? 0 : i;
      j = j < 0 ? 0 : j;
      i = i >= nx ? nx - 1 : i;
      j = j >= ny ? ny - 1 : j;
      cell[k] = j * nx + i;
    }
  }

  void particle(long p, int cell) {
    CrossingMemory& m = fields_.memory[p];
    const Vec2 x{double(in_.particles.x[0][p]), double(in_.particles.x[1][p])};
    weighed_ = 0;
    recorder_.begin_particle();
    if (m.stamp == fields_.stamp - 1 && m.id == in_.particles.id[p] && m.cell == cell &&
        norm(x - m.x) + (fields_.travel - m.travel) < m.clear) {
      m.stamp = fields_.stamp;
      for (int r = m.first; r < m.first + m.count; ++r)
        repeat(p, fields_.last_records[r]);
      return;
    }
    m = {fields_.stamp, in_.particles.id[p], cell, 0, 0, 0, fields_.travel, x};
    trace_all(p, m);
  }

  void repeat(long p, CrossingRecord record) {
    record.particle = static_cast<int>(p);
    record.weighs = weighs(p, record.neighbour);
    recorder_.add(record);
    if (record.weighs)
      tally_.add(record.entry, fields_.segment_normal.data() + 4L * record.segment);
  }

  void trace_all(long p, CrossingMemory& m) {
    constexpr int before = width == 3;
    const int nx = in_.lattice.nx, seen = fields_.cell_index[m.cell];
    const Paths<Shape> paths(m.x, m.cell % nx - before, m.cell / nx - before, in_.lattice, inv_h_);
    const int* segment = fields_.cell_segment.data() + fields_.cell_start[seen];
    const int* const last = fields_.cell_segment.data() + fields_.cell_start[seen + 1];
    clear2_ = node_clearance2(paths, m.cell, {segment, static_cast<int>(last - segment)});
    while (segment < last) {
      const int crack = in_.cracks.crack[*segment], end = in_.cracks.start[static_cast<size_t>(crack) + 1];
      int count = static_cast<int>(last - segment);
      if (segment[count - 1] >= end)
        count = static_cast<int>(std::lower_bound(segment, last, end) - segment);
      trace_crack(p, m, paths, crack, {segment, count});
      segment += count;
    }
    // less a little for rounding, and nothing where the records may be torn apart
    if (m.count <= Recorder::together)
      m.clear = (1 - 1e-9) * std::sqrt(clear2_) - 1e-9 * in_.lattice.h;
  }

  void trace_crack(long p, CrossingMemory& m, const Paths<Shape>& paths, int crack, SegmentList list) {
    constexpr int batch = Paths<Shape>::batch;
    unsigned touched = 0;
    for (int s = 0; s < list.count; s += batch) {
      const SegmentList part{list.segment + s, std::min(batch, list.count - s)};
      Masks bits[Paths<Shape>::groups];
      if (!paths.may_cross(part, in_.cracks.plane.data(), inv_h_, bits))
        continue;
      for (int k = 0; k < nodes; ++k) {
        const auto some = static_cast<std::uint32_t>(bits[k / float_lanes][k % float_lanes]);
        if (!some)
          continue;
        if (!(touched >> k & 1u))
          found_[k] = Found{};
        touched |= 1u << k;
        test(paths, k, crack, part, some);
      }
    }
    unsigned crossed = 0;
    for (; touched; touched &= touched - 1) {
      const int k = std::countr_zero(touched);
      if (found_[k].sum.side() == Side::none)
        continue;
      crossed |= 1u << k;
      ++m.count;
      record(p, paths, crack, k);
    }
    crack_clearance2(paths, crack, crossed, list);
  }

  void test(const Paths<Shape>& paths, int k, int crack, SegmentList list, std::uint32_t bits) {
    const int first = in_.cracks.start[static_cast<size_t>(crack)],
              last = in_.cracks.start[static_cast<size_t>(crack) + 1];
    for (; bits; bits &= bits - 1) {
      const int segment = list.segment[std::countr_zero(bits)];
      const int c = crossing(paths.particle, node(paths, k), in_.cracks.plane.data() + segment, segment == first,
                             segment + 2 == last);
      if (c == 0)
        continue;
      found_[k].sum.add(c);
      found_[k].segment = segment;
      for (int m = 0; m < 4; ++m)
        found_[k].normal[m] += c * fields_.segment_normal[4L * segment + m];
    }
  }

  void record(long p, const Paths<Shape>& paths, int crack, int k) {
    Found& found = found_[k];
    const int f = fields_.node_index[static_cast<long>(paths.j + k / width) * in_.lattice.nx + paths.i + k % width];
    int at = fields_.candidate_start[f];
    while (fields_.candidate[at] != crack)
      ++at;
    const int entry = 2 * at + (found.sum.net < 0);
    if (found.sum.net < 0)
      for (std::int64_t& n : found.normal)
        n = -n;
    const bool weight = weighs(p, k);
    recorder_.add({static_cast<int>(p), entry, found.segment, static_cast<std::uint16_t>(k), weight});
    if (weight)
      tally_.add(entry, found.normal);
  }

  /// Whether the particle has a weight on its node k.
  bool weighs(long p, int k) {
    if (!weighed_)
      weighed_ = nodes_weighed(p);
    return weighed_ >> k & 1u;
  }

  /// A bit for each node on which the particle has a weight.
  unsigned nodes_weighed(long p) const {
    const DomainSetting<Real, 2>& domain = in_.domains[in_.particles.body[p]];
    const auto x = Shape::axis(place_x(p), domain.axis[0]), y = Shape::axis(place_y(p), domain.axis[1]);
    unsigned along_x = 0, all = 0;
    for (int i = 0; i < width; ++i)
      if (x.s[i] != Real(0))
        along_x |= 1u << i;
    for (int j = 0; j < width; ++j)
      if (y.s[j] != Real(0))
        all |= along_x << (j * width);
    return all;
  }

  Vec2 node(const Paths<Shape>& paths, int k) const {
    return in_.lattice.position(paths.i + k % width, paths.j + k / width);
  }

  /// Least squared distance of the cell's nodes from its segments; the same for all particles of the cell.
  double node_clearance2(const Paths<Shape>& paths, int cell, SegmentList list) {
    if (cell == clear_cell_)
      return clear_nodes2_;
    clear_cell_ = cell;
    clear_nodes2_ = std::numeric_limits<double>::max();
    const Vec2* point = in_.cracks.plane.data();
    for (int k = 0; k < nodes; ++k)
      for (int s = 0; s < list.count; ++s)
        clear_nodes2_ =
            std::min(clear_nodes2_, distance2(node(paths, k), point[list.segment[s]], point[list.segment[s] + 1]));
    return clear_nodes2_;
  }

  /// Takes the distances of the particle from the segments of one crack, of the crack's tips from all paths, and of
  /// its joints from the paths that cross it.
  void crack_clearance2(const Paths<Shape>& paths, int crack, unsigned crossed, SegmentList list) {
    const int first = in_.cracks.start[static_cast<size_t>(crack)],
              last = in_.cracks.start[static_cast<size_t>(crack) + 1] - 1;
    const Vec2* point = in_.cracks.plane.data();
    const auto take = [&](unsigned some, int at) {
      for (; some; some &= some - 1)
        clear2_ = std::min(clear2_, distance2(point[at], paths.particle, node(paths, std::countr_zero(some))));
    };
    constexpr unsigned all = (1u << nodes) - 1;
    for (int s = 0; s < list.count; ++s) {
      const int a = list.segment[s];
      clear2_ = std::min(clear2_, distance2(paths.particle, point[a], point[a + 1]));
      take(a == first ? all : crossed, a);
      if (a + 1 == last || s + 1 == list.count || list.segment[s + 1] != a + 1)
        take(a + 1 == last ? all : crossed, a + 1);
    }
    for (; crossed; crossed &= crossed - 1)
      if (found_[std::countr_zero(crossed)].sum.count > 1)
        clear2_ = 0;  // one segment does not tell the normal
  }

  TraceInput<Real> in_;
  CrackFields& fields_;
  Recorder& recorder_;
  LocalTally& tally_;
  double inv_h_;
  double clear2_ = 0;    ///< squared clearance of the particle in hand
  int clear_cell_ = -1;  ///< the cell whose nodes' clearance is known
  double clear_nodes2_ = 0;
  unsigned weighed_ = 0;  ///< nodes on which the particle in hand has a weight; 0: not known
  Found found_[nodes];
};

}  // namespace riven
