#include "kernels/update_stress.hpp"

#include <algorithm>

#include "kernels/dispatch.hpp"
#include "kernels/stress_rule.hpp"
#include "kernels/tiles.hpp"
#include "kernels/watch.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

namespace {

/// -m times the stress that the gradients of the shape functions meet: tau, or tau M^T in USAVG.
template <class Real>
struct StressLanes {
  alignas(64) Real xx[exec::lanes], xy[exec::lanes], yx[exec::lanes], yy[exec::lanes];

  template <bool Averaged>
  RIVEN_INLINE void take(const ParticleView<Real>& p, long first, int count, const GradientLanes<Real>& g, Real dt) {
    exec::for_lanes(count, [&](int k) RIVEN_LANE {
      const long i = first + k;
      const Real m = -p.mass[i], sxy = m * p.sxy[i];
      Mat2<Real> P{m * p.sxx[i], sxy, sxy, m * p.syy[i]};
      if constexpr (Averaged)
        P = P * transposed(middle(g, k, dt));
      xx[k] = P.xx;
      xy[k] = P.xy;
      yx[k] = P.yx;
      yy[k] = P.yy;
    });
  }
};

template <class Shape, bool Averaged, class Real, class Rule>
void run_forces(const exec::Space& space, const Plan& plan, State<Real, 2>& s, Vec2 gravity, const Rule& update) {
  constexpr int L = exec::lanes;
  Real* q = exec::data(s.grid.q);
  const int nx = s.grid.lattice.nx;
  const ParticleView<Real> p = view(s.particles);
  const Positions<Real> at = positions(s);
  const CrossingSlots extra = crossing_slots(s, slots_are_shared(space, plan.scatter));
  const WatchTiles<Real, false, false, true> see(s.watch);
  const Real bx = Real(gravity.x), by = Real(gravity.y), step = Real(s.clock.dt);
  const bool together = in_cells(s);
  const TileRun<Real> tiles{s.particles.tiles,
                            s.grid.lattice,
                            extra,
                            {{p.x, p.y, p.Fxx, p.Fxy, p.Fyx, p.Fyy}, {p.mass, p.sxx, p.syy, p.sxy}, {q}}};
  scatter_tiles<false>(
      space, "stress before, forces", plan.scatter, tiles, static_cast<Real*>(nullptr), q, see,
      [p, at, extra, update, q, nx, bx, by, step, together] RIVEN_KERNEL(
          auto stretch, long begin, long end, const NodeTarget<Real>& to, TileWatch<Real>& seen) RIVEN_LANE {
        Block<Real, Shape> w;
        GradientLanes<Real> gradient;
        StressLanes<Real> stress;
        for (long first = begin; first < end; first += L) {
          const int count = static_cast<int>(std::min<long>(L, end - first));
          ask_ahead(stretch, first);
          w.template weigh<true>(at, first);
          each_gathered<true>(stretch, w, first, count, together, [&](int k, auto slots) RIVEN_LANE {
            gradient.set(k, gather_from<true, 0>(w, k, q, nx, slots));
          });
          update(first, count, gradient, step, seen);
          stress.template take<Averaged>(p, first, count, gradient, step);
          each_four(
              stretch, w, first, count, together,
              [&](int k, auto slots) RIVEN_LANE {
                const Real m = p.mass[first + k];
                const Quad<Real> A{Real(0), Real(0), m * bx, m * by}, B{Real(0), Real(0), stress.xx[k], stress.yx[k]},
                    C{Real(0), Real(0), stress.xy[k], stress.yy[k]};
                if constexpr (std::is_pointer_v<decltype(slots)>)
                  scatter_slots<false, true>(w, k, Real(0), A, B, C, to, slots, extra, static_cast<Real*>(nullptr), q);
                else
                  scatter<false, true>(w, k, Real(0), A, B, C, to);
              },
              [&](int k) RIVEN_LANE {
                const Quad<Real> m = four_at(p.mass + first + k), f[2]{bx * m, by * m};
                const Quad<Real> X[2]{four_at(stress.xx + k), four_at(stress.yx + k)};
                const Quad<Real> Y[2]{four_at(stress.xy + k), four_at(stress.yy + k)};
                scatter_forces_of_four(w, k, f, X, Y, to);
              });
        }
      });
  watch_J(s);
}

template <class Shape, class Real, class Rule>
void run_move(const exec::Space& space, State<Real, 2>& s, const Rule& update) {
  constexpr int L = exec::lanes;
  const Real* again = exec::data(s.grid.again);
  const int nx = s.grid.lattice.nx;
  const ParticleView<Real> p = view(s.particles);
  const Positions<Real> at = positions(s);
  const CrossingSlots extra = crossing_slots(s);
  const WatchTiles<Real, true, false, true> see(s.watch);
  const Real step = Real(s.clock.dt);
  const bool together = in_cells(s);
  const TileRun<Real> tiles{s.particles.tiles,
                            s.grid.lattice,
                            extra,
                            {{p.x, p.y, p.Fxx, p.Fxy, p.Fyx, p.Fyy}, {p.sxx, p.syy, p.sxy}, {again}}};
  each_tile(space, "stress after, move", tiles, see,
            [p, at, update, again, nx, step, together] RIVEN_KERNEL(auto stretch, long begin, long end,
                                                                    TileWatch<Real>& seen) RIVEN_LANE {
              Block<Real, Shape> w;
              GradientLanes<Real> gradient;
              alignas(64) Real wx[L], wy[L];
              for (long first = begin; first < end; first += L) {
                const int count = static_cast<int>(std::min<long>(L, end - first));
                ask_ahead(stretch, first);
                w.template weigh<true>(at, first);
                each_gathered<true>(stretch, w, first, count, together, [&](int k, auto slots) RIVEN_LANE {
                  const auto g = gather_from<true, 4>(w, k, again, nx, slots);
                  gradient.set(k, g);
                  put<Real>(wx + k, g.value[2]);
                  put<Real>(wy + k, g.value[3]);
                });
                update(first, count, gradient, step, seen);
                exec::for_lanes(count, [&](int k) RIVEN_LANE {
                  const Real dx = step * wx[k], dy = step * wy[k];
                  p.x[first + k] += dx;
                  p.y[first + k] += dy;
                  seen.moves(k, dx, dy);
                });
              }
            });
  watch_moves(s);
  watch_J(s);
}

}  // namespace

