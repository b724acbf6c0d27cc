// trace_tiles.hpp on the host: a task takes some tiles, and passes over the blocks of particles of which none is due.
#pragma once
#include <algorithm>

#include "core/exec/parallel.hpp"
#include "kernels/tracer.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

namespace detail {

template <class Shape, class Real>
class TileTracer {
 public:
  TileTracer(const TraceInput<Real>& input, const CrossingStore& records) : in_(input), trace_(input, records) {}

  /// All particles of marked tiles [first, last) that are due.
  void tiles(long first, long last) {
    for (long marked = first; marked < last; ++marked) {
      take(marked);
      trace_.follow(marked);
      each_due_block([&](long begin, long end, double&) {
        for (long p = begin; p < end; p += 64 / sizeof(double))
          exec::prefetch(in_.limit + (p + tile_->known));
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
        least = least_of(in_.limit + (begin + tile_->known), in_.limit + (end + tile_->known));
      });
      if (trace_.due(*tile_))
        tile_->limit = least_of(block_limit_, block_limit_ + blocks());
      tile_->turned = 0;
    }
  }

 private:
  static double least_of(const double* first, const double* last) {
    return first == last ? Tracer<Shape, Real>::never : *std::min_element(first, last);
  }

  void take(long marked) {
    const int* start = in_.tile_start + in_.lists.marked_tiles[marked];
    tile_ = in_.tiles + marked;
    first_ = start[0];
    last_ = start[1];
    block_limit_ = in_.block_limit + CrackFields::block_of(first_, marked);
  }
  long blocks() const { return (last_ - first_ + exec::block - 1) / exec::block; }

  /// f(first, last, limit) for the blocks of the tile in hand some of whose particles are due.
  template <class F>
  void each_due_block(const F& f) const {
    for (long b = 0; trace_.due(*tile_) && b < blocks(); ++b)
      if (trace_.all_due(*tile_) || !(tile_->path < block_limit_[b]))
        f(first_ + b * exec::block, std::min(last_, first_ + (b + 1) * exec::block), block_limit_[b]);
  }

  /// A bit for each particle of a block that is due.
  unsigned due_lanes(long first, int count) const {
    const double path = tile_->path;
    const double* const limit = in_.limit + (first + tile_->known);
    const unsigned all = (1u << count) - 1;
    unsigned due = trace_.all_due(*tile_) ? all : 0;
#pragma omp simd reduction(| : due)
    for (int k = 0; k < count; ++k)
      due |= static_cast<unsigned>(!(path < limit[k])) << k;
    return due;
  }

  /// Takes note of the particles of a block that are due. What is known of them lies apart in memory, and is asked for
  /// some particles ahead.
  void look(long first, long last) {
    for (unsigned due = due_lanes(first, static_cast<int>(last - first)); due != 0; due &= due - 1) {
      const long p = first + exec::lowest_bit(due);
      if (noted_ == most_noted)
        keep_all(ahead);
      exec::prefetch(in_.memory + (p + tile_->known));
      exec::prefetch(in_.memory + (p + tile_->known) + 1);
      exec::prefetch(in_.x + p);
      exec::prefetch(in_.y + p);
      note_[noted_++] = {p, tile_};
    }
  }

  /// Brings all that were noted up to date but the last few.
  void keep_all(int but) {
    const int end = noted_ - but;
    for (int i = 0; i < end; ++i)
      in_.limit[note_[i].particle + note_[i].tile->known] = trace_.keep(*note_[i].tile, note_[i].particle);
    std::copy(note_ + end, note_ + noted_, note_);
    noted_ = but;
  }

  struct Note {
    long particle;
    TileTrace* tile;
  };
  static constexpr int most_noted = 32, ahead = 8;

  const TraceInput<Real>& in_;
  Tracer<Shape, Real> trace_;
  TileTrace* tile_ = nullptr;      ///< in hand, and
  long first_ = 0, last_ = 0;      ///< its particles
  double* block_limit_ = nullptr;  ///< [blocks]
  Note note_[most_noted];
  int noted_ = 0;
};

}  // namespace detail

/// Sees to all particles of the first `marked` marked tiles.
template <class Shape, class Real>
void trace_tiles(const exec::Space& space, long marked, const TraceInput<Real>& input, const CrossingStore& records) {
  constexpr long tiles_of_task = 8;
  exec::launch(space, (marked + tiles_of_task - 1) / tiles_of_task, [&](long task) {
    const long first = task * tiles_of_task;
    detail::TileTracer<Shape, Real>(input, records).tiles(first, std::min(marked, first + tiles_of_task));
  });
}

}  // namespace RIVEN_SIDE

}  // namespace riven
