// A group of four node values taken together: one vector register on the CPU.
#pragma once
#include "core/exec/config.hpp"

namespace riven {

#if defined(__CUDACC__)
template <class Real>
struct QuadStruct {
  Real c[4];
  RIVEN_FN Real& operator[](int i) { return c[i]; }
  RIVEN_FN Real operator[](int i) const { return c[i]; }
  friend RIVEN_FN QuadStruct operator+(QuadStruct a, const QuadStruct& b) { return a += b; }
  RIVEN_FN QuadStruct& operator+=(const QuadStruct& b) {
    for (int i = 0; i < 4; ++i)
      c[i] += b.c[i];
    return *this;
  }
  friend RIVEN_FN QuadStruct operator*(Real s, QuadStruct a) {
    for (int i = 0; i < 4; ++i)
      a.c[i] *= s;
    return a;
  }
  friend RIVEN_FN QuadStruct operator*(QuadStruct a, const QuadStruct& b) {
    for (int i = 0; i < 4; ++i)
      a.c[i] *= b.c[i];
    return a;
  }
};
template <class Real>
using Quad = QuadStruct<Real>;
#else
template <class Real>
struct QuadOf {
  typedef Real type __attribute__((vector_size(4 * sizeof(Real))));
};
template <class Real>
using Quad = typename QuadOf<Real>::type;
#endif

/// Four values at p, which is aligned to their size.
template <class Real>
RIVEN_INLINE Quad<Real>& quad_at(Real* p) {
  return *reinterpret_cast<Quad<Real>*>(p);
}
template <class Real>
RIVEN_INLINE const Quad<Real>& quad_at(const Real* p) {
  return *reinterpret_cast<const Quad<Real>*>(p);
}

/// Four values at p, wherever it is.
template <class Real>
RIVEN_INLINE Quad<Real> four_at(const Real* p) {
#if defined(__CUDACC__)
  return {p[0], p[1], p[2], p[3]};
#else
  typedef Real Unaligned __attribute__((vector_size(4 * sizeof(Real)), aligned(sizeof(Real)), may_alias));
  return *reinterpret_cast<const Unaligned*>(p);
#endif
}
template <class Real>
RIVEN_INLINE void put_four(Real* p, const Quad<Real>& values) {
#if defined(__CUDACC__)
  for (int i = 0; i < 4; ++i)
    p[i] = values[i];
#else
  typedef Real Unaligned __attribute__((vector_size(4 * sizeof(Real)), aligned(sizeof(Real)), may_alias));
  *reinterpret_cast<Unaligned*>(p) = values;
#endif
}

}  // namespace riven
