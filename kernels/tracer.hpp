// Traces the particles of marked tiles.
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

namespace riven {

/// What a trace reads.
template <class Real>
struct TraceInput {
  const Particles<Real, 2>& particles;
  const DomainSetting<Real, 2>* domains;  ///< [bodies]
  const Lattice& lattice;
  const Cracks& cracks;
  const double* tile_move;  ///< [tiles] m, how far particles moved along an axis since the trace before; may be null
};

template <class Shape, class Real>
class Tracer {
 public:
  Tracer(const TraceInput<Real>& input, CrackFields& fields, bool shared)
      : in_(input),
        fields_(fields),
        records_(fields, shared),
        inv_h_(1 / input.lattice.h),
        rounding_(input.lattice.h * std::max(1e-9, 8. * std::numeric_limits<Real>::epsilon())),
        moves_known_(input.tile_move != nullptr) {}

  /// All particles of marked tiles [first, last) that may have come to cross something else.
  void tiles(long first, long last) {
    for (long marked = first; marked < last; ++marked) {
      take(marked);
      follow(marked, moves_known_ ? in_.tile_move[fields_.marked_tiles[marked]] : 0);
      each_due_block([&](long begin, long end, double&) {
        for (long p = begin; p < end; p += 64 / sizeof(double))
          exec::prefetch(&fields_.limit[p + tile_->known]);
      });
    }
    for (long marked = first; marked < last; ++marked) {
      take(marked);
      each_due_block([&](long begin, long end, double&) { look(begin, end); });
    }
    keep_all(0);
    for (long marked = first; marked < last; ++marked) {
      take(marked);
      each_due_block([&](long begin, long end, double& least) {
        const double* const limit = fields_.limit.data();
        least = least_of(limit + (begin + tile_->known), limit + (end + tile_->known));
      });
      if (due())
        tile_->limit = least_of(block_limit_, block_limit_ + blocks());
      tile_->turned = 0;
    }
  }

 private:
  static constexpr double never = std::numeric_limits<double>::max();
  static constexpr int width = Shape::width;
  static constexpr int nodes = width * width;
  static constexpr int groups = Paths<Shape>::groups;

  double place_x(long p) const { return (in_.particles.x[0][p] - in_.lattice.origin.x) * inv_h_; }
  double place_y(long p) const { return (in_.particles.x[1][p] - in_.lattice.origin.y) * inv_h_; }

  /// Adds the moves since the last trace to the tile's sums. Along an axis a move is at most sqrt(2) times shorter.
  void follow(long marked, double particle_move) const {
    double most = 0;
    for (int c = fields_.tile_crack_start[marked]; c < fields_.tile_crack_start[marked + 1]; ++c)
      most = std::max(most, fields_.crack_move[fields_.tile_crack[c]]);
    if (most > 0)  // however little
      tile_->travel = std::max(tile_->travel + most, std::nextafter(tile_->travel, never));
    tile_->path += (most + 1.4143 * particle_move) * (1 + 1e-9) + 1e-6 * rounding_;
  }

  static double least_of(const double* first, const double* last) {
    return first == last ? never : *std::min_element(first, last);
  }

  void take(long marked) {
    const int* start = in_.particles.tiles.start.data() + fields_.marked_tiles[marked];
    tile_ = &fields_.tiles[marked];
    first_ = start[0];
    last_ = start[1];
    block_limit_ = fields_.block_limit.data() + CrackFields::block_of(first_, marked);
  }
  long blocks() const { return (last_ - first_ + exec::lanes - 1) / exec::lanes; }
  bool all_due() const { return !moves_known_ || tile_->turned; }
  bool due() const { return all_due() || !(tile_->path < tile_->limit); }

  /// f(first, last, limit) for the blocks of the tile in hand some of whose particles are due.
  template <class F>
  void each_due_block(const F& f) const {
    for (long b = 0; due() && b < blocks(); ++b)
      if (all_due() || !(tile_->path < block_limit_[b]))
        f(first_ + b * exec::lanes, std::min(last_, first_ + (b + 1) * exec::lanes), block_limit_[b]);
  }

  /// A bit for each particle of a block that is due.
  unsigned due_lanes(long first, int count) const {
    const double path = tile_->path;
    const double* const limit = fields_.limit.data() + (first + tile_->known);
    const unsigned all = (1u << count) - 1;
    unsigned due = all_due() ? all : 0;
#pragma omp simd reduction(| : due)
    for (int k = 0; k < count; ++k)
      due |= static_cast<unsigned>(!(path < limit[k])) << k;
    return due;
  }

