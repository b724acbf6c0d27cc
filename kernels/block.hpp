// A block of particles: the weights of up to exec::lanes particles, computed together, and the moves of groups of
// four node values between one of them and its nodes.
//
// Shape functions are recomputed in every pass: storing 27 numbers per particle costs more than it saves.
#pragma once
#include "core/exec/atomic.hpp"
#include "core/math/quad.hpp"
#include "core/math/shape.hpp"
#include "core/state/bodies.hpp"
#include "core/state/grid.hpp"

namespace riven {

/// Particles' positions and how to turn them into weights.
template <class Real>
struct Positions {
  const Real* x;
  const Real* y;
  Real origin_x, origin_y, inv_h;
  BodyLookup<DomainSetting<Real, 2>> domain;
};

template <class Real, class Shape>
struct Block {
  static constexpr int N = Shape::width;
  static constexpr int lanes = exec::lanes;
  alignas(64) Real sx[N][lanes];
  alignas(64) Real sy[N][lanes];
  alignas(64) Real gx[N][lanes];  ///< d/dx, 1/m
  alignas(64) Real gy[N][lanes];
  alignas(64) int ix[lanes];  ///< first node along x
  alignas(64) int iy[lanes];

  /// Weights of particles first .. first + lanes - 1. Lanes past the end of a tile hold other particles or padding,
  /// whose weights nobody uses; computing them keeps the loop whole.
  RIVEN_INLINE void weigh(const Positions<Real>& p, long first) {
    if (p.domain.single) {
      const DomainSetting<Real, 2> d = p.domain.table[0];
      weigh_each(p, first, [&](long) -> const DomainSetting<Real, 2>& { return d; });
    } else {
      weigh_each(p, first, [&](long i) -> const DomainSetting<Real, 2>& { return p.domain.of(i); });
    }
  }

