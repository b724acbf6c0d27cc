// tiles.hpp on the host: a thread takes a tile, in blocks of particles whose loops are vectorised.
#pragma once
#include <algorithm>
#include <optional>
#include <type_traits>

#include "core/exec/parallel.hpp"
#include "core/state/crack_fields.hpp"
#include "kernels/block.hpp"
#include "kernels/square_locks.hpp"
#include "kernels/tile_run.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// A stretch of blocks in which no particle sees a node across a crack.
template <class Real>
struct Uncrossed {
  static constexpr bool value = false;
  const TileAhead<Real>* ahead;  ///< null for the last tiles
};

/// A stretch of blocks in which some do.
template <class Real>
struct Crossed {
  static constexpr bool value = true;
  const TileAhead<Real>* ahead;
  long begin;                     ///< first particle
  const std::uint16_t* crossing;  ///< of the stretch's first block, as in CrossingSlots
  const int* block_slots;
  const int* slots;
};

template <class Shape, class Stretch, class Body>
RIVEN_INLINE void each_particle(const Stretch& stretch, long first, int count, const Body& body) {
  if constexpr (Stretch::value) {
    const long block = (first - stretch.begin) / exec::lanes;
    const unsigned crossing = stretch.crossing[block];
    const int* slots = stretch.slots + stretch.block_slots[block];
    for (int k = 0; k < count; ++k)
      if (crossing >> k & 1u) {
        body(k, slots);
        slots += Shape::width * Shape::width;
      } else {
        body(k, nullptr);
      }
  } else {
    for (int k = 0; k < count; ++k)
      body(k, nullptr);
  }
}

template <class Real, class Shape, class Stretch, class One, class Four>
RIVEN_INLINE void each_four(const Stretch& stretch, const Block<Real, Shape>& w, long first, int count, bool in_cells,
                            const One& one, const Four& four) {
  if (!in_cells)
    return each_particle<Shape>(stretch, first, count, one);
  unsigned crossing = 0;
  const int* slots = nullptr;
  if constexpr (Stretch::value) {
    const long block = (first - stretch.begin) / exec::lanes;
    crossing = stretch.crossing[block];
    slots = stretch.slots + stretch.block_slots[block];
  }
  for (int k = 0; k < count;) {
    if (k + 4 <= count && (crossing >> k & 15u) == 0 && w.four_together(k)) {
      four(k);
      k += 4;
      continue;
    }
    if constexpr (Stretch::value)
      if (crossing >> k & 1u) {
        one(k++, slots);
        slots += Shape::width * Shape::width;
        continue;
      }
    one(k++, nullptr);
  }
}

template <bool Gradient, class Real, class Shape, class Stretch, class Take>
RIVEN_INLINE void each_gathered(const Stretch& stretch, const Block<Real, Shape>& w, long first, int count,
                                bool in_cells, const Take& take) {
  if constexpr (Gradient)
    each_four(stretch, w, first, count, in_cells, take, [&](int k) RIVEN_LANE { take(k, FourTogether{}); });
  else
    each_particle<Shape>(stretch, first, count, take);
}

template <class Stretch>
RIVEN_INLINE void ask_ahead(const Stretch& stretch, long first) {
  if (stretch.ahead)
    stretch.ahead->ask(first);
}

namespace detail {

/// Blocks without a crossing particle that a crossed stretch passes over rather than end: a call costs more.
inline constexpr long gap = 1;

/// Compiled once for each body and kind of stretch, whoever calls it.
template <class Body, class Stretch, class... More>
RIVEN_ONCE void run_stretch(const Body& body, Stretch stretch, long first, long last, More&... more) {
  const Body own = body;  // what a body writes cannot change what it captured
  own(stretch, first, last, more...);
}

/// body(stretch, first, last, more...) for a tile, cut into stretches of blocks.
template <class Real, class Body, class... More>
RIVEN_INLINE void each_stretch(const CrossingSlots& e, int tile, long first, long last, const TileAhead<Real>* ahead,
                               const Body& body, More&... more) {
  const Uncrossed<Real> uncrossed{ahead};
  if (!e.tile_marked || e.tile_marked[tile] == 0)
    return run_stretch(body, uncrossed, first, last, more...);
  long block = CrackFields::block_of(first, e.tile_marked[tile] - 1);
  const long blocks = block + (last - first + exec::lanes - 1) / exec::lanes;
  while (block < blocks) {
    const bool crossed = e.crossing[block] != 0;
    const Crossed<Real> stretch{ahead, first, e.crossing + block, e.block_slots + block, e.slots};
    long stop = block + 1;
    if (crossed) {
      for (long next = stop; next < blocks && next <= stop + gap; ++next)
        if (e.crossing[next] != 0)
          stop = next + 1;
    } else {
      while (stop < blocks && e.crossing[stop] == 0)
        ++stop;
    }
    const long end = std::min(first + (stop - block) * exec::lanes, last);
    if (crossed)
      run_stretch(body, stretch, first, end, more...);
    else
      run_stretch(body, uncrossed, first, end, more...);
    first = end;
    block = stop;
  }
}

}  // namespace detail

namespace detail {

/// The same as tasks see it, by value.
template <class Real>
struct TileList {
  const int* list;
  const int* start;  ///< [tiles + 1] particles
  long count;
  bool asks;  ///< for the tile after the one in hand, which a thread is likely to take next
  Lattice lattice;
  CrossingSlots extra;
  TileReads<Real> reads;

