// Takes node values, in groups of four, from the nodes of a particle of a block.
#pragma once
#include <type_traits>

#include "kernels/block.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// Four node values at a particle, and their gradients.
template <class Real>
struct Gathered {
  Quad<Real> value, dx, dy;
};

/// sum S q, sum dS/dx q, sum dS/dy q over the nodes of particle k.
template <bool Gradient, class Real, class Shape>
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
        d += w.gx[i][k] * n;
    }
    out.value += w.sy[j][k] * s;
    if constexpr (Gradient) {
      out.dx += w.sy[j][k] * d;
      out.dy += w.gy[j][k] * s;
    }
  }
  return out;
}

/// The same for a particle that sees some nodes across cracks.
template <bool Gradient, class Real, class Shape>
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
        d += w.gx[i][k] * n;
    }
    out.value += w.sy[j][k] * s;
    if constexpr (Gradient) {
      out.dx += w.sy[j][k] * d;
      out.dy += w.gy[j][k] * s;
    }
  }
  return out;
}

/// The one or the other, by what each_particle hands over.
template <bool Gradient, class Real, class Shape, class Slots>
RIVEN_INLINE Gathered<Real> gather_from(const Block<Real, Shape>& w, int k, const Real* q, int nx, Slots slots) {
  if constexpr (std::is_pointer_v<Slots>)
    return gather_slots<Gradient>(w, k, q, slots);
  else
    return gather<Gradient>(w, k, q, nx);
}

}  // namespace RIVEN_SIDE

}  // namespace riven
