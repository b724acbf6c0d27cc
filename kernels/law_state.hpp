// One particle's state as its law sees it, outside of the vectorised passes.
#pragma once
#include "kernels/views.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

template <class Law, class Real>
RIVEN_INLINE LawState<Real> law_state(const ParticleReads<Real>& p, long i) {
  LawState<Real> s{};
  s.xx = p.sxx[i];
  s.yy = p.syy[i];
  s.xy = p.sxy[i];
  if constexpr (Law::keeps_F) {
    s.F = {p.Fxx[i], p.Fxy[i], p.Fyx[i], p.Fyy[i]};
    s.J = det(s.F);
  } else {
    s.J = p.J[i];
  }
  return s;
}

}  // namespace RIVEN_SIDE

}  // namespace riven
