// One particle's state as its law sees it, outside of the vectorised passes.
#pragma once
#include "kernels/views.hpp"

namespace riven {

template <class Law, class Real>
LawState<Real> law_state(const Particles<Real, 2>& p, long i) {
  LawState<Real> s{};
  s.xx = p.stress[0][i];
  s.yy = p.stress[1][i];
  s.xy = p.stress[2][i];
  if constexpr (Law::keeps_F) {
    s.F = {p.F[0][i], p.F[1][i], p.F[2][i], p.F[3][i]};
    s.J = det(s.F);
  } else {
    s.J = p.J[i];
  }
  return s;
}

}  // namespace riven
