// tiles.hpp on a device: a team takes a tile, and each of its threads one particle after the other. What they add to
// nodes is summed in memory that the team shares, and then added to the grid.
#pragma once
#include <type_traits>

#include "core/exec/parallel.hpp"
#include "core/plan/plan.hpp"
#include "core/state/crack_fields.hpp"
#include "kernels/tile_run.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// A particle that sees no node across a crack.
struct Uncrossed {
  static constexpr bool value = false;
};

/// One that does.
struct Crossed {
  static constexpr bool value = true;
  const int* slots;  ///< of the first such particle of its block
  int before;        ///< how many of them come before it
};

template <class Shape, class Stretch, class Body>
RIVEN_INLINE void each_particle(const Stretch& stretch, long, int, const Body& body) {
  if constexpr (Stretch::value)
    body(0, stretch.slots + stretch.before * Shape::width * Shape::width);
  else
    body(0, nullptr);
}

template <class Real, class Shape, class Stretch, class One, class Four>
RIVEN_INLINE void each_four(const Stretch& stretch, const Block<Real, Shape>&, long first, int count, bool,
                            const One& one, const Four&) {
  each_particle<Shape>(stretch, first, count, one);
}

template <bool Gradient, class Real, class Shape, class Stretch, class Take>
RIVEN_INLINE void each_gathered(const Stretch& stretch, const Block<Real, Shape>&, long first, int count, bool,
                                const Take& take) {
  each_particle<Shape>(stretch, first, count, take);
}

template <class Stretch>
RIVEN_INLINE void ask_ahead(const Stretch&, long) {}

/// All tiles add to the grid at once, and all threads of a team to its sums.
inline bool slots_are_shared(const exec::Space&, ScatterKind) {
  return true;
}

namespace detail {

/// Bits of a word that are set.
RIVEN_INLINE int bits_of(unsigned word) {
#if defined(__CUDA_ARCH__)
  return __popc(word);
#else
  return __builtin_popcount(word);
#endif
}

/// Tiles as teams see them, by value.
struct TileList {
  static constexpr int threads = 128;  ///< of a team

  const int* list;
  const int* start;  ///< [tiles + 1] particles
  CrossingSlots extra;
  bool in_order;  ///< one thread takes all particles of a tile: the order of sums does not depend on the device

  /// body(stretch, i, i + 1, more..., seen) for the particles of list[t]. `all_seen`: shared, one for each thread.
  template <class Watch, class Body, class... More>
  RIVEN_KERNEL void run(const exec::Team& team, long t, const Watch& watch, typename Watch::Seen* all_seen,
                        const Body& body, const More&... more) const {
    const int tile = list[t], first = start[tile], end = start[tile + 1];
    const int takers = in_order ? 1 : team.threads();
    team.each_thread([&](int thread) {
      typename Watch::Seen seen{};
      for (int i = first + thread; i < end && thread < takers; i += takers)
        run_particle(tile, first, i, body, more..., seen);
      if constexpr (!std::is_empty_v<typename Watch::Seen>)
        all_seen[thread] = seen;
    });
    if constexpr (!std::is_empty_v<typename Watch::Seen>)
      team.each(1, [&](long) { watch.put(tile, all_seen, team.threads()); });
  }

