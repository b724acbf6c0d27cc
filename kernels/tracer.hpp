// Traces one particle after the other. Which of them are due differs between host and device: trace_tiles.hpp.
#pragma once
#include <limits>

#include "core/exec/bits.hpp"
#include "core/fracture/beyond_end.hpp"
#include "core/fracture/crossing.hpp"
#include "core/math/shape.hpp"
#include "core/state/bodies.hpp"
#include "core/state/cracks.hpp"
#include "core/state/particles.hpp"
#include "kernels/clearance.hpp"
#include "kernels/crossing_paths.hpp"
#include "kernels/crossing_records.hpp"
#include "kernels/lists_view.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// What a trace reads, and what it keeps of particles and their tiles.
template <class Real>
struct TraceInput {
  ListsView lists;
  const double *x, *y;                    ///< [particles]
  const std::uint8_t* body;               ///< [particles]
  const int* tile_start;                  ///< [tiles + 1] particles
  const DomainSetting<Real, 2>* domains;  ///< [bodies]
  const double* tile_move;   ///< [tiles] m, how far particles moved along an axis since the trace before; may be null
  const int *crack, *start;  ///< Cracks
  const Vec2* traced;        ///< [points] CrackFields
  const EndOnCrack* ends;    ///< CrackFields; null where there are none
  const double* crack_move;  ///< [cracks] CrackFields
  const NodeClearance* clearance;  ///< [flagged] CrackFields
  const int* turned;               ///< [nodes] CrackFields
  double travel;                   ///< CrackFields
  int traces;                      ///< CrackFields
  TileTrace* tiles;                ///< [marked tiles]
  CrossingMemory* memory;          ///< CrackFields
  double *limit, *block_limit;     ///< CrackFields
};

template <class Shape, class Real>
class Tracer {
 public:
  static constexpr double never = std::numeric_limits<double>::max();

  RIVEN_FN Tracer(const TraceInput<Real>& input, const CrossingStore& records)
      : in_(input),
        records_(records),
        inv_h_(1 / input.lists.lattice.h),
        rounding_(input.lists.lattice.h * std::max(1e-9, 8. * std::numeric_limits<Real>::epsilon())) {}

  RIVEN_FN bool moves_known() const { return in_.tile_move != nullptr; }

  /// Adds the moves since the last trace to the tile's sums. Along an axis a move is at most sqrt(2) times shorter.
  RIVEN_FN void follow(long marked) const {
    TileTrace& tile = in_.tiles[marked];
    const double particle_move = moves_known() ? in_.tile_move[in_.lists.marked_tiles[marked]] : 0;
    double most = 0;
    for (int c = in_.lists.tile_crack_start[marked]; c < in_.lists.tile_crack_start[marked + 1]; ++c)
      most = std::max(most, in_.crack_move[in_.lists.tile_crack[c]]);
    if (most > 0)  // however little
      tile.travel = std::max(tile.travel + most, std::nextafter(tile.travel, never));
    tile.path += (most + 1.4143 * particle_move) * (1 + 1e-9) + 1e-6 * rounding_;
  }

  RIVEN_FN bool all_due(const TileTrace& tile) const { return !moves_known() || tile.turned; }
  RIVEN_FN bool due(const TileTrace& tile) const { return all_due(tile) || !(tile.path < tile.limit); }

  /// Brings the records of a particle of a tile up to date; returns the path of the tile up to which they stay.
  RIVEN_FN double keep(TileTrace& tile, long p) {
    tile_ = &tile;
    CrossingMemory& m = in_.memory[p + tile.known];
    const Vec2 x{in_.x[p], in_.y[p]};
    double used = norm(x - m.x) + (tile.travel - m.travel);
    const bool turned = tile.turned && m.cell >= 0 && in_.turned[m.cell] == in_.traces;
    const bool left = m.known == Known::in_its_cell && cell_of(place_x(p), place_y(p)) != m.cell;
    if (m.known == Known::nowhere || turned || left || !(used < m.clear || used == 0)) {
      m.x = x;
      m.travel = tile.travel;
      used = 0;
      trace(p, m);
    } else if (!moves_known() || !(tile.path < m.weighs)) {
      weigh(p, m);
    }
    const double clear = m.clear - used;
    return std::min(m.weighs, tile.path + (m.known == Known::in_its_cell ? std::min(clear, within_cell(p)) : clear));
  }

