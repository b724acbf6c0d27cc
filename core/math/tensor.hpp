// Two-by-two tensors as four numbers [11 12 21 22]; written without branches so that loops over particles vectorise.
#pragma once
#include <cmath>

#include "core/exec/config.hpp"

namespace riven {

template <class Real>
struct Mat2 {
  Real xx, xy, yx, yy;
};

template <class Real>
RIVEN_INLINE Mat2<Real> operator*(const Mat2<Real>& a, const Mat2<Real>& b) {
  return {a.xx * b.xx + a.xy * b.yx, a.xx * b.xy + a.xy * b.yy, a.yx * b.xx + a.yy * b.yx, a.yx * b.xy + a.yy * b.yy};
}

template <class Real>
RIVEN_INLINE Real det(const Mat2<Real>& a) {
  return a.xx * a.yy - a.xy * a.yx;
}

/// exp(A) for a small A = dt grad v, to fourth order in |A|. With s = tr A / 2 and q = s^2 - det A,
///   exp(A) = e^s [ cosh(sqrt q) I + sinh(sqrt q)/sqrt q (A - s I) ]      (Cayley-Hamilton)
/// Keeps det and rotations to O(|A|^5), where I + A stretches a rotating body by |A|^2 / 2 in every step.
template <class Real>
RIVEN_INLINE Mat2<Real> exp_small(const Mat2<Real>& A) {
  const Real s = Real(0.5) * (A.xx + A.yy), q = s * s - det(A);
  const Real e = Real(1) + s * (Real(1) + s * (Real(0.5) + s * (Real(1) / 6 + s * (Real(1) / 24))));
  const Real c = e * (Real(1) + q * (Real(0.5) + q * (Real(1) / 24)));
  const Real d = e * (Real(1) + q * (Real(1) / 6 + q * (Real(1) / 120)));
  return {c + d * (A.xx - s), d * A.xy, d * A.yx, c + d * (A.yy - s)};
}

/// F = R U: cosine and sine of the rotation R.
template <class Real>
struct Rotation {
  Real c, s;
};
template <class Real>
RIVEN_INLINE Rotation<Real> polar_rotation(const Mat2<Real>& F) {
  const Real a = F.xx + F.yy, b = F.yx - F.xy, inv = Real(1) / std::sqrt(a * a + b * b);
  return {a * inv, b * inv};
}

}  // namespace riven