 private:
  template <class Body, class... More>
  RIVEN_KERNEL void run_particle(int tile, long first, long i, const Body& body, More&... more) const {
    if (extra.tile_marked && extra.tile_marked[tile] != 0) {
      const long block = CrackFields::block_of(first, extra.tile_marked[tile] - 1) + (i - first) / exec::block;
      const int lane = static_cast<int>((i - first) % exec::block);
      const unsigned crossing = extra.crossing[block];
      if (crossing >> lane & 1u) {
        const int before = bits_of(crossing & ((1u << lane) - 1u));
        return body(Crossed{extra.slots + extra.block_slots[block], before}, i, i + 1, more...);
      }
    }
    body(Uncrossed{}, i, i + 1, more...);
  }
};

/// The memory that a team shares: sums of nodes, and what its threads saw.
template <bool Mass, class Real, class Seen>
struct TileMemory {
  static constexpr int nodes = tile_reach * tile_reach;
  alignas(32) Real q[4 * nodes];
  Real mass[Mass ? nodes : 1];
  Seen seen[TileList::threads];
};

/// Adds a tile's sums to the grid.
template <bool Mass, class Real>
RIVEN_KERNEL void flush(const exec::Team& team, const Lattice& lattice, int corner_x, int corner_y, const Real* mass,
                        const Real* q, Real* grid_mass, Real* grid_q) {
  team.each(tile_reach * tile_reach, [&](long n) {
    const int i = corner_x + static_cast<int>(n) % tile_reach, j = corner_y + static_cast<int>(n) / tile_reach;
    if (i < 0 || j < 0 || i >= lattice.nx || j >= lattice.ny)
      return;
    const long g = static_cast<long>(j) * lattice.nx + i;
    for (int c = 0; c < 4; ++c)
      if (q[4 * n + c] != 0)
        exec::atomic_add(grid_q[4 * g + c], q[4 * n + c]);
    if constexpr (Mass)
      if (mass[n] != 0)
        exec::atomic_add(grid_mass[g], mass[n]);
  });
}

}  // namespace detail

template <class Real, class Watch, class Body>
void each_tile(const exec::Space& space, const char* label, const TileRun<Real>& run, const Watch& watch,
               const Body& body) {
  using Seen = typename Watch::Seen;
  const detail::TileList tiles{exec::data(run.tiles.filled), exec::data(run.tiles.start), run.extra, false};
  exec::parallel_teams(
      space, label, run.tiles.filled.size(), tiles.threads, tiles.threads * sizeof(Seen),
      [=] RIVEN_KERNEL(const exec::Team& team, long t) { tiles.run(team, t, watch, team.shared<Seen>(), body); });
}

template <bool Mass, class Real, class Watch, class Body>
void scatter_tiles(const exec::Space& space, const char* label, ScatterKind kind, const TileRun<Real>& run,
                   Real* grid_mass, Real* grid_q, const Watch& watch, const Body& body) {
  using Memory = detail::TileMemory<Mass, Real, typename Watch::Seen>;
  const Lattice lattice = run.lattice;
  const bool ordered = kind == ScatterKind::ordered;
  const int* list = exec::data(ordered ? run.tiles.by_colour : run.tiles.filled);
  const detail::TileList all{list, exec::data(run.tiles.start), run.extra, ordered};
  const exec::Stopwatch timed(space.timers(), label);
  for (int colour = 0; colour < (ordered ? 4 : 1); ++colour) {
    const int* const first = &run.tiles.colour_start[colour];
    detail::TileList tiles = all;
    if (ordered)
      tiles.list += first[0];
    exec::launch_teams(space, ordered ? first[1] - first[0] : run.tiles.filled.size(), tiles.threads, sizeof(Memory),
                       [=] RIVEN_KERNEL(const exec::Team& team, long t) {
                         Memory& own = *team.shared<Memory>();
                         team.each(4 * Memory::nodes, [&](long n) { own.q[n] = 0; });
                         if constexpr (Mass)
                           team.each(Memory::nodes, [&](long n) { own.mass[n] = 0; });
                         const int tile = tiles.list[t];
                         const int corner_x = tile % lattice.tiles_x() * Lattice::tile - tile_margin;
                         const int corner_y = tile / lattice.tiles_x() * Lattice::tile - tile_margin;
                         const NodeTarget<Real> to{own.mass, own.q, tile_reach, corner_x, corner_y};
                         tiles.run(team, t, watch, own.seen, body, to);
                         detail::flush<Mass>(team, lattice, corner_x, corner_y, own.mass, own.q, grid_mass, grid_q);
                       });
  }
}

}  // namespace RIVEN_SIDE

}  // namespace riven