 private:
  static constexpr int width = Shape::width;
  static constexpr int nodes = width * width;
  static constexpr int groups = Paths<Shape>::groups;

  RIVEN_INLINE const Lattice& lattice() const { return in_.lists.lattice; }
  RIVEN_INLINE double place_x(long p) const { return (in_.x[p] - lattice().origin.x) * inv_h_; }
  RIVEN_INLINE double place_y(long p) const { return (in_.y[p] - lattice().origin.y) * inv_h_; }

  /// Number of the cell of a particle, or -1. One that has left the grid is reported by those who move it.
  RIVEN_FN int cell_of(double X, double Y) const {
    const int i = Shape::cell(X), j = Shape::cell(Y);
    return i < 1 || j < 1 || i >= lattice().nx - 1 || j >= lattice().ny - 1 ? -1 : j * lattice().nx + i;
  }

  /// How far a particle that is on the grid may move before it leaves its cell, m.
  RIVEN_FN double within_cell(long p) const {
    return lattice().h * std::min(Shape::to_next_cell(place_x(p)), Shape::to_next_cell(place_y(p))) - rounding_;
  }

  RIVEN_FN bool cracks_around(int cell) const {
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i)
        if (in_.lists.cell_index[cell + j * lattice().nx + i] >= 0)
          return true;
    return false;
  }

  RIVEN_FN void trace(long p, CrossingMemory& m) {
    records_.begin_particle();
    do {
      records_.begin_again();
      look_around(p, m);
      if (records_.take(m))
        exec::atomic_set(tile_->changed, 1);
    } while (records_.more());
    if (m.count > 0)
      m.weighs = weights_stay(p);
  }

  /// Adds the crossings of a particle, and finds the clearance of all its paths. Where cells see no cracks these may
  /// move as they will: a cell that comes to see one is turned.
  RIVEN_FN void look_around(long p, CrossingMemory& m) {
    m.cell = cell_of(place_x(p), place_y(p));
    m.known = Known::in_its_cell;
    m.clear = never;
    m.weighs = never;
    if (m.cell < 0) {
      m.known = Known::roaming;
      m.clear = 0;
    } else if (in_.lists.cell_index[m.cell] >= 0) {
      clear2_ = lattice().h * lattice().h;
      trace_all(p, m);
      m.clear = std::min((1 - 1e-9) * std::sqrt(clear2_) - rounding_, path_clearance());
    } else if (!cracks_around(m.cell)) {
      m.known = Known::roaming;
      m.clear = within_cell(p) + lattice().h;
    }
  }

  /// Sees whether the particle has come to have a weight on nodes where it had none, or the other way round.
  RIVEN_FN void weigh(long p, CrossingMemory& m) {
    if (m.count == 0)
      return;
    const unsigned before = m.weighed;
    m.weighed = nodes_weighed(p);
    m.weighs = weights_stay(p);
    if (m.weighed != before && records_.weigh(m))
      exec::atomic_set(tile_->changed, 1);
  }

  /// Path of the tile up to which the particle has weights on the same nodes.
  RIVEN_FN double weights_stay(long p) const {
    const DomainSetting<Real, 2>& domain = in_.domains[in_.body[p]];
    return tile_->path - rounding_ +
           lattice().h * std::min(Shape::to_other_weights(place_x(p), domain.axis[0]),
                                  Shape::to_other_weights(place_y(p), domain.axis[1]));
  }

  RIVEN_FN void trace_all(long p, CrossingMemory& m) {
    constexpr int before = width == 3;
    const int nx = lattice().nx, seen = in_.lists.cell_index[m.cell];
    const Paths<Shape> paths(m.x, m.cell % nx - before, m.cell / nx - before, lattice(), inv_h_);
    in_sight_ = {in_.lists.cell_segment + in_.lists.cell_start[seen],
                 in_.lists.cell_start[seen + 1] - in_.lists.cell_start[seen]};
    const int* segment = in_sight_.segment;
    const int* const last = segment + in_sight_.count;
    m.weighed = nodes_weighed(p);
    weighed_ = m.weighed;
    take_node_clearance(paths);
    for (Floats& f : path_clear2_)
      f = Floats{} + 1e6f;
    while (segment < last) {
      const int crack = in_.crack[*segment];
      const SegmentList list = part_of(crack, segment);
      trace_crack(paths, crack, list);
      segment += list.count;
    }
  }

  /// The segments in sight of one crack, of which `first` is the first.
  RIVEN_FN SegmentList part_of(int crack, const int* first) const {
    const int *const last = in_sight_.segment + in_sight_.count, end = in_.start[crack + 1];
    const int count = static_cast<int>(last - first);
    return {first, first[count - 1] < end ? count : static_cast<int>(std::lower_bound(first, last, end) - first)};
  }

  RIVEN_FN void trace_crack(const Paths<Shape>& paths, int crack, SegmentList list) {
    constexpr int batch = Paths<Shape>::batch;
    CrossingSum sum[nodes];
    for (int s = 0; s < list.count; s += batch) {
      const SegmentList part{list.segment + s, std::min(batch, list.count - s)};
      Masks bits[Paths<Shape>::groups];
      if (!paths.may_cross(part, in_.traced, inv_h_, bits))
        continue;
      for (int k = 0; k < nodes; ++k)
        if (const auto some = static_cast<std::uint32_t>(exec::lane(bits[k / float_lanes], k % float_lanes)))
          test(paths, k, crack, part, some, sum[k]);
    }
    if (in_.ends != nullptr) {
      if (list.segment[0] == in_.start[crack])
        trace_beyond(paths, crack, false, sum);
      if (list.segment[list.count - 1] + 2 == in_.start[crack + 1])
        trace_beyond(paths, crack, true, sum);
    }
    for (int k = 0; k < nodes; ++k)
      if (const Side side = sum[k].side(); side != Side::none)
        record(paths, crack, k, side == Side::below);
    take_crack_clearance(paths, crack, list);
  }

  /// Adds the crossings of a crack beyond an end that lies on another crack, by paths that cross that one from where
  /// the crack lies (beyond_end.hpp).
  RIVEN_FN void trace_beyond(const Paths<Shape>& paths, int crack, bool last, CrossingSum* sum) {
    const EndOnCrack end = in_.ends[2 * crack + last];
    if (end.host < 0)
      return;
    const int* const stop = in_sight_.segment + in_sight_.count;
    const int* const first = std::lower_bound(in_sight_.segment, stop, in_.start[end.host]);
    if (first == stop || in_.crack[*first] != end.host)
      return;
    const SegmentList host = part_of(end.host, first);
    const BeyondEnd line(in_.traced + (last ? in_.start[crack + 1] - 1 : in_.start[crack]), last,
                         crossed_beyond * lattice().h);
    take_line_clearance(line, paths.particle);
    for (int k = 0; k < nodes; ++k) {
      take_line_clearance(line, node(paths, k));
      const int crossed = line.crossed(paths.particle, node(paths, k));
      if (crossed == 0 || !sees(flagged(paths, k), crack))
        continue;
      CrossingSum of_host;
      for (int s = 0; s < host.count; ++s)
        add_crossing(paths, k, end.host, host.segment[s], of_host);
      if (of_host.side() == end.from)
        sum[k].add(crossed);
    }
  }

  RIVEN_FN void take_line_clearance(const BeyondEnd& line, Vec2 x) {
    const double clear = line_clearance(x, line.before, line.end);
    clear2_ = std::min(clear2_, clear * clear);
  }

  RIVEN_FN void test(const Paths<Shape>& paths, int k, int crack, SegmentList list, std::uint32_t bits,
                     CrossingSum& sum) {
    for (; bits; bits &= bits - 1)
      add_crossing(paths, k, crack, list.segment[exec::lowest_bit(bits)], sum);
  }

  RIVEN_FN void add_crossing(const Paths<Shape>& paths, int k, int crack, int segment, CrossingSum& sum) const {
    sum.add(crossing(paths.particle, node(paths, k), in_.traced + segment, segment == in_.start[crack],
                     segment + 2 == in_.start[crack + 1]));
  }

  RIVEN_FN void record(const Paths<Shape>& paths, int crack, int k, bool below) {
    const int f = flagged(paths, k);
    int at = in_.lists.candidate_start[f];
    while (in_.lists.candidate[at] != crack)
      ++at;
    records_.add({f, 2 * at + below, static_cast<std::uint8_t>(k), static_cast<std::uint8_t>(weighed_ >> k & 1u)});
  }

  /// A bit for each node on which the particle has a weight.
  RIVEN_FN unsigned nodes_weighed(long p) const {
    const DomainSetting<Real, 2>& domain = in_.domains[in_.body[p]];
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

  /// Number of a node among those that may see cracks, or -1.
  RIVEN_FN int flagged(const Paths<Shape>& paths, int k) const {
    return in_.lists.node_index[static_cast<long>(paths.j + k / width) * lattice().nx + paths.i + k % width];
  }
  /// Whether that node may see the crack. One that does not has no particles on both sides of it.
  RIVEN_FN bool sees(int f, int crack) const {
    const int* const list = in_.lists.candidate;
    return f >= 0 &&
           std::binary_search(list + in_.lists.candidate_start[f], list + in_.lists.candidate_start[f + 1], crack);
  }

  RIVEN_FN Vec2 node(const Paths<Shape>& paths, int k) const {
    return lattice().position(paths.i + k % width, paths.j + k / width);
  }

  /// Takes the distances of the nodes from all segments; and that of the particle from the line of a segment on which a
  /// node lies: beyond that line it would cross from the other side.
  RIVEN_FN void take_node_clearance(const Paths<Shape>& paths) {
    for (int k = 0; k < nodes; ++k) {
      const int f = flagged(paths, k);
      if (f < 0)
        continue;
      const NodeClearance& c = in_.clearance[f];
      const double left = distance_left(c, in_.travel);
      clear2_ = std::min(clear2_, left * left);
      if (c.near >= 0 && on_line(c))
        for (int s = c.near; s <= c.near + c.joined; ++s) {
          const double clear = line_clearance(paths.particle, in_.traced[s], in_.traced[s + 1]);
          clear2_ = std::min(clear2_, clear * clear);
        }
    }
  }

  /// Takes the distances of the particle from the segments of one crack, and of the crack's tips from all paths.
  RIVEN_FN void take_crack_clearance(const Paths<Shape>& paths, int crack, SegmentList list) {
    const int first = in_.start[crack], last = in_.start[crack + 1] - 1;
    const Vec2* point = in_.traced;
    for (int s = 0; s < list.count; ++s) {
      const int a = list.segment[s];
      clear2_ = std::min(clear2_, distance2(paths.particle, point[a], point[a + 1]));
      if (a == first)
        paths.take_distance2(point[a], inv_h_, path_clear2_);
      if (a + 1 == last)
        paths.take_distance2(point[a + 1], inv_h_, path_clear2_);
    }
  }

  /// The least distance taken from the paths, below the true one by more than single precision may be off.
  RIVEN_FN double path_clearance() const {
    float least2 = exec::lane(path_clear2_[0], 0);
    for (int g = 0; g < groups; ++g)
      for (int k = 0; k < float_lanes; ++k)
        least2 = std::min(least2, exec::lane(path_clear2_[g], k));
    return lattice().h * ((1 - 1e-5) * std::sqrt(double(least2)) - 1e-5);
  }

  const TraceInput<Real>& in_;
  CrossingRecords records_;
  double inv_h_, rounding_;
  TileTrace* tile_ = nullptr;   ///< of the particle in hand
  SegmentList in_sight_{};      ///< of it
  double clear2_ = 0;           ///< squared clearance of the particle in hand
  Floats path_clear2_[groups];  ///< squared distances in cells of tips from its paths
  unsigned weighed_ = 0;        ///< nodes on which the particle in hand has a weight
};

}  // namespace RIVEN_SIDE

}  // namespace riven
