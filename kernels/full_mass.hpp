// The full mass matrix of the nodes' plain fields,
//   M_ij = sum_p m_p S_ip S_jp,
// of which m_i = sum_j M_ij are the lumped masses. A pass over the particles that takes velocities from the grid and
// momenta back is a product with it (S^T M S in higher_orders.hpp); for several of them it is cheaper to build it. It
// is symmetric, and each node holds the entries of its row and of the two rows after it:
//   of (i, j) with (i-2 .. i+2, j), (i-2 .. i+2, j+1) and (i-2 .. i+2, j+2).
#pragma once
#include "core/math/quad.hpp"
#include "kernels/block.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// The matrix as a kernel sees it.
template <class Real>
struct FullMass {
  static constexpr int size = full_mass_entries;

  Real* entries;  ///< [nodes][size]
  int nx;

  /// Where the entry of the node `across` columns and `up` rows on stands.
  static RIVEN_INLINE constexpr int entry(int across, int up) { return 5 * up + 2 + across; }

  /// Adds a particle. Factors come in the same order for both nodes of a pair: the sums are symmetric to the bit. Three
  /// columns are taken as four, the last with nothing added.
  template <class Shape>
  RIVEN_INLINE void add(const Block<Real, Shape>& w, int k, Real mass) const {
    constexpr int N = Shape::width;
    const Quad<Real> columns{w.sx[0][k], w.sx[1][k], N > 2 ? w.sx[N - 1][k] : Real(0), Real(0)};
    Real* row = entries + long{size} * (static_cast<long>(w.iy[k]) * nx + w.ix[k]);
#pragma GCC unroll 3
    for (int j = 0; j < N; ++j, row += long{size} * nx)
#pragma GCC unroll 3
      for (int i = 0; i < N; ++i) {
        const Quad<Real> pairs = w.sx[i][k] * columns;
#pragma GCC unroll 3
        for (int up = 0; up + j < N; ++up)
          add_group(row + size * i + entry(-i, up), mass * (w.sy[j][k] * w.sy[j + up][k]) * pairs);
      }
  }

  /// sum_j M_nj v_j for groups of four node values; `n` lies two rows and columns inside of the lattice.
  RIVEN_INLINE Quad<Real> times(const Real* v, long n) const {
    const auto value = [&](long at) -> const Quad<Real>& { return quad_at<Real>(v + 4 * at); };
    const Real* own = entries + size * n;
    Quad<Real> after{}, before{};  // apart, as sums wait for each other
#pragma GCC unroll 5
    for (int across = -2; across <= 2; ++across)
      after += own[entry(across, 0)] * value(n + across);
#pragma GCC unroll 3
    for (int up = 1; up <= 2; ++up)
#pragma GCC unroll 5
      for (int across = -2; across <= 2; ++across) {
        const long there = static_cast<long>(up) * nx + across;
        after += own[entry(across, up)] * value(n + there);
        before += own[entry(across, up) - size * there] * value(n - there);
      }
    return after + before;
  }

 private:
  static RIVEN_INLINE void add_group(Real* to, const Quad<Real>& value) {
#if !defined(RIVEN_ON_DEVICE)
    typedef Real Unaligned __attribute__((vector_size(4 * sizeof(Real)), aligned(sizeof(Real))));
    *reinterpret_cast<Unaligned*>(to) += value;
#else
    for (int c = 0; c < 4; ++c)
      riven::add(to[c], value[c], in_team);
#endif
  }
};

}  // namespace RIVEN_SIDE

}  // namespace riven
