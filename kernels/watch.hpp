// What the particle passes notice on their way, at the price of a few additions: how far particles moved, the least
// det F, and whether any number stopped being one.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/exec/config.hpp"
#include "core/state/state.hpp"

namespace riven {

/// Of one tile.
template <class Real>
struct TileWatch {
  Real move = 0;                              ///< largest |dx| along an axis
  Real sum = 0;                               ///< finite as long as every move is
  Real J = std::numeric_limits<Real>::max();  ///< least det F; NaN sticks

  RIVEN_INLINE void moves(const Real* dx, const Real* dy, int count) {
    for (int k = 0; k < count; ++k) {
      move = std::max(move, std::max(std::abs(dx[k]), std::abs(dy[k])));
      sum += std::abs(dx[k]) + std::abs(dy[k]);
    }
  }
  RIVEN_INLINE void least_J(Real other) { J = J < other || J != J ? J : other; }
};

/// Where tiles put what they noticed.
struct WatchTiles {
  explicit WatchTiles(StepWatch& w) : move(w.tile_move.data()), J(w.tile_J.data()), finite(w.tile_finite.data()) {}

  template <class Real>
  RIVEN_INLINE void put_moves(int tile, const TileWatch<Real>& t) const {
    move[tile] = t.move;
    finite[tile] = t.sum;
  }
  template <class Real>
  RIVEN_INLINE void put_J(int tile, const TileWatch<Real>& t) const {
    J[tile] = t.J;
  }
  double *move, *J, *finite;
};

/// Largest move and drift since the last sort; NaN if any particle's move is not finite.
template <class Real>
void watch_moves(State<Real, 2>& s) {
  StepWatch& w = s.watch;
  double move = 0, sum = 0;
  for (int t : s.particles.tiles.by_colour) {
    move = std::max(move, w.tile_move[t]);
    sum += w.tile_finite[t];
  }
  w.largest_move = std::isfinite(sum) ? move : std::numeric_limits<double>::quiet_NaN();
  w.drift += w.largest_move;
}

/// Least det F; NaN if any is.
template <class Real>
void watch_J(State<Real, 2>& s) {
  TileWatch<double> all;
  for (int t : s.particles.tiles.by_colour)
    all.least_J(s.watch.tile_J[t]);
  s.watch.least_J = all.J;
}

}  // namespace riven
