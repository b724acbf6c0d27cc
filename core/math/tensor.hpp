// Two-by-two tensors as four numbers [11 12 21 22]; written without branches so that loops over particles vectorise.
#pragma once
#include <cmath>
#include <type_traits>

#include "core/exec/config.hpp"

namespace riven {

template <class Real>
struct Mat2 {
  Real xx, xy, yx, yy;
};

template <class A, class B>
RIVEN_INLINE Mat2<std::common_type_t<A, B>> operator*(const Mat2<A>& a, const Mat2<B>& b) {
  return {a.xx * b.xx + a.xy * b.yx, a.xx * b.xy + a.xy * b.yy, a.yx * b.xx + a.yy * b.yx, a.yx * b.xy + a.yy * b.yy};
}

template <class Real>
RIVEN_INLINE Mat2<Real> operator*(Real s, const Mat2<Real>& a) {
  return {s * a.xx, s * a.xy, s * a.yx, s * a.yy};
}

template <class Real>
RIVEN_INLINE Mat2<Real> transposed(const Mat2<Real>& a) {
  return {a.xx, a.yx, a.xy, a.yy};
}

template <class Real>
RIVEN_INLINE Mat2<Real> operator+(const Mat2<Real>& a, const Mat2<Real>& b) {
  return {a.xx + b.xx, a.xy + b.xy, a.yx + b.yx, a.yy + b.yy};
}

template <class Real>
RIVEN_INLINE Real det(const Mat2<Real>& a) {
  return a.xx * a.yy - a.xy * a.yx;
}

/// Largest principal stretch of a deformation gradient: its square is the larger eigenvalue of F^T F, whose trace is
/// F : F and whose determinant det(F)^2.
template <class Real>
RIVEN_INLINE Real principal_stretch(const Mat2<Real>& F) {
  const Real trace = F.xx * F.xx + F.xy * F.xy + F.yx * F.yx + F.yy * F.yy, J = det(F);
  const Real square = trace * trace - Real(4) * J * J;
  return std::sqrt(Real(0.5) * (trace + std::sqrt(square > 0 ? square : Real(0))));
}

/// exp(s I + D) - I for small ones, to fourth order, D without trace and D^2 = q I,
///   exp(s I + D) = e^s [ cosh(sqrt q) I + sinh(sqrt q)/sqrt q D ]      (Cayley-Hamilton)
/// of which D = `scale` times the matrix [dev xy; yx -dev].
/// Keeps det and rotations to O(|A|^5), where I + A stretches a rotating body by |A|^2 / 2 in every step. Without the
/// identity, whose last bit is some 1e-13 of the strain that a stiff solid bears, small strains keep all their digits.
template <class Real>
RIVEN_INLINE Mat2<Real> exp_minus_identity(Real s, Real q, Real scale, Real dev, Real xy, Real yx) {
  const Real e = s * (Real(1) + s * (Real(0.5) + s * (Real(1) / 6 + s * (Real(1) / 24))));  // e^s - 1
  const Real c = e + (Real(1) + e) * (q * (Real(0.5) + q * (Real(1) / 24)));
  const Real d = scale * (Real(1) + e) * (Real(1) + q * (Real(1) / 6 + q * (Real(1) / 120)));
  return {c + d * dev, d * xy, d * yx, c - d * dev};
}

/// exp(A) - I for a small A = dt grad v.
template <class Real>
RIVEN_INLINE Mat2<Real> exp_minus_identity(const Mat2<Real>& A) {
  const Real dev = Real(0.5) * (A.xx - A.yy);
  return exp_minus_identity(Real(0.5) * (A.xx + A.yy), dev * dev + A.xy * A.yx, Real(1), dev, A.xy, A.yx);
}

/// exp(A (I + A)^-1) - I for a small A:  A (I + A)^-1 = (A + det A I) / det(I + A)      (Cayley-Hamilton).
template <class Real>
RIVEN_INLINE Mat2<Real> exp_of_middle_minus_identity(const Mat2<Real>& A) {
  const Real half = Real(0.5) * (A.xx + A.yy), dev = Real(0.5) * (A.xx - A.yy), q = dev * dev + A.xy * A.yx;
  const Real det_A = half * half - q, scale = Real(1) / (Real(1) + Real(2) * half + det_A);
  return exp_minus_identity(scale * (half + det_A), scale * scale * q, scale, dev, A.xy, A.yx);
}

/// (I + A)^-1.
template <class Real>
RIVEN_INLINE Mat2<Real> inverse_of_one_plus(const Mat2<Real>& A) {
  const Real scale = Real(1) / (Real(1) + A.xx + A.yy + det(A));
  return {scale * (Real(1) + A.yy), -scale * A.xy, -scale * A.yx, scale * (Real(1) + A.xx)};
}

/// det(I + G) - 1.
template <class Real>
RIVEN_INLINE Real growth(const Mat2<Real>& G) {
  return G.xx + G.yy + det(G);
}

/// I + G = R U: cosine, sine, and cosine - 1 of the rotation R.
template <class Real>
struct Rotation {
  Real c, s, c_minus_1;
};
template <class Real>
RIVEN_INLINE Rotation<Real> polar_rotation(const Mat2<Real>& G) {
  const Real a = Real(2) + G.xx + G.yy, b = G.yx - G.xy, r = std::sqrt(a * a + b * b);
  const Real share = Real(1) / (r * (a + r)), inv = share * (a + r);  // 1 / r, by the same division
  return {a * inv, b * inv, -b * b * share};
}

}  // namespace riven
