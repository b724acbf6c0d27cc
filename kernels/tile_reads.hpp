// What a kernel reads of a tile, asked for while the one before is worked on.
//
// Tiles of one colour lie apart in memory, and so do the rows of nodes around a tile: no processor looks ahead over
// these gaps by itself, and each step works through more data than its caches hold. A core waits for some twenty lines
// at a time and drops what else it is asked for, so that a tile is asked for bit by bit: with each block of particles,
// the block of the next tile that stands in its place, and a few rows of its nodes.
#pragma once
#include <algorithm>

#include "core/state/grid.hpp"
#include "core/state/particles.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// Particles may have drifted by one cell since they were sorted, and see nodes up to one more away: a tile sees the
/// nodes from -2 to 9 around its corner.
inline constexpr int tile_margin = 2;
inline constexpr int tile_reach = Lattice::tile + 2 * tile_margin;

/// Arrays that a kernel reads or writes; null where it does not.
template <class Real>
struct TileReads {
  const double* exact[6] = {};  ///< of particles, those that are in double whatever Real is
  const Real* particles[6] = {};
  const Real* quads[2] = {};   ///< of nodes, four numbers each
  const Real* mass = nullptr;  ///< of nodes
};

/// Whether a step goes through more data than caches hold: about 17 numbers per particle, 7 of them always in double.
/// With 65,000 particles in double asking costs 2 to 3 % of a step, with 100,000 it saves 2 %, with 160,000 and cracks
/// 5 to 9 %.
template <class Real>
bool asking_pays(long particles) {
  return particles * long{7 * sizeof(double) + 10 * sizeof(Real)} > 12L << 20;
}

/// The tile that comes after the one in hand. `reads` must outlive it.
template <class Real>
class TileAhead {
 public:
  /// `begin`, `end`: particles of the tile in hand; `next_begin`, `next_end`: of the next one.
  TileAhead(const TileReads<Real>& reads, const Lattice& lattice, long begin, long end, int next, long next_begin,
            long next_end)
      : reads_(reads),
        nx_(lattice.nx),
        left_(std::max(next % lattice.tiles_x() * Lattice::tile - tile_margin, 0)),
        right_(std::min(next % lattice.tiles_x() * Lattice::tile - tile_margin + tile_reach, lattice.nx)),
        lower_(std::max(next / lattice.tiles_x() * Lattice::tile - tile_margin, 0)),
        upper_(std::min(next / lattice.tiles_x() * Lattice::tile - tile_margin + tile_reach, lattice.ny)),
        begin_(begin),
        blocks_(static_cast<int>((end - begin + exec::lanes - 1) / exec::lanes)),
        next_begin_(next_begin),
        next_end_(next_end) {}

  /// Asks for its share with the block of particle `first` of the tile in hand.
  RIVEN_INLINE void ask(long first) const {
    constexpr int line = 64 / sizeof(Real);
    const int block = static_cast<int>((first - begin_) / exec::lanes);
    const long p = next_begin_ + (first - begin_);
    if (p < next_end_) {
      ask_each(reads_.exact, p);
      ask_each(reads_.particles, p);
    }
    const int rows = upper_ - lower_;
    for (int j = lower_ + rows * block / blocks_; j < lower_ + rows * (block + 1) / blocks_; ++j) {
      const long row = static_cast<long>(j) * nx_;
      for (const Real* q : reads_.quads)
        for (int i = left_; q && i < right_; i += line / 4)
          exec::prefetch_far(q + 4 * (row + i));
      for (int i = left_; reads_.mass && i < right_; i += line)
        exec::prefetch_far(reads_.mass + row + i);
    }
  }

 private:
  template <class T, int most>
  static RIVEN_INLINE void ask_each(const T* const (&arrays)[most], long p) {
    for (const T* array : arrays)
      for (int k = 0; array && k < exec::lanes; k += 64 / int{sizeof(T)})
        exec::prefetch_far(array + p + k);
  }

  const TileReads<Real>& reads_;
  int nx_, left_, right_, lower_, upper_;
  long begin_;
  int blocks_;
  long next_begin_, next_end_;
};

}  // namespace RIVEN_SIDE

}  // namespace riven
