// A block of particles: the weights of up to exec::lanes particles, computed together, and the moves of groups of
// four node values between one of them and its nodes.
//
// Shape functions are recomputed in every pass: storing 27 numbers per particle costs more than it saves.
#pragma once
#include <type_traits>

#include "core/exec/atomic.hpp"
#include "core/math/quad.hpp"
#include "core/math/shape.hpp"
#include "core/state/bodies.hpp"
#include "core/state/grid.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// Particles' positions and how to turn them into weights.
template <class Real>
struct Positions {
  const double* x;
  const double* y;
  double origin_x, origin_y, inv_h;
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
    const double* x = p.x + first;
    const double* y = p.y + first;
    const Real inv_h = Real(p.inv_h);
    exec::for_lanes(lanes, [&](int k) RIVEN_LANE {
      const DomainSetting<Real, 2>& d = domain_of(first + k);
      const Axis<Real, N> a = Shape::axis((x[k] - p.origin_x) * p.inv_h, d.axis[0]);
      const Axis<Real, N> b = Shape::axis((y[k] - p.origin_y) * p.inv_h, d.axis[1]);
      for (int i = 0; i < N; ++i) {
        sx[i][k] = a.s[i];
        sy[i][k] = b.s[i];
        gx[i][k] = a.g[i] * inv_h;
        gy[i][k] = b.g[i] * inv_h;
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

/// How particles that see nodes across cracks find their slots. Without cracks `tile_marked` is null.
struct CrossingSlots {
  const int* tile_marked = nullptr;         ///< CrackFields::tile_marked
  const std::uint16_t* crossing = nullptr;  ///< CrackFields::crossing
  const int* block_slots = nullptr;         ///< CrackFields::block_slots
  const int* slots = nullptr;               ///< CrackFields::slots
  int nodes = 0;                            ///< slots from here on lie behind the plain grid
  bool atomic = false;                      ///< those may be written by several tiles or threads at once
};

/// Whether several threads may add to the sums of one tile.
#if defined(RIVEN_ON_DEVICE)
inline constexpr bool in_team = true;
#else
inline constexpr bool in_team = false;
#endif

/// Adds to a group of four values of a tile's sums.
template <class Real>
RIVEN_INLINE void add_quad(Real* target, const Quad<Real>& value) {
  if constexpr (in_team) {
    for (int c = 0; c < 4; ++c)
      exec::atomic_add(target[c], value[c]);
  } else {
    quad_at<Real>(target) += value;
  }
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
#if !defined(RIVEN_ON_DEVICE)
  if constexpr (Shape::width == 3) {
    typedef Real Unaligned __attribute__((vector_size(4 * sizeof(Real)), aligned(sizeof(Real))));
    *reinterpret_cast<Unaligned*>(m) += ms * Unaligned{w.sx[0][k], w.sx[1][k], w.sx[2][k], Real(0)};
    return;
  }
#endif
  for (int i = 0; i < Shape::width; ++i)
    add(m[i], ms * w.sx[i][k], in_team);
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
        add_quad<Real>(q + 4 * i, w.sx[i][k] * row + w.gx[i][k] * across);
    } else {
#pragma GCC unroll 3
      for (int i = 0; i < N; ++i)
        add_quad<Real>(q + 4 * i, w.sx[i][k] * row);
    }
    if constexpr (Mass)
      add_row(to.mass + first + static_cast<long>(j) * to.stride, mass * w.sy[j][k], w, k);
  }
}

/// put(n, part, mass) for each node of particle k, with what `scatter` adds to it.
template <bool Mass, bool Gradient, class Real, class Shape, class Put>
RIVEN_INLINE void each_part(const Block<Real, Shape>& w, int k, Real mass, const Quad<Real>& A, const Quad<Real>& B,
                            const Quad<Real>& C, const Put& put) {
  constexpr int N = Shape::width;
#pragma GCC unroll 3
  for (int j = 0; j < N; ++j) {
    Quad<Real> row = w.sy[j][k] * A, across{};
    if constexpr (Gradient) {
      row += w.gy[j][k] * C;
      across = w.sy[j][k] * B;
    }
    const Real m = mass * w.sy[j][k];
#pragma GCC unroll 3
    for (int i = 0; i < N; ++i)
      if constexpr (Gradient)
        put(j * N + i, w.sx[i][k] * row + w.gx[i][k] * across, m * w.sx[i][k]);
      else
        put(j * N + i, w.sx[i][k] * row, m * w.sx[i][k]);
  }
}

/// The same as `scatter` into a tile's own buffer for a particle that sees some nodes across cracks: those are slots of
/// the grid.
template <bool Mass, bool Gradient, class Real, class Shape>
RIVEN_OUTLINE void scatter_apart(const Block<Real, Shape>& w, int k, Real mass, const Quad<Real>& A,
                                 const Quad<Real>& B, const Quad<Real>& C, const NodeTarget<Real>& to, const int* slots,
                                 const CrossingSlots& extra, Real* grid_mass, Real* grid_q) {
  const int first = to.at(w.ix[k], w.iy[k]);
  each_part<Mass, Gradient>(w, k, mass, A, B, C, [&](int n, const Quad<Real>& part, Real m) {
    const int slot = slots[n];
    if (slot < extra.nodes) {
      const long at = first + n / Shape::width * to.stride + n % Shape::width;
      add_quad<Real>(to.q + 4 * at, part);
      if constexpr (Mass)
        add(to.mass[at], m, in_team);
      return;
    }
    for (int c = 0; c < 4; ++c)
      add(grid_q[4L * slot + c], part[c], extra.atomic);
    if constexpr (Mass)
      add(grid_mass[slot], m, extra.atomic);
  });
}

/// The same as `scatter` for a particle that sees some nodes across cracks.
template <bool Mass, bool Gradient, class Real, class Shape>
RIVEN_INLINE void scatter_slots(const Block<Real, Shape>& w, int k, Real mass, const Quad<Real>& A, const Quad<Real>& B,
                                const Quad<Real>& C, const NodeTarget<Real>& to, const int* slots,
                                const CrossingSlots& extra, Real* grid_mass, Real* grid_q) {
  if (to.q != grid_q)
    return scatter_apart<Mass, Gradient>(w, k, mass, A, B, C, to, slots, extra, grid_mass, grid_q);
  each_part<Mass, Gradient>(w, k, mass, A, B, C, [&](int n, const Quad<Real>& part, Real m) RIVEN_LANE {
    quad_at<Real>(grid_q + 4L * slots[n]) += part;
    if constexpr (Mass)
      grid_mass[slots[n]] += m;
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
