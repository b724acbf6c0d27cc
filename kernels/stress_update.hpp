// Takes the stresses of a block of particles through one strain increment (Nairn 2003, eqs. 34-36), then the law:
//   A = dt grad v_p,   grad v_p = sum v_ij (x) G_ip,
//   USL, MUSL, USF   dF = exp(A)
//   USAVG            dF = exp(A M / 2) before and after the momentum update,   M = (I + A/2)^-1 of each.
// In USAVG M takes gradients from the positions at the start of the step to those in its middle. Two halves, A_1 before
// and A_2 after, then make up I + (A_1 + A_2) / 2, which is how the particles move, to terms in A_2 - A_1; and they
// take from the stresses P = tau M^T just the work that these do on the grid. Without M the body that F describes
// shrinks against the one that moves by |A|^2 / 2 in every step: a disk would grow by 2 % in a turn of 1,000 steps, and
// gain as much angular momentum.
#pragma once
#include "kernels/gather.hpp"
#include "kernels/views.hpp"
#include "kernels/watch.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// Velocity gradient of each lane.
template <class Real>
struct GradientLanes {
  alignas(64) Real xx[exec::lanes], xy[exec::lanes], yx[exec::lanes], yy[exec::lanes];

  /// Of one particle, or of four that follow each other.
  template <class From>
  RIVEN_INLINE void set(int k, const From& g) {
    put<Real>(xx + k, g.dx[0]);
    put<Real>(xy + k, g.dy[0]);
    put<Real>(yx + k, g.dx[1]);
    put<Real>(yy + k, g.dy[1]);
  }
  RIVEN_INLINE Mat2<Real> over(int k, Real dt) const { return {dt * xx[k], dt * xy[k], dt * yx[k], dt * yy[k]}; }
};

/// M of each lane (USAVG).
template <class Real>
RIVEN_INLINE Mat2<Real> middle(const GradientLanes<Real>& g, int k, Real dt) {
  return inverse_of_one_plus(g.over(k, Real(0.5) * dt));
}

namespace detail {

/// dF - I of a lane.
template <bool Averaged, class Real>
RIVEN_INLINE Mat2<Real> increment(const GradientLanes<Real>& g, int k, Real dt) {
  if constexpr (Averaged)
    return exp_of_middle_minus_identity(g.over(k, Real(0.5) * dt));
  else
    return exp_minus_identity(g.over(k, dt));
}

template <bool Averaged, class Law, class Real, class LawOf>
RIVEN_INLINE void update_stress_each(const ParticleView<Real>& p, long first, int count, const GradientLanes<Real>& g,
                                     Real dt, const LawOf& law_of, TileWatch<Real>& seen) {
  alignas(64) Real xx[exec::lanes], xy[exec::lanes], yx[exec::lanes], yy[exec::lanes];
  exec::for_lanes(count, [&](int k) RIVEN_LANE {
    const Mat2<Real> dF = increment<Averaged>(g, k, dt);
    xx[k] = dF.xx;
    xy[k] = dF.xy;
    yx[k] = dF.yx;
    yy[k] = dF.yy;
  });
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
    law_of(i).update(Mat2<Real>{xx[k], xy[k], yx[k], yy[k]}, s);
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
    seen.det_F(k, Real(s.J));
  });
}

/// Of bodies with several laws. Apart, as it would make each of the kernels half as long again to compile.
template <bool Averaged, class Law, class Real>
RIVEN_OUTLINE void update_stress_by_body(const ParticleView<Real>& p, long first, int count,
                                         const GradientLanes<Real>& g, Real dt, const BodyLookup<Law>& laws,
                                         TileWatch<Real>& seen) {
  update_stress_each<Averaged, Law>(
      p, first, count, g, dt, [&](long i) -> const Law& { return laws.of(i); }, seen);
}

}  // namespace detail

/// Updates particles first .. first + count - 1.
template <bool Averaged, class Law, class Real>
RIVEN_INLINE void update_stress_lanes(const ParticleView<Real>& p, long first, int count, const GradientLanes<Real>& g,
                                      Real dt, const BodyLookup<Law>& laws, TileWatch<Real>& seen) {
  if (laws.single) {
    const Law law = laws.table[0];
    detail::update_stress_each<Averaged, Law>(
        p, first, count, g, dt, [&](long) -> const Law& { return law; }, seen);
  } else {
    detail::update_stress_by_body<Averaged>(p, first, count, g, dt, laws, seen);
  }
}

}  // namespace RIVEN_SIDE

}  // namespace riven
