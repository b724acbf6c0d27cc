#include "kernels/grid_to_particle.hpp"

#include <algorithm>

#include "kernels/dispatch.hpp"
#include "kernels/stress_rule.hpp"
#include "kernels/tiles.hpp"
#include "kernels/velocity_gradient.hpp"
#include "kernels/watch.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

TransferRule transfer_rule(const Plan& plan, double pic_fraction, double particle_damping, double dt) {
  TransferRule r;
  r.keep = plan.transfer == Transfer::flip ? 1 : plan.transfer == Transfer::pic ? 1 - pic_fraction : 0;
  r.high = plan.higher_order() && plan.order > 1;
  r.high_dt = r.high && plan.transfer == Transfer::xpic ? dt : 0;
  r.high_gradient = r.high && plan.transfer == Transfer::fmpm;
  r.damping = particle_damping;
  return r;
}

namespace {

/// What a block gathers: updated velocity, acceleration, and the velocity that the transfer rule hands over.
template <class Real>
struct GatheredMotion {
  alignas(64) Real vx[exec::lanes], vy[exec::lanes], ax[exec::lanes], ay[exec::lanes], hx[exec::lanes], hy[exec::lanes];
};

template <class Real, class From, class Handed>
RIVEN_INLINE void set_motion(GatheredMotion<Real>& m, int k, const From& updated, const Handed& handed) {
  put<Real>(m.vx + k, updated.value[0]);
  put<Real>(m.vy + k, updated.value[1]);
  put<Real>(m.ax + k, updated.value[2]);
  put<Real>(m.ay + k, updated.value[3]);
  put<Real>(m.hx + k, handed.value[0]);
  put<Real>(m.hy + k, handed.value[1]);
}

/// All that FLIP asks for.
template <class Real>
RIVEN_INLINE void set_acceleration(GatheredMotion<Real>& m, int k, const GatheredFour<Real>& a) {
  put<Real>(m.ax + k, a.value[0]);
  put<Real>(m.ay + k, a.value[1]);
}

template <bool Gradient, bool High, class Real, class Shape, class Slots>
RIVEN_INLINE void gather_motion(const Block<Real, Shape>& w, int k, const Real* q, const Real* high, int nx,
                                Slots slots, bool high_gradient, GatheredMotion<Real>& m, GradientLanes<Real>& g) {
  if constexpr (High) {
    if (Gradient && high_gradient) {
      const auto handed = gather_from<true, 2>(w, k, high, nx, slots);
      set_motion(m, k, gather_from<false, 4>(w, k, q, nx, slots), handed);
      g.set(k, handed);
      return;
    }
  }
  const auto updated = gather_from<Gradient, 4>(w, k, q, nx, slots);
  if constexpr (High)
    set_motion(m, k, updated, gather_from<false, 2>(w, k, high, nx, slots));
  else
    set_motion(m, k, updated, updated);
  if constexpr (Gradient)
    g.set(k, updated);
}

/// Kinetic energy that particles lose by what the transfer changes of v + a dt, m (v + v')/2 . (v + a dt - v'), J.
template <class Real>
RIVEN_INLINE void wear_off(const ParticleView<Real>& p, long first, int count, const GatheredMotion<Real>& m,
                           const StepNumbers<Real>& n, double* worn) {
  const double dt = n.dt, give = 1 - n.keep, high_dt = n.high_dt - n.dt, undamped = 1 - 0.5 * n.damping * dt;
  exec::for_lanes(count, [&](int k) RIVEN_LANE {
    const double vx = p.vx[first + k], vy = p.vy[first + k];
    const double cx = give * (m.hx[k] + high_dt * m.ax[k] - vx), cy = give * (m.hy[k] + high_dt * m.ay[k] - vy);
    worn[k] -= p.mass[first + k] *
               ((undamped * vx + 0.5 * (dt * m.ax[k] + cx)) * cx + (undamped * vy + 0.5 * (dt * m.ay[k] + cy)) * cy);
  });
}

/// Move of each lane, by its velocity of before.
template <class Real>
RIVEN_INLINE void find_move(const ParticleView<Real>& p, long first, int count, const GatheredMotion<Real>& m,
                            const StepNumbers<Real>& n, Real* dx, Real* dy, TileWatch<Real>& seen) {
  exec::for_lanes(count, [&](int k) RIVEN_LANE {
    // the grid's velocity is that after its acceleration, before the particle's damping
    dx[k] = n.dt * (m.vx[k] - Real(0.5) * n.dt * (m.ax[k] + n.damping * p.vx[first + k]));
    dy[k] = n.dt * (m.vy[k] - Real(0.5) * n.dt * (m.ay[k] + n.damping * p.vy[first + k]));
    seen.moves(k, dx[k], dy[k]);
  });
}

/// New velocity of each lane.
template <class Real>
RIVEN_INLINE void update_velocity(const ParticleView<Real>& p, long first, int count, const GatheredMotion<Real>& m,
                                  const StepNumbers<Real>& n, TileWatch<Real>& seen) {
  if (n.keep != Real(1))
    wear_off(p, first, count, m, n, seen.worn);
  exec::for_lanes(count, [&](int k) RIVEN_LANE {
    const long i = first + k;
    const Real vx = p.vx[i], vy = p.vy[i], bx = n.damping * vx, by = n.damping * vy;
    p.vx[i] = n.keep * (vx + n.dt * m.ax[k]) + (Real(1) - n.keep) * (m.hx[k] + n.high_dt * m.ax[k]) - n.dt * bx;
    p.vy[i] = n.keep * (vy + n.dt * m.ay[k]) + (Real(1) - n.keep) * (m.hy[k] + n.high_dt * m.ay[k]) - n.dt * by;
  });
  if (n.compare)
    exec::for_lanes(count, [&](int k) RIVEN_LANE {
      const Real x = std::abs(p.vx[first + k] - m.vx[k]), y = std::abs(p.vy[first + k] - m.vy[k]), most = x > y ? x : y;
      seen.apart[k] = most > seen.apart[k] ? most : seen.apart[k];
    });
}

template <class Real>
StepNumbers<Real> numbers(const State<Real, 2>& s, const TransferRule& r) {
  return {Real(s.clock.dt), Real(r.keep), Real(r.high_dt), Real(r.damping), velocities_compared(s.clock.step)};
}

/// Moments of what a block gathers, for its gradients of velocity.
template <bool High, class Real, class Shape>
struct AffineMotion {
  GradientLanes<Real> acceleration, handed;

