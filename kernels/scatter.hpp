// Adds what particles of a block give to their nodes, in groups of four node values.
#pragma once
#include "core/exec/atomic.hpp"
#include "kernels/block.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

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

/// Adds to two values of a tile's sums: the sum of a's numbers, and that of b's.
template <class Real>
RIVEN_INLINE void add_sums(Real* p, const Quad<Real>& a, const Quad<Real>& b) {
#if defined(RIVEN_ON_DEVICE)
  add(p[0], a[0] + a[1] + a[2] + a[3], in_team);
  add(p[1], b[0] + b[1] + b[2] + b[3], in_team);
#else
  typedef Real Two __attribute__((vector_size(2 * sizeof(Real)), may_alias));
  const Quad<Real> halves = __builtin_shufflevector(a, b, 0, 4, 2, 6) + __builtin_shufflevector(a, b, 1, 5, 3, 7);
  *reinterpret_cast<Two*>(p) +=
      __builtin_shufflevector(halves, halves, 0, 1) + __builtin_shufflevector(halves, halves, 2, 3);
#endif
}

/// Adds to N nodes of a row. Three nodes are taken as four, the last with nothing added: it belongs to the tile's reach
/// or to the padding.
template <int N, class Real>
RIVEN_INLINE void add_row(Real* m, const Quad<Real>& row) {
#if !defined(RIVEN_ON_DEVICE)
  if constexpr (N == 3) {
    typedef Real Unaligned __attribute__((vector_size(4 * sizeof(Real)), aligned(sizeof(Real))));
    *reinterpret_cast<Unaligned*>(m) += row;
    return;
  }
#endif
  for (int i = 0; i < N; ++i)
    add(m[i], row[i], in_team);
}

/// Adds to each node of particle k:  mass S  and  S A + dS/dx B + dS/dy C; with other second weights by these.
template <bool Mass, bool Gradient, Second Of = Second::gradients, class Real, class Shape>
RIVEN_INLINE void scatter(const Block<Real, Shape>& w, int k, Real mass, const Quad<Real>& A, const Quad<Real>& B,
                          const Quad<Real>& C, const NodeTarget<Real>& to) {
  constexpr int N = Shape::width;
  const int first = to.at(w.ix[k], w.iy[k]);
  Real* q = to.q + 4L * first;
#pragma GCC unroll 3
  for (int j = 0; j < N; ++j, q += 4L * to.stride) {
    Quad<Real> row = w.sy[j][k] * A;
    if constexpr (Gradient) {
      row += w.template second_y<Of>(j, k) * C;
      const Quad<Real> across = w.sy[j][k] * B;
#pragma GCC unroll 3
      for (int i = 0; i < N; ++i)
        add_quad<Real>(q + 4 * i, w.sx[i][k] * row + w.template second_x<Of>(i, k) * across);
    } else {
#pragma GCC unroll 3
      for (int i = 0; i < N; ++i)
        add_quad<Real>(q + 4 * i, w.sx[i][k] * row);
    }
    if constexpr (Mass)
      add_row<N>(to.mass + first + static_cast<long>(j) * to.stride, (mass * w.sy[j][k]) * w.columns(k));
  }
}

/// Adds S A to each node of lanes k .. k + 3, which have the same nodes: sums of the four stay in registers, and nodes
/// are read and written once. (With gradients of four node values it is no faster: there the multiply-adds count.)
template <class Real, class Shape>
RIVEN_INLINE void scatter_four(const Block<Real, Shape>& w, int k, const Quad<Real> (&A)[4],
                               const NodeTarget<Real>& to) {
  constexpr int N = Shape::width;
  const int first = to.at(w.ix[k], w.iy[k]);
  Real* q = to.q + 4L * first;
#pragma GCC unroll 3
  for (int j = 0; j < N; ++j, q += 4L * to.stride) {
    Quad<Real> row[4];
#pragma GCC unroll 4
    for (int p = 0; p < 4; ++p)
      row[p] = w.sy[j][k + p] * A[p];
#pragma GCC unroll 3
    for (int i = 0; i < N; ++i) {
      Quad<Real> sum = w.sx[i][k] * row[0];
#pragma GCC unroll 3
      for (int p = 1; p < 4; ++p)
        sum += w.sx[i][k + p] * row[p];
      add_quad<Real>(q + 4 * i, sum);
    }
  }
}

