// Particles that carry the gradient C of their velocity beside it (APIC: Jiang et al., ACM Trans. Graph. 34, 51, 2015;
// with FLIP's increments: Fei et al., ACM Trans. Graph. 40, 109, 2021). With r = x_i - x_p and D = sum S r (x) r, which
// is diagonal, as shape functions are products of one along each axis and take linear functions as they are,
//   to the grid   p_ij = sum m_p S_ip (V + C r)
//   from it       C' = C + (A - L L) dt,  A = (sum S a (x) r) D^-1    FLIP
//                 C' = L                  L = (sum S v (x) r) D^-1    PIC, XPIC and FMPM
// with v the updated velocity, for XPIC and FMPM that which they hand over. L L is what the gradient of a moving
// particle's acceleration has of the velocity itself: in a body that spins A is -omega^2 and C stands. C C in its place
// would let what C has of noise that no node sees grow without bound in the time of 1/C.
//
// A linear velocity comes back from the grid as it was, at borders, too, where nodes would otherwise have the velocity
// of the particles' centre of mass. And 1, r_x and r_y are orthogonal under the weights S, so that with Bessel's
// inequality  |V|^2 + C D C^T <= sum S v^2: what a grid gives to its particles and gets back has no more energy than it
// had, without C less by the second derivatives of the motion. Momentum and angular momentum  m (x x V + D_xx C_yx -
// D_yy C_xy)  are kept by each transfer.
#pragma once
#include "kernels/grid_to_particle.hpp"
#include "kernels/stress_update.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// Momentum of a particle, and a third number.
template <class Real>
RIVEN_INLINE Quad<Real> momentum_of(const ParticleView<Real>& p, long i, Real third) {
  return Quad<Real>{p.mass[i] * p.vx[i], p.mass[i] * p.vy[i], third, Real(0)};
}

/// Gradients of the particles' velocities; null where the plan did not ask for them. Number is const to read them.
template <class Number>
struct GradientView {
  Number *xx, *xy, *yx, *yy;

  RIVEN_INLINE auto of(long i) const { return Mat2<std::remove_const_t<Number>>{xx[i], xy[i], yx[i], yy[i]}; }
};
template <class Particles>
auto velocity_gradients(Particles& p) {
  return GradientView<std::remove_pointer_t<decltype(exec::data(p.C[0]))>>{exec::data(p.C[0]), exec::data(p.C[1]),
                                                                           exec::data(p.C[2]), exec::data(p.C[3])};
}

/// m C r of a particle of mass m: what r_x and r_y are multiplied by; nothing without `Affine`.
template <bool Affine, class Real>
struct MomentumSlope {
  Quad<Real> x{}, y{};

  RIVEN_INLINE MomentumSlope(const GradientView<Real>& C, Real m, long i) {
    if constexpr (Affine) {
      x = Quad<Real>{m * C.xx[i], m * C.yx[i], Real(0), Real(0)};
      y = Quad<Real>{m * C.xy[i], m * C.yy[i], Real(0), Real(0)};
    }
  }
};

/// Adds momenta A of lanes k .. k + 3 of the block of particle `first`, which have the same nodes.
template <bool Affine, class Real, class Shape>
RIVEN_INLINE void scatter_momenta_of_four(const Block<Real, Shape>& w, int k, const Quad<Real> (&A)[4],
                                          const GradientView<Real>& slopes, const Real* mass, long first,
                                          const NodeTarget<Real>& to) {
  if constexpr (Affine) {
    Quad<Real> B[4], C[4];
    for (int of = 0; of < 4; ++of) {
      const MomentumSlope<true, Real> slope(slopes, mass[first + k + of], first + k + of);
      B[of] = slope.x;
      C[of] = slope.y;
    }
    scatter_moments_of_four(w, k, A, B, C, to);
  } else {
    scatter_four(w, k, A, to);
  }
}

/// sum S q (x) r of the two node values from `first` on, at particle k or at the four from there.
template <int First, class Real, class Shape, class Slots>
RIVEN_INLINE void gather_moments(const Block<Real, Shape>& w, int k, const Real* q, int nx, Slots slots,
                                 GradientLanes<Real>& moments) {
  if constexpr (std::is_same_v<Slots, FourTogether>) {
    moments.set(k, gather_four<true, 0, Second::moments>(w, k, q + First, nx));
  } else {
    moments.set(k, pair_of<First>(gather_from<true, 0, Second::moments>(w, k, q, nx, slots)));
  }
}

/// The gradients that these moments are of.
template <class Real, class Shape>
RIVEN_INLINE Mat2<Real> gradient_of(const Block<Real, Shape>& w, int k, const GradientLanes<Real>& moments) {
  const Real x = inverse_of(w.xx[k]), y = inverse_of(w.yy[k]);
  return {x * moments.xx[k], y * moments.xy[k], x * moments.yx[k], y * moments.yy[k]};
}

/// trace(A D B^T), m^2/s^2: for A = B twice the kinetic energy of a gradient per mass.
template <class Real, class Shape>
RIVEN_INLINE double product_of(const Block<Real, Shape>& w, int k, const Mat2<Real>& A, const Mat2<Real>& B) {
  return w.xx[k] * (A.xx * B.xx + A.yx * B.yx) + w.yy[k] * (A.xy * B.xy + A.yy * B.yy);
}

/// New gradient of each lane, from the moments of accelerations and of the velocities that the transfer hands over.
/// What it takes out of the kinetic energy goes to `worn`, as with the velocities themselves.
template <class Real, class Shape>
RIVEN_INLINE void update_gradient(const GradientView<Real>& to, const Real* mass, const Block<Real, Shape>& w,
                                  long first, int count, const GradientLanes<Real>& a, const GradientLanes<Real>& h,
                                  const StepNumbers<Real>& n, double* worn) {
  const Real give = Real(1) - n.keep;
  exec::for_lanes(count, [&](int k) RIVEN_LANE {
    const long i = first + k;
    const Mat2<Real> C = to.of(i), A = gradient_of(w, k, a), L = gradient_of(w, k, h);
    const Mat2<Real> own = C + n.dt * (A + Real(-1) * (L * L)), handed = L + n.high_dt * A;
    const Mat2<Real> change = give * (handed + Real(-1) * own);
    const Mat2<Real> all = own + change + (-n.dt * n.damping) * C;
    to.xx[i] = all.xx;
    to.xy[i] = all.xy;
    to.yx[i] = all.yx;
    to.yy[i] = all.yy;
    worn[k] -= 0.5 * mass[i] * product_of(w, k, C + all, change);
  });
}

}  // namespace RIVEN_SIDE

}  // namespace riven