  template <class Slots>
  RIVEN_INLINE void gather(const Block<Real, Shape>& w, int k, const Real* q, const Real* high, int nx, Slots slots) {
    gather_moments<2>(w, k, q, nx, slots, acceleration);
    gather_moments<0>(w, k, High ? high : q, nx, slots, handed);
  }

  /// Both these and the motion itself, in as few readings of the nodes as may be.
  template <class Slots>
  RIVEN_INLINE void gather_with(const Block<Real, Shape>& w, int k, const Real* q, const Real* high, int nx,
                                Slots slots, GatheredMotion<Real>& m) {
    if constexpr (High) {
      GradientLanes<Real> none;
      gather_motion<false, High>(w, k, q, high, nx, slots, false, m, none);
      gather(w, k, q, high, nx, slots);
    } else {
      const auto all = gather_from<true, 4, Second::moments>(w, k, q, nx, slots);
      set_motion(m, k, all, all);
      handed.set(k, all);
      if constexpr (std::is_same_v<Slots, FourTogether>)
        gather_moments<2>(w, k, q, nx, slots, acceleration);
      else
        acceleration.set(k, pair_of<2>(all));
    }
  }
};

struct NoUpdate {};

/// `update` of the stresses, if there is one in this pass.
template <class Shape, bool High, bool Affine, class Real, class Update>
void run(const exec::Space& space, State<Real, 2>& s, const TransferRule& rule, const Update& update) {
  constexpr bool Stress = !std::is_same_v<Update, NoUpdate>;
  constexpr int L = exec::lanes;
  const Grid<Real>& g = s.grid;
  const Real *q = exec::data(g.q), *high = exec::data(g.high);
  const int nx = s.grid.lattice.nx;
  const ParticleView<Real> p = view(s.particles);
  const GradientView<Real> slopes = velocity_gradients(s.particles);
  const Positions<Real> at = positions(s);
  const CrossingSlots extra = crossing_slots(s);
  const StepNumbers<Real> n = numbers(s, rule);
  const bool high_gradient = rule.high_gradient, together = in_cells(s);
  const WatchTiles<Real, true, true, Stress> see(s.watch, rule.keep != 1, n.compare);
  const TileRun<Real> tiles{s.particles.tiles,
                            s.grid.lattice,
                            extra,
                            {{p.x, p.y, Stress ? p.Fxx : nullptr, Stress ? p.Fxy : nullptr, Stress ? p.Fyx : nullptr,
                              Stress ? p.Fyy : nullptr},
                             {p.vx, p.vy, Stress ? p.sxx : nullptr, Stress ? p.syy : nullptr, Stress ? p.sxy : nullptr},
                             {q, High ? high : nullptr}}};
  each_tile(space, "grid to particle", tiles, see,
            [p, slopes, at, q, high, nx, update, n, high_gradient, together] RIVEN_KERNEL(
                auto stretch, long begin, long end, TileWatch<Real>& seen) RIVEN_LANE {
              Block<Real, Shape> w;
              GatheredMotion<Real> motion;
              GradientLanes<Real> gradient;
              AffineMotion<High, Real, Shape> affine;
              alignas(64) Real dx[L], dy[L];
              for (long first = begin; first < end; first += L) {
                const int count = static_cast<int>(std::min<long>(L, end - first));
                ask_ahead(stretch, first);
                w.template weigh<Stress, Affine>(at, first);
                each_gathered<Stress || Affine>(stretch, w, first, count, together, [&](int k, auto slots) RIVEN_LANE {
                  if constexpr (Affine && !Stress)
                    return affine.gather_with(w, k, q, high, nx, slots, motion);
                  gather_motion<Stress, High>(w, k, q, high, nx, slots, high_gradient, motion, gradient);
                  if constexpr (Affine)
                    affine.gather(w, k, q, high, nx, slots);
                });
                if constexpr (Affine)
                  update_gradient(slopes, p.mass, w, first, count, affine.acceleration, affine.handed, n, seen.worn);
                find_move(p, first, count, motion, n, dx, dy, seen);
                update_velocity(p, first, count, motion, n, seen);
                exec::for_lanes(count, [&](int k) RIVEN_LANE {
                  p.x[first + k] += dx[k];
                  p.y[first + k] += dy[k];
                });
                if constexpr (Stress)
                  update(first, count, gradient, n.dt, seen);
              }
            });
  watch_moves(s);
  watch_velocities(s);
  if constexpr (Stress)
    watch_J(s);
}

template <class Shape, bool High, bool Affine, class Real>
void run_again(const exec::Space& space, const Plan& plan, State<Real, 2>& s, const TransferRule& rule) {
  constexpr int L = exec::lanes;
  const Grid<Real>& g = s.grid;
  const Real *q = exec::data(g.q), *high = exec::data(g.high);
  Real* again = exec::data(s.grid.again);
  const int nx = s.grid.lattice.nx;
  const ParticleView<Real> p = view(s.particles);
  const GradientView<Real> slopes = velocity_gradients(s.particles);
  const Positions<Real> at = positions(s);
  const CrossingSlots extra = crossing_slots(s, slots_are_shared(space, plan.scatter));
  const StepNumbers<Real> n = numbers(s, rule);
  const WatchTiles<Real, false, true, false> see(s.watch, rule.keep != 1, n.compare);
  const bool together = in_cells(s), by_acceleration = n.keep == Real(1) && !n.compare;
  const TileRun<Real> tiles{s.particles.tiles, s.grid.lattice, extra, {{p.x, p.y}, {p.vx, p.vy, p.mass}, {q, again}}};
  scatter_tiles<false>(
      space, "velocities, extrapolate again", plan.scatter, tiles, static_cast<Real*>(nullptr), again, see,
      [p, slopes, at, extra, q, high, again, nx, n, together, by_acceleration] RIVEN_KERNEL(
          auto stretch, long begin, long end, const NodeTarget<Real>& to, TileWatch<Real>& seen) RIVEN_LANE {
        Block<Real, Shape> w;
        GatheredMotion<Real> motion{};
        GradientLanes<Real> none;
        AffineMotion<High, Real, Shape> affine;
        for (long first = begin; first < end; first += L) {
          const int count = static_cast<int>(std::min<long>(L, end - first));
          ask_ahead(stretch, first);
          w.template weigh<false, Affine>(at, first);
          const auto take = [&](int k, auto slots) RIVEN_LANE {
            if constexpr (Affine)
              affine.gather_with(w, k, q, high, nx, slots, motion);
            else
              gather_motion<false, High>(w, k, q, high, nx, slots, false, motion, none);
          };
          each_four(stretch, w, first, count, together, take, [&](int k) RIVEN_LANE {
            if (!Affine && by_acceleration)
              set_acceleration(motion, k, gather_four<false, 2>(w, k, q + 2, nx));
            else
              take(k, FourTogether{});
          });
          if constexpr (Affine)
            update_gradient(slopes, p.mass, w, first, count, affine.acceleration, affine.handed, n, seen.worn);
          update_velocity(p, first, count, motion, n, seen);
          const auto momentum = [&](long i) RIVEN_LANE { return momentum_of(p, i, Real(0)); };
          each_four(
              stretch, w, first, count, together,
              [&](int k, auto slots) RIVEN_LANE {
                const Quad<Real> A = momentum(first + k);
                const MomentumSlope<Affine, Real> slope(slopes, p.mass[first + k], first + k);
                if constexpr (std::is_pointer_v<decltype(slots)>)
                  scatter_slots<false, Affine, Second::moments>(w, k, Real(0), A, slope.x, slope.y, to, slots, extra,
                                                                static_cast<Real*>(nullptr), again);
                else
                  scatter<false, Affine, Second::moments>(w, k, Real(0), A, slope.x, slope.y, to);
              },
              [&](int k) RIVEN_LANE {
                const long i = first + k;
                const Quad<Real> A[4]{momentum(i), momentum(i + 1), momentum(i + 2), momentum(i + 3)};
                scatter_momenta_of_four<Affine>(w, k, A, slopes, p.mass, first, to);
              });
        }
      });
  watch_velocities(s);
}

}  // namespace