  /// Takes note of the particles of a block that are due. What is known of them lies apart in memory, and is asked for
  /// some particles ahead.
  void look(long first, long last) {
    for (unsigned due = due_lanes(first, static_cast<int>(last - first)); due != 0; due &= due - 1) {
      const long p = first + std::countr_zero(due);
      if (noted_ == most_noted)
        keep_all(ahead);
      exec::prefetch(&fields_.memory[p + tile_->known]);
      exec::prefetch(&fields_.memory[p + tile_->known] + 1);
      exec::prefetch(&in_.particles.x[0][p]);
      exec::prefetch(&in_.particles.x[1][p]);
      note_[noted_++] = {p, tile_};
    }
  }

  /// Brings all that were noted up to date but the last few.
  void keep_all(int but) {
    const int end = noted_ - but;
    TileTrace* const in_hand = tile_;
    for (int i = 0; i < end; ++i) {
      tile_ = note_[i].tile;
      fields_.limit[note_[i].particle + tile_->known] = keep(note_[i].particle);
    }
    tile_ = in_hand;
    std::copy(note_ + end, note_ + noted_, note_);
    noted_ = but;
  }

  /// Brings the records of one particle up to date; returns how long they will be.
  double keep(long p) {
    CrossingMemory& m = fields_.memory[p + tile_->known];
    const Vec2 x{in_.particles.x[0][p], in_.particles.x[1][p]};
    double used = norm(x - m.x) + (tile_->travel - m.travel);
    const bool turned = tile_->turned && m.cell >= 0 && fields_.turned[m.cell] == fields_.traces;
    if (!m.known || turned || !(used < m.clear || used == 0)) {
      m.known = 1;
      m.x = x;
      m.travel = tile_->travel;
      used = 0;
      trace(p, m);
    } else if (!moves_known_ || !(tile_->path < m.weighs)) {
      weigh(p, m);
    }
    return std::min(m.weighs, tile_->path + (m.clear - used));
  }

  /// Number of the cell of a particle, or -1. One that has left the grid is reported by those who move it.
  int cell_of(double X, double Y) const {
    const int i = Shape::cell(X), j = Shape::cell(Y);
    return i < 1 || j < 1 || i >= in_.lattice.nx - 1 || j >= in_.lattice.ny - 1 ? -1 : j * in_.lattice.nx + i;
  }

  bool cracks_around(int cell) const {
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i)
        if (fields_.cell_index[cell + j * in_.lattice.nx + i] >= 0)
          return true;
    return false;
  }

  void trace(long p, CrossingMemory& m) {
    records_.begin_particle();
    const double X = place_x(p), Y = place_y(p);
    m.cell = cell_of(X, Y);
    m.clear = 0;
    m.weighs = never;
    if (m.cell >= 0) {
      const double inside = in_.lattice.h * std::min(Shape::to_next_cell(X), Shape::to_next_cell(Y));
      if (fields_.cell_index[m.cell] >= 0) {
        clear2_ = inside * inside;
        trace_all(p, m);
        m.clear = std::min((1 - 1e-9) * std::sqrt(clear2_) - rounding_, path_clearance());
      } else {
        m.clear = inside - rounding_ + (cracks_around(m.cell) ? 0 : in_.lattice.h);
      }
    }
    if (records_.replace(m))
      tile_->changed = 1;
    if (m.count > 0)
      m.weighs = weights_stay(p);
  }

  /// Sees whether the particle has come to have a weight on nodes where it had none, or the other way round.
  void weigh(long p, CrossingMemory& m) {
    if (m.count == 0)
      return;
    const unsigned before = m.weighed;
    m.weighed = nodes_weighed(p);
    m.weighs = weights_stay(p);
    if (m.weighed != before && records_.weigh(m))
      tile_->changed = 1;
  }

  /// Path of the tile up to which the particle has weights on the same nodes.
  double weights_stay(long p) const {
    const DomainSetting<Real, 2>& domain = in_.domains[in_.particles.body[p]];
    return tile_->path - rounding_ +
           in_.lattice.h * std::min(Shape::to_other_weights(place_x(p), domain.axis[0]),
                                    Shape::to_other_weights(place_y(p), domain.axis[1]));
  }

  void trace_all(long p, CrossingMemory& m) {
    constexpr int before = width == 3;
    const int nx = in_.lattice.nx, seen = fields_.cell_index[m.cell];
    const Paths<Shape> paths(m.x, m.cell % nx - before, m.cell / nx - before, in_.lattice, inv_h_);
    const int* segment = fields_.cell_segment.data() + fields_.cell_start[seen];
    const int* const last = fields_.cell_segment.data() + fields_.cell_start[seen + 1];
    m.weighed = nodes_weighed(p);
    weighed_ = m.weighed;
    take_node_clearance(paths);
    for (Floats& f : path_clear2_)
      f = Floats{} + 1e6f;
    while (segment < last) {
      const int crack = in_.cracks.crack[*segment], end = in_.cracks.start[crack + 1];
      int count = static_cast<int>(last - segment);
      if (segment[count - 1] >= end)
        count = static_cast<int>(std::lower_bound(segment, last, end) - segment);
      trace_crack(paths, crack, {segment, count});
      segment += count;
    }
  }