/// The same with moments: adds  S A + S (x - x_p) B + S (y - y_p) C.
template <class Real, class Shape>
RIVEN_INLINE void scatter_moments_of_four(const Block<Real, Shape>& w, int k, const Quad<Real> (&A)[4],
                                          const Quad<Real> (&B)[4], const Quad<Real> (&C)[4],
                                          const NodeTarget<Real>& to) {
  constexpr int N = Shape::width;
  const int first = to.at(w.ix[k], w.iy[k]);
  Real* q = to.q + 4L * first;
#pragma GCC unroll 3
  for (int j = 0; j < N; ++j, q += 4L * to.stride) {
    Quad<Real> row[4], across[4];
#pragma GCC unroll 4
    for (int p = 0; p < 4; ++p) {
      row[p] = w.sy[j][k + p] * A[p] + w.my[j][k + p] * C[p];
      across[p] = w.sy[j][k + p] * B[p];
    }
#pragma GCC unroll 3
    for (int i = 0; i < N; ++i) {
      Quad<Real> sum = w.sx[i][k] * row[0] + w.mx[i][k] * across[0];
#pragma GCC unroll 3
      for (int p = 1; p < 4; ++p)
        sum += w.sx[i][k + p] * row[p] + w.mx[i][k + p] * across[p];
      add_quad<Real>(q + 4 * i, sum);
    }
  }
}

/// Adds to the last two values of each node of lanes k .. k + 3, which have the same nodes,  S f + dS/dx X + dS/dy Y.
/// A vector holds one number of all four; `f`, `X` and `Y` are those of the two values.
template <class Real, class Shape>
RIVEN_INLINE void scatter_forces_of_four(const Block<Real, Shape>& w, int k, const Quad<Real> (&f)[2],
                                         const Quad<Real> (&X)[2], const Quad<Real> (&Y)[2],
                                         const NodeTarget<Real>& to) {
  constexpr int N = Shape::width;
  Real* q = to.q + 4L * to.at(w.ix[k], w.iy[k]) + 2;
#pragma GCC unroll 3
  for (int j = 0; j < N; ++j, q += 4L * to.stride) {
    const Quad<Real> sy = four_at(w.sy[j] + k), gy = four_at(w.gy[j] + k);
    const Quad<Real> row[2] = {sy * f[0] + gy * Y[0], sy * f[1] + gy * Y[1]}, across[2] = {sy * X[0], sy * X[1]};
#pragma GCC unroll 3
    for (int i = 0; i < N; ++i) {
      const Quad<Real> sx = four_at(w.sx[i] + k), gx = four_at(w.gx[i] + k);
      add_sums(q + 4 * i, sx * row[0] + gx * across[0], sx * row[1] + gx * across[1]);
    }
  }
}

/// put(n, part, mass) for each node of particle k, with what `scatter` adds to it.
template <bool Mass, bool Gradient, Second Of, class Real, class Shape, class Put>
RIVEN_INLINE void each_part(const Block<Real, Shape>& w, int k, Real mass, const Quad<Real>& A, const Quad<Real>& B,
                            const Quad<Real>& C, const Put& put) {
  constexpr int N = Shape::width;
#pragma GCC unroll 3
  for (int j = 0; j < N; ++j) {
    Quad<Real> row = w.sy[j][k] * A, across{};
    if constexpr (Gradient) {
      row += w.template second_y<Of>(j, k) * C;
      across = w.sy[j][k] * B;
    }
    const Real m = mass * w.sy[j][k];
#pragma GCC unroll 3
    for (int i = 0; i < N; ++i)
      if constexpr (Gradient)
        put(j * N + i, w.sx[i][k] * row + w.template second_x<Of>(i, k) * across, m * w.sx[i][k]);
      else
        put(j * N + i, w.sx[i][k] * row, m * w.sx[i][k]);
  }
}

/// The same as `scatter` into a tile's own buffer for a particle that sees some nodes across cracks: those are slots of
/// the grid.
template <bool Mass, bool Gradient, Second Of = Second::gradients, class Real, class Shape>
RIVEN_OUTLINE void scatter_apart(const Block<Real, Shape>& w, int k, Real mass, const Quad<Real>& A,
                                 const Quad<Real>& B, const Quad<Real>& C, const NodeTarget<Real>& to, const int* slots,
                                 const CrossingSlots& extra, Real* grid_mass, Real* grid_q) {
  const int first = to.at(w.ix[k], w.iy[k]);
  each_part<Mass, Gradient, Of>(w, k, mass, A, B, C, [&](int n, const Quad<Real>& part, Real m) {
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
template <bool Mass, bool Gradient, Second Of = Second::gradients, class Real, class Shape>
RIVEN_INLINE void scatter_slots(const Block<Real, Shape>& w, int k, Real mass, const Quad<Real>& A, const Quad<Real>& B,
                                const Quad<Real>& C, const NodeTarget<Real>& to, const int* slots,
                                const CrossingSlots& extra, Real* grid_mass, Real* grid_q) {
  if (to.q != grid_q)
    return scatter_apart<Mass, Gradient, Of>(w, k, mass, A, B, C, to, slots, extra, grid_mass, grid_q);
  each_part<Mass, Gradient, Of>(w, k, mass, A, B, C, [&](int n, const Quad<Real>& part, Real m) RIVEN_LANE {
    quad_at<Real>(grid_q + 4L * slots[n]) += part;
    if constexpr (Mass)
      grid_mass[slots[n]] += m;
  });
}

}  // namespace RIVEN_SIDE

}  // namespace riven
