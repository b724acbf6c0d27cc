// A block of particles: the weights of up to exec::lanes particles, computed together.
//
// Shape functions are recomputed in every pass: storing 27 numbers per particle costs more than it saves.
#pragma once
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

/// Which weights a kernel uses beside S: gradients dS/dx, 1/m; moments S (x_i - x_p), m; or moments for the first two
/// of a group of four node values, gradients for the last two.
enum class Second { gradients, moments, both };

/// In place of slots: a particle and the three behind it in its block have the same nodes, none of them across a crack.
struct FourTogether {};

/// 1/D, for D = sum S (x_i - x_p)^2 along an axis, m^-2. A particle whose weights lie on one node has no moments.
template <class Real>
RIVEN_INLINE Real inverse_of(Real D) {
  return D > Real(0) ? Real(1) / D : Real(0);
}

template <class Real, class Shape>
struct Block {
  static constexpr int N = Shape::width;
  static constexpr int lanes = exec::lanes;
  alignas(64) Real sx[N][lanes];
  alignas(64) Real sy[N][lanes];
  alignas(64) Real gx[N][lanes];  ///< d/dx, 1/m
  alignas(64) Real gy[N][lanes];
  alignas(64) Real mx[N][lanes];  ///< moments along x, m
  alignas(64) Real my[N][lanes];
  alignas(64) Real xx[lanes];  ///< sum S (x_i - x_p)^2, m^2
  alignas(64) Real yy[lanes];
  alignas(64) int ix[lanes];  ///< first node along x
  alignas(64) int iy[lanes];

  /// Weights of lane k along x, and zero behind them.
  RIVEN_INLINE Quad<Real> columns(int k) const {
    return Quad<Real>{sx[0][k], sx[1][k], N > 2 ? sx[N - 1][k] : Real(0), Real(0)};
  }

  /// Second weights of lane k at column i, of row j; a number, or one for each of four node values.
  template <Second Of>
  RIVEN_INLINE auto second_x(int i, int k) const {
    if constexpr (Of == Second::both)
      return Quad<Real>{mx[i][k], mx[i][k], gx[i][k], gx[i][k]};
    else if constexpr (Of == Second::moments)
      return mx[i][k];
    else
      return gx[i][k];
  }
  template <Second Of>
  RIVEN_INLINE auto second_y(int j, int k) const {
    if constexpr (Of == Second::both)
      return Quad<Real>{my[j][k], my[j][k], gy[j][k], gy[j][k]};
    else if constexpr (Of == Second::moments)
      return my[j][k];
    else
      return gy[j][k];
  }
  /// The same of lanes k .. k + 3.
  template <Second Of>
  RIVEN_INLINE Quad<Real> four_x(int i, int k) const {
    return four_at((Of == Second::moments ? mx[i] : gx[i]) + k);
  }
  template <Second Of>
  RIVEN_INLINE Quad<Real> four_y(int j, int k) const {
    return four_at((Of == Second::moments ? my[j] : gy[j]) + k);
  }

  /// Whether lanes k .. k + 3 have the same nodes.
  RIVEN_INLINE bool four_together(int k) const {
    int differ = 0;
    for (int p = 1; p < 4; ++p)
      differ |= (ix[k] ^ ix[k + p]) | (iy[k] ^ iy[k + p]);
    return differ == 0;
  }

  /// Weights of particles first .. first + lanes - 1. Lanes past the end of a tile hold other particles or padding,
  /// whose weights nobody uses; computing them keeps the loop whole. Gradients and moments only for those who ask for
  /// them.
  template <bool Gradient, bool Moments = false>
  RIVEN_INLINE void weigh(const Positions<Real>& p, long first) {
    if (p.domain.single) {
      const DomainSetting<Real, 2> d = p.domain.table[0];
      weigh_each<Gradient, Moments>(p, first, [&](long) -> const DomainSetting<Real, 2>& { return d; });
    } else {
      weigh_each<Gradient, Moments>(p, first, [&](long i) -> const DomainSetting<Real, 2>& { return p.domain.of(i); });
    }
  }

 private:
  template <bool Gradient, bool Moments, class DomainOf>
  RIVEN_INLINE void weigh_each(const Positions<Real>& p, long first, const DomainOf& domain_of) {
    const double* x = p.x + first;
    const double* y = p.y + first;
    const Real inv_h = Real(p.inv_h), h = Real(1 / p.inv_h);
    exec::for_lanes(lanes, [&](int k) RIVEN_LANE {
      const DomainSetting<Real, 2>& d = domain_of(first + k);
      const double from_left = (x[k] - p.origin_x) * p.inv_h, from_below = (y[k] - p.origin_y) * p.inv_h;
      const Axis<Real, N> a = Shape::axis(from_left, d.axis[0], inv_h);
      const Axis<Real, N> b = Shape::axis(from_below, d.axis[1], inv_h);
      for (int i = 0; i < N; ++i) {
        sx[i][k] = a.s[i];
        sy[i][k] = b.s[i];
        if constexpr (Gradient) {
          gx[i][k] = a.g[i];
          gy[i][k] = b.g[i];
        }
      }
      ix[k] = a.base;
      iy[k] = b.base;
      if constexpr (Moments) {
        const Real u = Real(a.base - from_left), v = Real(b.base - from_below);
        xx[k] = yy[k] = 0;
        for (int i = 0; i < N; ++i) {
          const Real dx = h * (u + Real(i)), dy = h * (v + Real(i));
          mx[i][k] = a.s[i] * dx;
          my[i][k] = b.s[i] * dy;
          xx[k] += mx[i][k] * dx;
          yy[k] += my[i][k] * dy;
        }
      }
    });
  }
};

}  // namespace RIVEN_SIDE

}  // namespace riven
