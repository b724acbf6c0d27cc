// Takes the stresses of a block of particles through one strain increment (seed 002, eqs. 34-36):
//   grad v_p = sum v_ij (x) G_ip,   dF = exp(dt* grad v_p),   then the law.
#pragma once
#include "kernels/views.hpp"
#include "kernels/watch.hpp"

namespace riven {

/// Velocity gradient of each lane.
template <class Real>
struct GradientLanes {
  alignas(64) Real xx[exec::lanes], xy[exec::lanes], yx[exec::lanes], yy[exec::lanes];

  RIVEN_INLINE void set(int k, const Gathered<Real>& g) {
    xx[k] = g.dx[0];
    xy[k] = g.dy[0];
    yx[k] = g.dx[1];
    yy[k] = g.dy[1];
  }
};

namespace detail {

template <class Law, class Real, class LawOf>
RIVEN_INLINE void update_stress_each(const ParticleView<Real>& p, long first, int count, const GradientLanes<Real>& g,
                                     Real dt, const LawOf& law_of, TileWatch<Real>& seen) {
  exec::for_lanes(count, [&](int k) RIVEN_LANE {
    const long i = first + k;
    LawState<Real> s;
    s.xx = p.sxx[i];
    s.yy = p.syy[i];
    s.xy = p.sxy[i];
    if constexpr (Law::keeps_F)
      s.F = {p.Fxx[i], p.Fxy[i], p.Fyx[i], p.Fyy[i]};
    else
      s.J = p.J[i];
    law_of(i).update(exp_minus_identity(Mat2<Real>{dt * g.xx[k], dt * g.xy[k], dt * g.yx[k], dt * g.yy[k]}), s);
    p.sxx[i] = s.xx;
    p.syy[i] = s.yy;
    p.sxy[i] = s.xy;
    if constexpr (Law::keeps_F) {
      p.Fxx[i] = s.F.xx;
      p.Fxy[i] = s.F.xy;
      p.Fyx[i] = s.F.yx;
      p.Fyy[i] = s.F.yy;
    } else {
      p.J[i] = s.J;
    }
    seen.det_F(k, s.J);
  });
}

}  // namespace detail

/// Updates particles first .. first + count - 1.
template <class Law, class Real>
RIVEN_INLINE void update_stress_lanes(const ParticleView<Real>& p, long first, int count, const GradientLanes<Real>& g,
                                      Real dt, const BodyLookup<Law>& laws, TileWatch<Real>& seen) {
  if (laws.single) {
    const Law law = laws.table[0];
    detail::update_stress_each<Law>(
        p, first, count, g, dt, [&](long) -> const Law& { return law; }, seen);
  } else {
    detail::update_stress_each<Law>(
        p, first, count, g, dt, [&](long i) -> const Law& { return laws.of(i); }, seen);
  }
}

}  // namespace riven