  TileList(const TileRun<Real>& run, const exec::Array<int>& tiles, int first, int last)
      : list(tiles.data() + first),
        start(run.tiles.start.data()),
        count(last - first),
        asks(asking_pays<Real>(start[run.tiles.start.size() - 1])),
        lattice(run.lattice),
        extra(run.extra),
        reads(run.reads) {}

  template <class Watch, class Body, class... More>
  RIVEN_INLINE void run(long t, const Watch& watch, const Body& body, More&... more) const {
    const int tile = list[t];
    std::optional<TileAhead<Real>> later;
    if (asks && t + 1 < count) {
      const int next = list[t + 1];
      later.emplace(reads, lattice, start[tile], start[tile + 1], next, start[next], start[next + 1]);
    }
    typename Watch::Seen seen{};
    each_stretch(extra, tile, start[tile], start[tile + 1], later ? &*later : nullptr, body, more..., seen);
    watch.put(tile, &seen);
  }
};

}  // namespace detail

template <class Real, class Watch, class Body>
void each_tile(const exec::Space& space, const char* label, const TileRun<Real>& run, const Watch& watch,
               const Body& body) {
  const int count = static_cast<int>(run.tiles.filled.size());
  const detail::TileList<Real> tiles(run, run.tiles.filled, 0, count);
  exec::parallel_tasks(space, label, count, [=](long t) { tiles.run(t, watch, body); });
}

/// Whether extra slots may be written by several tiles at once.
inline bool slots_are_shared(const exec::Space& space, ScatterKind kind) {
  return kind == ScatterKind::atomic && space.threads() > 1;
}

namespace detail {

/// Adds a tile's buffer to the grid, square by square; those that other tiles reach, too, with their locks held.
template <bool Mass, class Real>
void flush(const Lattice& lattice, int corner_x, int corner_y, const Real* mass, const Real* q, Real* grid_mass,
           Real* grid_q, SquareLocks* locks) {
  constexpr int edge = SquareLocks::edge, squares = tile_reach / edge;
  static_assert(tile_reach % edge == 0 && Lattice::tile % edge == 0 && edge == 2 * tile_margin);
  for (int square = 0; square < squares * squares; ++square) {
    const int across = square % squares, up = square / squares;
    const int left = std::max(across * edge, -corner_x), right = std::min((across + 1) * edge, lattice.nx - corner_x);
    const int lower = std::max(up * edge, -corner_y), upper = std::min((up + 1) * edge, lattice.ny - corner_y);
    if (left >= right || lower >= upper)
      continue;
    const bool own = across > 0 && across < squares - 1 && up > 0 && up < squares - 1;
    std::optional<SquareLocks::Hold> hold;
    if (locks && !own)
      hold.emplace(*locks, corner_x + across * edge, corner_y + up * edge);
    for (int j = lower; j < upper; ++j)
      for (int i = left; i < right; ++i) {
        const long n = j * tile_reach + i, g = static_cast<long>(corner_y + j) * lattice.nx + corner_x + i;
        quad_at<Real>(grid_q + 4 * g) += quad_at<Real>(q + 4 * n);
        if constexpr (Mass)
          grid_mass[g] += mass[n];
      }
  }
}

}  // namespace detail

/// Ordered sums go straight into the grid; the buffers of the atomic kind are added to it under locks.
template <bool Mass, class Real, class Watch, class Body>
void scatter_tiles(const exec::Space& space, const char* label, ScatterKind kind, const TileRun<Real>& run,
                   Real* grid_mass, Real* grid_q, const Watch& watch, const Body& body) {
  const exec::Stopwatch timed(space.timers(), label);
  const Lattice lattice = run.lattice;
  if (kind == ScatterKind::ordered) {
    const NodeTarget<Real> whole{grid_mass, grid_q, lattice.nx, 0, 0};
    for (int colour = 0; colour < 4; ++colour) {
      const int* const first = &run.tiles.colour_start[colour];
      const int count = first[1] - first[0];
      const detail::TileList<Real> tiles(run, run.tiles.by_colour, first[0], first[1]);
      exec::launch(space, count, [=](long t) { tiles.run(t, watch, body, whole); });
    }
    return;
  }
  std::optional<SquareLocks> locks;
  if (space.threads() > 1)
    locks.emplace(lattice);
  SquareLocks* const held = locks ? &*locks : nullptr;
  const int count = static_cast<int>(run.tiles.filled.size());
  const detail::TileList<Real> tiles(run, run.tiles.filled, 0, count);
  exec::launch(space, count, [=](long t) {
    const int tile = tiles.list[t];
    const int corner_x = tile % lattice.tiles_x() * Lattice::tile - tile_margin;
    const int corner_y = tile / lattice.tiles_x() * Lattice::tile - tile_margin;
    alignas(64) Real mass[Mass ? tile_reach * tile_reach + 1 : 1] = {};  // one more: see add_row
    alignas(64) Real q[4 * tile_reach * tile_reach] = {};
    const NodeTarget<Real> own{mass, q, tile_reach, corner_x, corner_y};
    tiles.run(t, watch, body, own);
    detail::flush<Mass>(lattice, corner_x, corner_y, mass, q, grid_mass, grid_q, held);
  });
}

}  // namespace RIVEN_SIDE

}  // namespace riven
