// Takes node values, in groups of four, from the nodes of a particle of a block.
#pragma once
#include <algorithm>
#include <type_traits>

#include "kernels/block.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// Four node values at a particle, and their gradients.
template <class Real>
struct Gathered {
  Quad<Real> value, dx, dy;
};

/// The same at four particles, [node value] of the particles, the gradients of the first two alone.
template <class Real>
struct GatheredFour {
  Quad<Real> value[4], dx[2], dy[2];
};

/// Gradients of two node values at a particle.
template <class Real>
struct GatheredPair {
  Real dx[2], dy[2];
};
template <int First, class Real>
RIVEN_INLINE GatheredPair<Real> pair_of(const Gathered<Real>& g) {
  return {{g.dx[First], g.dx[First + 1]}, {g.dy[First], g.dy[First + 1]}};
}

/// Puts a number of one particle, or of four that follow each other, where lanes hold it.
template <class Real>
RIVEN_INLINE void put(Real* lane, Real value) {
  *lane = value;
}
template <class Real>
RIVEN_INLINE void put(Real* lane, const Quad<Real>& values) {
  put_four(lane, values);
}

/// sum S q, sum dS/dx q, sum dS/dy q over the nodes of particle k; with other second weights by these.
template <bool Gradient, Second Of = Second::gradients, class Real, class Shape>
RIVEN_INLINE Gathered<Real> gather(const Block<Real, Shape>& w, int k, const Real* q, int nx) {
  constexpr int N = Shape::width;
  Gathered<Real> out{};
  const Real* row = q + 4L * (static_cast<long>(w.iy[k]) * nx + w.ix[k]);
#pragma GCC unroll 3
  for (int j = 0; j < N; ++j, row += 4L * nx) {
    Quad<Real> s{}, d{};
#pragma GCC unroll 3
    for (int i = 0; i < N; ++i) {
      const Quad<Real>& n = quad_at<Real>(row + 4 * i);
      s += w.sx[i][k] * n;
      if constexpr (Gradient)
        d += w.template second_x<Of>(i, k) * n;
    }
    out.value += w.sy[j][k] * s;
    if constexpr (Gradient) {
      out.dx += w.sy[j][k] * d;
      out.dy += w.template second_y<Of>(j, k) * s;
    }
  }
  return out;
}

/// The same for a particle that sees some nodes across cracks.
template <bool Gradient, Second Of = Second::gradients, class Real, class Shape>
RIVEN_INLINE Gathered<Real> gather_slots(const Block<Real, Shape>& w, int k, const Real* q, const int* slots) {
  constexpr int N = Shape::width;
  Gathered<Real> out{};
#pragma GCC unroll 3
  for (int j = 0; j < N; ++j) {
    Quad<Real> s{}, d{};
#pragma GCC unroll 3
    for (int i = 0; i < N; ++i) {
      const Quad<Real>& n = quad_at<Real>(q + 4L * slots[j * N + i]);
      s += w.sx[i][k] * n;
      if constexpr (Gradient)
        d += w.template second_x<Of>(i, k) * n;
    }
    out.value += w.sy[j][k] * s;
    if constexpr (Gradient) {
      out.dx += w.sy[j][k] * d;
      out.dy += w.template second_y<Of>(j, k) * s;
    }
  }
  return out;
}

/// The same for lanes k .. k + 3, which have the same nodes, and of the first `Values` node values alone: a vector
/// holds one number of all four.
template <bool Gradient, int Values, Second Of = Second::gradients, class Real, class Shape>
RIVEN_INLINE GatheredFour<Real> gather_four(const Block<Real, Shape>& w, int k, const Real* q, int nx) {
  constexpr int N = Shape::width, components = std::max(Values, Gradient ? 2 : 0);
  GatheredFour<Real> out{};
  const Real* row = q + 4L * (static_cast<long>(w.iy[k]) * nx + w.ix[k]);
#pragma GCC unroll 3
  for (int j = 0; j < N; ++j, row += 4L * nx) {
    const Quad<Real> sy = four_at(w.sy[j] + k), gy = w.template four_y<Of>(j, k);
#pragma GCC unroll 4
    for (int c = 0; c < components; ++c) {
      Quad<Real> s{};
#pragma GCC unroll 3
      for (int i = 0; i < N; ++i)
        s += row[4 * i + c] * four_at(w.sx[i] + k);
      if (c < Values)
        out.value[c] += sy * s;
      if (Gradient && c < 2) {
        Quad<Real> d{};
#pragma GCC unroll 3
        for (int i = 0; i < N; ++i)
          d += row[4 * i + c] * w.template four_x<Of>(i, k);
        out.dx[c] += sy * d;
        out.dy[c] += gy * s;
      }
    }
  }
  return out;
}

/// One of these, by what each_particle or each_four hands over.
template <bool Gradient, int Values, Second Of = Second::gradients, class Real, class Shape, class Slots>
RIVEN_INLINE auto gather_from(const Block<Real, Shape>& w, int k, const Real* q, int nx, Slots slots) {
  if constexpr (std::is_same_v<Slots, FourTogether>)
    return gather_four<Gradient, Values, Of>(w, k, q, nx);
  else if constexpr (std::is_pointer_v<Slots>)
    return gather_slots<Gradient, Of>(w, k, q, slots);
  else
    return gather<Gradient, Of>(w, k, q, nx);
}

}  // namespace RIVEN_SIDE

}  // namespace riven