template <class Real>
void grid_to_particle(const exec::Space& space, const Plan& plan, State<Real, 2>& s, const TransferRule& rule,
                      bool with_stress) {
  with_shape(plan.shape, [&](auto shape) {
    using Shape = typename decltype(shape)::type;
    with_affine<Shape>(plan.affine, [&](auto affine) {
      with_flag(rule.high, [&](auto high) {
        constexpr bool High = decltype(high)::value, Affine = decltype(affine)::value;
        if (with_stress)
          with_stress_rule<false>(plan.law, s,
                                  [&](const auto& update) { run<Shape, High, Affine>(space, s, rule, update); });
        else
          run<Shape, High, Affine>(space, s, rule, NoUpdate{});
      });
    });
  });
}

template <class Real>
void grid_to_particle_again(const exec::Space& space, const Plan& plan, State<Real, 2>& s, const TransferRule& rule) {
  with_shape(plan.shape, [&](auto shape) {
    using Shape = typename decltype(shape)::type;
    with_affine<Shape>(plan.affine, [&](auto affine) {
      with_flag(rule.high, [&](auto high) {
        run_again<Shape, decltype(high)::value, decltype(affine)::value>(space, plan, s, rule);
      });
    });
  });
}

#define RIVEN_GRID_TO_PARTICLE(Real)                                                                           \
  template void grid_to_particle(const exec::Space&, const Plan&, State<Real, 2>&, const TransferRule&, bool); \
  template void grid_to_particle_again(const exec::Space&, const Plan&, State<Real, 2>&, const TransferRule&);
RIVEN_EACH_REAL(RIVEN_GRID_TO_PARTICLE)
#undef RIVEN_GRID_TO_PARTICLE

}  // namespace RIVEN_SIDE

}  // namespace riven