template <class Real>
void update_stress_and_forces(const exec::Space& space, const Plan& plan, State<Real, 2>& s, Vec2 gravity) {
  with_shape(plan.shape, [&](auto shape) {
    with_flag(plan.averaged(), [&](auto averaged) {
      using Shape = typename decltype(shape)::type;
      with_stress_rule<decltype(averaged)::value>(plan.law, s, [&](const auto& update) {
        run_forces<Shape, decltype(averaged)::value>(space, plan, s, gravity, update);
      });
    });
  });
}

template <class Real>
void update_stress_and_move(const exec::Space& space, const Plan& plan, State<Real, 2>& s) {
  with_shape(plan.shape, [&](auto shape) {
    with_flag(plan.averaged(), [&](auto averaged) {
      using Shape = typename decltype(shape)::type;
      with_stress_rule<decltype(averaged)::value>(plan.law, s,
                                                  [&](const auto& update) { run_move<Shape>(space, s, update); });
    });
  });
}

#define RIVEN_UPDATE_STRESS(Real)                                                                 \
  template void update_stress_and_forces(const exec::Space&, const Plan&, State<Real, 2>&, Vec2); \
  template void update_stress_and_move(const exec::Space&, const Plan&, State<Real, 2>&);
RIVEN_EACH_REAL(RIVEN_UPDATE_STRESS)
#undef RIVEN_UPDATE_STRESS

}  // namespace RIVEN_SIDE

}  // namespace riven
