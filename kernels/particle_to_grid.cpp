#include "kernels/particle_to_grid.hpp"

#include <algorithm>

#include "kernels/dispatch.hpp"
#include "kernels/tiles.hpp"
#include "kernels/velocity_gradient.hpp"
#include "kernels/views.hpp"
#include "kernels/watch.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

namespace {

/// Without forces a node's mass is summed beside its momentum, q = [px py m 0]: that costs nothing, and an array of its
/// own a quarter of the task.
template <class Shape, bool Forces, bool Affine, class Real>
void run(const exec::Space& space, const Plan& plan, State<Real, 2>& s, Vec2 gravity) {
  constexpr int L = exec::lanes;
  constexpr Second second = !Affine ? Second::gradients : Forces ? Second::both : Second::moments;
  Real *mass = exec::data(s.grid.mass), *q = exec::data(s.grid.q);
  const ParticleView<Real> p = view(s.particles);
  const GradientView<Real> slopes = velocity_gradients(s.particles);
  const Positions<Real> at = positions(s);
  const CrossingSlots extra = crossing_slots(s, slots_are_shared(space, plan.scatter));
  const TileRun<Real> tiles{
      s.particles.tiles,
      s.grid.lattice,
      extra,
      {{p.x, p.y},
       {p.vx, p.vy, p.mass, Forces ? p.sxx : nullptr, Forces ? p.syy : nullptr, Forces ? p.sxy : nullptr},
       {q},
       Forces ? mass : nullptr}};
  const bool together = in_cells(s);
  const Real bx = Real(gravity.x), by = Real(gravity.y);
  scatter_tiles<Forces>(space, "particle to grid", plan.scatter, tiles, mass, q, WatchNothing{},
                        [p, slopes, at, extra, mass, q, bx, by, together] RIVEN_KERNEL(
                            auto stretch, long begin, long end, const NodeTarget<Real>& to, auto&) RIVEN_LANE {
                          Block<Real, Shape> w;
                          alignas(64) Real m[L], px[L], py[L], txx[L], tyy[L], txy[L];
                          for (long first = begin; first < end; first += L) {
                            const int count = static_cast<int>(std::min<long>(L, end - first));
                            ask_ahead(stretch, first);
                            w.template weigh<Forces, Affine>(at, first);
                            exec::for_lanes(L, [&](int k) RIVEN_LANE {
                              m[k] = p.mass[first + k];
                              px[k] = m[k] * p.vx[first + k];
                              py[k] = m[k] * p.vy[first + k];
                              if constexpr (Forces) {
                                txx[k] = -m[k] * p.sxx[first + k];
                                tyy[k] = -m[k] * p.syy[first + k];
                                txy[k] = -m[k] * p.sxy[first + k];
                              }
                            });
                            const auto one = [&](int k, auto slots) RIVEN_LANE {
                              Quad<Real> A{px[k], py[k], m[k], Real(0)};
                              auto [B, C] = MomentumSlope<Affine, Real>(slopes, m[k], first + k);
                              if constexpr (Forces) {
                                A = Quad<Real>{px[k], py[k], m[k] * bx, m[k] * by};
                                B = Quad<Real>{B[0], B[1], txx[k], txy[k]};
                                C = Quad<Real>{C[0], C[1], txy[k], tyy[k]};
                              }
                              if constexpr (std::is_pointer_v<decltype(slots)>)
                                scatter_slots<Forces, Forces || Affine, second>(w, k, m[k], A, B, C, to, slots, extra,
                                                                                mass, q);
                              else
                                scatter<Forces, Forces || Affine, second>(w, k, m[k], A, B, C, to);
                            };
                            if constexpr (Forces)
                              each_particle<Shape>(stretch, first, count, one);
                            else
                              each_four(stretch, w, first, count, together, one, [&](int k) RIVEN_LANE {
                                Quad<Real> A[4];
                                for (int of = 0; of < 4; ++of)
                                  A[of] = Quad<Real>{px[k + of], py[k + of], m[k + of], Real(0)};
                                scatter_momenta_of_four<Affine>(w, k, A, slopes, p.mass, first, to);
                              });
                          }
                        });
  if constexpr (!Forces)
    exec::parallel_for(space, "particle to grid", s.grid.slots(), [=] RIVEN_KERNEL(long n) {
      mass[n] = q[4 * n + 2];
      q[4 * n + 2] = 0;
    });
}

}  // namespace

template <class Real>
void clear_grid(const exec::Space& space, State<Real, 2>& s, bool with_forces) {
  if (with_forces)
    exec::parallel_zero(space, "clear grid", s.grid.mass, s.grid.q);
  else
    exec::parallel_zero(space, "clear grid", s.grid.q);
}

template <class Real>
void particle_to_grid(const exec::Space& space, const Plan& plan, State<Real, 2>& s, bool with_forces, Vec2 gravity) {
  with_shape(plan.shape, [&](auto shape) {
    using Shape = typename decltype(shape)::type;
    with_affine<Shape>(plan.affine, [&](auto affine) {
      with_flag(with_forces, [&](auto forces) {
        run<Shape, decltype(forces)::value, decltype(affine)::value>(space, plan, s, gravity);
      });
    });
  });
}

#define RIVEN_PARTICLE_TO_GRID(Real)                                   \
  template void clear_grid(const exec::Space&, State<Real, 2>&, bool); \
  template void particle_to_grid(const exec::Space&, const Plan&, State<Real, 2>&, bool, Vec2);
RIVEN_EACH_REAL(RIVEN_PARTICLE_TO_GRID)
#undef RIVEN_PARTICLE_TO_GRID

}  // namespace RIVEN_SIDE

}  // namespace riven
