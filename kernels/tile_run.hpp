// The tiles that a kernel runs over, and what it reads of them.
#pragma once
#include "core/state/particles.hpp"
#include "kernels/scatter.hpp"
#include "kernels/tile_reads.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

template <class Real>
struct TileRun {
  const Tiles& tiles;
  const Lattice& lattice;
  CrossingSlots extra;
  TileReads<Real> reads;
};

}  // namespace RIVEN_SIDE

}  // namespace riven