  void trace_crack(const Paths<Shape>& paths, int crack, SegmentList list) {
    constexpr int batch = Paths<Shape>::batch;
    CrossingSum sum[nodes];
    for (int s = 0; s < list.count; s += batch) {
      const SegmentList part{list.segment + s, std::min(batch, list.count - s)};
      Masks bits[Paths<Shape>::groups];
      if (!paths.may_cross(part, fields_.traced.data(), inv_h_, bits))
        continue;
      for (int k = 0; k < nodes; ++k)
        if (const auto some = static_cast<std::uint32_t>(bits[k / float_lanes][k % float_lanes]))
          test(paths, k, crack, part, some, sum[k]);
    }
    for (int k = 0; k < nodes; ++k)
      if (const Side side = sum[k].side(); side != Side::none)
        record(paths, crack, k, side == Side::below);
    take_crack_clearance(paths, crack, list);
  }

  void test(const Paths<Shape>& paths, int k, int crack, SegmentList list, std::uint32_t bits, CrossingSum& sum) {
    const int first = in_.cracks.end_point(crack, false), last = in_.cracks.end_point(crack, true);
    for (; bits; bits &= bits - 1) {
      const int s = list.segment[std::countr_zero(bits)];
      sum.add(crossing(paths.particle, node(paths, k), fields_.traced.data() + s, s == first, s + 1 == last));
    }
  }

  void record(const Paths<Shape>& paths, int crack, int k, bool below) {
    const int f = fields_.node_index[static_cast<long>(paths.j + k / width) * in_.lattice.nx + paths.i + k % width];
    int at = fields_.candidate_start[f];
    while (fields_.candidate[at] != crack)
      ++at;
    records_.add({f, 2 * at + below, static_cast<std::uint8_t>(k), static_cast<std::uint8_t>(weighed_ >> k & 1u)});
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

  /// Takes the distances of the nodes from all segments; and that of the particle from the line of a segment on which a
  /// node lies: beyond that line it would cross from the other side.
  void take_node_clearance(const Paths<Shape>& paths) {
    for (int k = 0; k < nodes; ++k) {
      const int f = fields_.node_index[static_cast<long>(paths.j + k / width) * in_.lattice.nx + paths.i + k % width];
      if (f < 0)
        continue;
      const NodeClearance& c = fields_.clearance[f];
      const double left = distance_left(c, fields_.travel);
      clear2_ = std::min(clear2_, left * left);
      if (c.near >= 0 && on_line(c))
        for (int s = c.near; s <= c.near + c.joined; ++s) {
          const double clear = line_clearance(paths.particle, fields_.traced[s], fields_.traced[s + 1]);
          clear2_ = std::min(clear2_, clear * clear);
        }
    }
  }

  /// Takes the distances of the particle from the segments of one crack, and of the crack's tips from all paths.
  void take_crack_clearance(const Paths<Shape>& paths, int crack, SegmentList list) {
    const int first = in_.cracks.end_point(crack, false), last = in_.cracks.end_point(crack, true);
    const Vec2* point = fields_.traced.data();
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
  double path_clearance() const {
    float least2 = path_clear2_[0][0];
    for (int g = 0; g < groups; ++g)
      for (int k = 0; k < float_lanes; ++k)
        least2 = std::min(least2, path_clear2_[g][k]);
    return in_.lattice.h * ((1 - 1e-5) * std::sqrt(double(least2)) - 1e-5);
  }

  struct Note {
    long particle;
    TileTrace* tile;
  };
  static constexpr int most_noted = 32, ahead = 8;

  TraceInput<Real> in_;
  CrackFields& fields_;
  CrossingRecords records_;
  double inv_h_, rounding_;
  const bool moves_known_;
  TileTrace* tile_ = nullptr;      ///< in hand, and
  long first_ = 0, last_ = 0;      ///< its particles
  double* block_limit_ = nullptr;  ///< [blocks]
  Note note_[most_noted];
  int noted_ = 0;
  double clear2_ = 0;           ///< squared clearance of the particle in hand
  Floats path_clear2_[groups];  ///< squared distances in cells of tips from its paths
  unsigned weighed_ = 0;        ///< nodes on which the particle in hand has a weight
};

}  // namespace riven