 private:
  template <class DomainOf>
  RIVEN_INLINE void weigh_each(const Positions<Real>& p, long first, const DomainOf& domain_of) {
    const Real* x = p.x + first;
    const Real* y = p.y + first;
    exec::for_lanes(lanes, [&](int k) RIVEN_LANE {
      const DomainSetting<Real, 2>& d = domain_of(first + k);
      const Axis<Real, N> a = Shape::axis((x[k] - p.origin_x) * p.inv_h, d.axis[0]);
      const Axis<Real, N> b = Shape::axis((y[k] - p.origin_y) * p.inv_h, d.axis[1]);
      for (int i = 0; i < N; ++i) {
        sx[i][k] = a.s[i];
        sy[i][k] = b.s[i];
        gx[i][k] = a.g[i] * p.inv_h;
        gy[i][k] = b.g[i] * p.inv_h;
      }
      ix[k] = a.base;
      iy[k] = b.base;
    });
  }
};

/// Where a scatter writes field 0: the whole grid (offset 0) or a tile's own buffer. `mass` may be null.
template <class Real>
struct NodeTarget {
  Real* mass;
  Real* q;
  int stride;
  int offset_x, offset_y;
  RIVEN_INLINE int at(int i, int j) const { return (j - offset_y) * stride + i - offset_x; }
};

/// The slots behind the plain grid, and the fields that lead to them. Without cracks `word` is null.
template <class Real>
struct ExtraSlots {
  const std::uint32_t* word = nullptr;          ///< CrackFields::fields
  const int* tile_marked = nullptr;             ///< CrackFields::tile_marked
  const std::uint8_t* block_crosses = nullptr;  ///< CrackFields::crossing
  const int* extra = nullptr;
  int nodes = 0;
  int nx = 0;
  bool atomic = false;  ///< slots may be written by several tiles at once
  RIVEN_INLINE int slot(int node, int field) const { return nodes + extra[node] + field - 1; }
};

inline constexpr int field_bits = 2;
RIVEN_INLINE int field_of(std::uint32_t word, int neighbour) {
  return (word >> (field_bits * neighbour)) & 3u;
}

template <class Real>
RIVEN_INLINE void add(Real& target, Real value, bool atomic) {
  if (atomic)
    exec::atomic_add(target, value);
  else
    target += value;
}

/// m[i] += ms sx[i] along one row of nodes. Three nodes are taken as four, the last with nothing added: it belongs to
/// the tile's reach or to the padding.
template <class Real, class Shape>
RIVEN_INLINE void add_row(Real* m, Real ms, const Block<Real, Shape>& w, int k) {
#if !defined(__CUDACC__)
  if constexpr (Shape::width == 3) {
    typedef Real Unaligned __attribute__((vector_size(4 * sizeof(Real)), aligned(sizeof(Real))));
    *reinterpret_cast<Unaligned*>(m) += ms * Unaligned{w.sx[0][k], w.sx[1][k], w.sx[2][k], Real(0)};
    return;
  }
#endif
  for (int i = 0; i < Shape::width; ++i)
    m[i] += ms * w.sx[i][k];
}

/// Adds to each node of particle k:  mass S  and  S A + dS/dx B + dS/dy C.
template <bool Mass, bool Gradient, class Real, class Shape>
RIVEN_INLINE void scatter(const Block<Real, Shape>& w, int k, Real mass, const Quad<Real>& A, const Quad<Real>& B,
                          const Quad<Real>& C, const NodeTarget<Real>& to) {
  constexpr int N = Shape::width;
  const int first = to.at(w.ix[k], w.iy[k]);
  Real* q = to.q + 4L * first;
#pragma GCC unroll 3
  for (int j = 0; j < N; ++j, q += 4L * to.stride) {
    Quad<Real> row = w.sy[j][k] * A;
    if constexpr (Gradient) {
      row += w.gy[j][k] * C;
      const Quad<Real> across = w.sy[j][k] * B;
#pragma GCC unroll 3
      for (int i = 0; i < N; ++i)
        quad_at<Real>(q + 4 * i) += w.sx[i][k] * row + w.gx[i][k] * across;
    } else {
#pragma GCC unroll 3
      for (int i = 0; i < N; ++i)
        quad_at<Real>(q + 4 * i) += w.sx[i][k] * row;
    }
    if constexpr (Mass)
      add_row(to.mass + first + static_cast<long>(j) * to.stride, mass * w.sy[j][k], w, k);
  }
}

/// Number of the lowest bit of a word that is not 0.
RIVEN_INLINE int lowest_bit(std::uint32_t word) {
#if defined(__CUDA_ARCH__)
  return __ffs(static_cast<int>(word)) - 1;
#else
  return __builtin_ctz(word);
#endif
}

/// f(n, slot) for each of a particle's nodes that it sees across cracks.
template <class Real, class Shape, class F>
RIVEN_INLINE void each_crossing(const Block<Real, Shape>& w, int k, std::uint32_t word, const ExtraSlots<Real>& extra,
                                const F& f) {
  constexpr int N = Shape::width;
  const int first = w.iy[k] * extra.nx + w.ix[k];
  while (word != 0) {
    const int n = lowest_bit(word) / field_bits;
    f(n, extra.slot(first + n / N * extra.nx + n % N, field_of(word, n)));
    word &= ~(3u << (field_bits * n));
  }
}

/// The same as `scatter` for a particle that sees some nodes across cracks: those go to the extra slots of `grid_mass`,
/// `grid_q`.
template <bool Mass, bool Gradient, class Real, class Shape>
RIVEN_OUTLINE void scatter_fields(const Block<Real, Shape>& w, int k, Real mass, const Quad<Real>& A,
                                  const Quad<Real>& B, const Quad<Real>& C, const NodeTarget<Real>& to,
                                  std::uint32_t word, const ExtraSlots<Real>& extra, Real* grid_mass, Real* grid_q) {
  constexpr int N = Shape::width;
  Real *q[N * N], *m[N * N];
  const int first = to.at(w.ix[k], w.iy[k]);
#pragma GCC unroll 9
  for (int n = 0; n < N * N; ++n) {
    const long slot = first + n / N * long{to.stride} + n % N;
    q[n] = to.q + 4 * slot;
    m[n] = to.mass + slot;
  }
  Quad<Real> apart[N * N];  // where other tiles may write to the slots, too
  Real apart_mass[N * N];
  each_crossing(w, k, word, extra, [&](int n, int slot) {
    q[n] = extra.atomic ? reinterpret_cast<Real*>(&(apart[n] = Quad<Real>{})) : grid_q + 4L * slot;
    m[n] = extra.atomic ? &(apart_mass[n] = Real(0)) : grid_mass + slot;
  });
#pragma GCC unroll 3
  for (int j = 0; j < N; ++j) {
    Quad<Real> row = w.sy[j][k] * A;
    Quad<Real> across{};
    if constexpr (Gradient) {
      row += w.gy[j][k] * C;
      across = w.sy[j][k] * B;
    }
#pragma GCC unroll 3
    for (int i = 0; i < N; ++i) {
      if constexpr (Gradient)
        quad_at<Real>(q[j * N + i]) += w.sx[i][k] * row + w.gx[i][k] * across;
      else
        quad_at<Real>(q[j * N + i]) += w.sx[i][k] * row;
      if constexpr (Mass)
        *m[j * N + i] += mass * w.sx[i][k] * w.sy[j][k];
    }
  }
  if (extra.atomic)
    each_crossing(w, k, word, extra, [&](int n, int slot) {
      for (int c = 0; c < 4; ++c)
        exec::atomic_add(grid_q[4L * slot + c], apart[n][c]);
      if constexpr (Mass)
        exec::atomic_add(grid_mass[slot], apart_mass[n]);
    });
}

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
RIVEN_OUTLINE Gathered<Real> gather_fields(const Block<Real, Shape>& w, int k, const Real* q, std::uint32_t word,
                                           const ExtraSlots<Real>& extra) {
  constexpr int N = Shape::width;
  const Real* from[N * N];
  const Real* first = q + 4L * (static_cast<long>(w.iy[k]) * extra.nx + w.ix[k]);
#pragma GCC unroll 9
  for (int n = 0; n < N * N; ++n)
    from[n] = first + 4L * (n / N * long{extra.nx} + n % N);
  each_crossing(w, k, word, extra, [&](int n, int slot) { from[n] = q + 4L * slot; });
  Gathered<Real> out{};
#pragma GCC unroll 3
  for (int j = 0; j < N; ++j) {
    Quad<Real> s{}, d{};
#pragma GCC unroll 3
    for (int i = 0; i < N; ++i) {
      const Quad<Real>& n = quad_at<Real>(from[j * N + i]);
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

}  // namespace riven
