// The full mass matrix of the nodes' plain fields,
//   M_ij = sum_p m_p S_ip S_jp,
// of which m_i = sum_j M_ij are the lumped masses. A pass over the particles that takes velocities from the grid and
// momenta back is a product with it (S^T M S in higher_orders.hpp); for several of them it is cheaper to build it. It
// is symmetric, and each node holds the entries of its row and of the two rows after it:
//   of (i, j) with (i-2 .. i+2, j), (i-2 .. i+2, j+1) and (i-2 .. i+2, j+2).
#pragma once
#include "core/math/quad.hpp"
#include "kernels/scatter.hpp"

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

  /// Adds `Count` particles that have the same nodes, from lane k on. Factors come in the same order for both nodes of
  /// a pair: the sums are symmetric to the bit. Three columns are taken as four, the last with nothing added.
  template <int Count, class Shape>
  RIVEN_INLINE void add(const Block<Real, Shape>& w, int k, const Real* mass) const {
    constexpr int N = Shape::width;
    Real rows[N][N][Count];
#pragma GCC unroll 3
    for (int j = 0; j < N; ++j)
#pragma GCC unroll 3
      for (int up = 0; up + j < N; ++up)
        for (int p = 0; p < Count; ++p)
          rows[j][up][p] = mass[p] * (w.sy[j][k + p] * w.sy[j + up][k + p]);
    Real* const corner = entries + long{size} * (static_cast<long>(w.iy[k]) * nx + w.ix[k]);
#pragma GCC unroll 3
    for (int i = 0; i < N; ++i) {
      Quad<Real> pairs[Count];
#pragma GCC unroll 4
      for (int p = 0; p < Count; ++p)
        pairs[p] = w.sx[i][k + p] * w.columns(k + p);
#pragma GCC unroll 3
      for (int j = 0; j < N; ++j)
#pragma GCC unroll 3
        for (int up = 0; up + j < N; ++up) {
          Quad<Real> sum = rows[j][up][0] * pairs[0];
#pragma GCC unroll 3
          for (int p = 1; p < Count; ++p)
            sum += rows[j][up][p] * pairs[p];
          add_group(corner + long{size} * (long{j} * nx + i) + entry(-i, up), sum);
        }
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
