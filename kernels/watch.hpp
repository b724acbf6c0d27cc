// What the particle passes notice on their way, at the price of a few additions: how far particles moved, the least
// det F, whether any number stopped being one, and what energy the transfer took.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/exec/config.hpp"
#include "core/state/state.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// Of one tile, lane by lane, so that noticing stays in the vectorised loops.
template <class Real>
struct TileWatch {
  static constexpr int lanes = exec::lanes;
  alignas(exec::line) Real move[lanes] = {};    ///< largest |dx| along an axis
  alignas(exec::line) Real sum[lanes] = {};     ///< finite as long as every move is
  alignas(exec::line) Real J[lanes];            ///< least det F; NaN sticks
  alignas(exec::line) double worn[lanes] = {};  ///< J
  alignas(exec::line) Real apart[lanes] = {};   ///< largest difference of velocities along an axis

  RIVEN_INLINE TileWatch() {
    for (Real& j : J)
      j = std::numeric_limits<Real>::max();
  }
  RIVEN_INLINE void moves(int k, Real dx, Real dy) {
    const Real x = std::abs(dx), y = std::abs(dy), most = x > y ? x : y;
    move[k] = most > move[k] ? most : move[k];
    sum[k] += x + y;
  }
  RIVEN_INLINE void det_F(int k, Real other) { J[k] = J[k] < other ? J[k] : J[k] != J[k] ? J[k] : other; }
};

/// Where tiles put what they noticed: of moves, of how velocities changed, and of det F.
template <class Real, bool Moves, bool Velocities, bool Dets>
struct WatchTiles {
  using Seen = TileWatch<Real>;
  /// `wears`: the transfer takes energy, which is to be noticed.
  /// `apart`: velocities of particles and grid are compared.
  explicit WatchTiles(StepWatch& w, bool wears = false, bool apart = false)
      : move(exec::data(w.tile_move)),
        J(exec::data(w.tile_J)),
        finite(exec::data(w.tile_finite)),
        worn(wears ? exec::data(w.tile_worn) : nullptr),
        apart(apart ? exec::data(w.tile_apart) : nullptr) {}

  /// What `count` threads noticed of a tile.
  RIVEN_INLINE void put(int tile, const Seen* t, int count = 1) const {
    if constexpr (Moves)
      put_moves(tile, t, count);
    if constexpr (Velocities)
      put_velocities(tile, t, count);
    if constexpr (Dets)
      put_J(tile, t, count);
  }

 private:
  RIVEN_INLINE void put_moves(int tile, const Seen* seen, int count) const {
    Real most = 0, all = 0;
    for (const Seen* t = seen; t < seen + count; ++t)
      for (int k = 0; k < t->lanes; ++k) {
        most = std::max(most, t->move[k]);
        all += t->sum[k];
      }
    move[tile] = most;
    finite[tile] = all;
  }
  RIVEN_INLINE void put_velocities(int tile, const Seen* seen, int count) const {
    if (apart) {
      Real far = 0;
      for (const Seen* t = seen; t < seen + count; ++t)
        for (int k = 0; k < t->lanes; ++k)
          far = std::max(far, t->apart[k]);
      apart[tile] = far;
    }
    if (worn) {
      double taken = 0;
      for (const Seen* t = seen; t < seen + count; ++t)
        for (int k = 0; k < t->lanes; ++k)
          taken += t->worn[k];
      worn[tile] = taken;
    }
  }
  RIVEN_INLINE void put_J(int tile, const Seen* seen, int count) const {
    Real least = seen->J[0];
    for (const Seen* t = seen; t < seen + count; ++t)
      for (int k = 0; k < t->lanes; ++k)
        least = least < t->J[k] || least != least ? least : t->J[k];
    J[tile] = least;
  }
  double *move, *J, *finite, *worn, *apart;
};

/// Notices nothing.
struct WatchNothing {
  struct Seen {};
  RIVEN_INLINE void put(int, const Seen*, int = 1) const {}
};

/// Whether particles' velocities are compared with the grid's in a step: now and then is enough.
inline bool velocities_compared(long step) {
  return step % 16 == 0;
}

/// Largest move and drift since the last sort; NaN if any particle's move is not finite.
template <class Real>
void watch_moves(State<Real, 2>& s) {
  StepWatch& w = s.watch;
  const StepWatch& seen = s.watch;
  const exec::Array<int>& filled = std::as_const(s.particles.tiles.filled);
  double move = 0, sum = 0;
  for (int t : filled) {
    move = std::max(move, seen.tile_move[t]);
    sum += seen.tile_finite[t];
  }
  w.largest_move = std::isfinite(sum) ? move : std::numeric_limits<double>::quiet_NaN();
  w.drift += w.largest_move;
}

/// Books what the transfer took, and notes how far velocities of particles and grid are apart.
template <class Real>
void watch_velocities(State<Real, 2>& s) {
  const StepWatch& seen = s.watch;
  const exec::Array<int>& filled = std::as_const(s.particles.tiles.filled);
  double worn = 0;
  for (int t : filled)
    worn += seen.tile_worn[t];
  s.ledger.energy.transfer += worn;
  if (!velocities_compared(s.clock.step))
    return;
  double apart = 0;
  for (int t : filled)
    apart = std::max(apart, seen.tile_apart[t]);
  s.watch.velocity_difference = apart;
}

/// Least det F; NaN if any is.
template <class Real>
void watch_J(State<Real, 2>& s) {
  double least = std::numeric_limits<double>::max();
  const StepWatch& seen = s.watch;
  for (int t : std::as_const(s.particles.tiles.filled)) {
    const double J = seen.tile_J[t];
    least = least < J || least != least ? least : J;
  }
  s.watch.least_J = least;
}

}  // namespace RIVEN_SIDE

}  // namespace riven
