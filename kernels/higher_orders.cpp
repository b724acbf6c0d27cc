#include "kernels/higher_orders.hpp"

#include <algorithm>
#include <utility>

#include "kernels/advance_grid.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/full_mass.hpp"
#include "kernels/gather.hpp"
#include "kernels/prescribe_velocities.hpp"
#include "kernels/tiles.hpp"
#include "kernels/views.hpp"
#include "kernels/watch.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

namespace {

/// next += S^T M S term, in one pass over the particles; over those that see a node across a crack, where the full mass
/// matrix has the others.
template <class Shape, bool OnlyCrossing, bool Affine, class Real>
void smooth(const exec::Space& space, const Plan& plan, State<Real, 2>& s, const Real* term) {
  constexpr int L = exec::lanes;
  Real* next = exec::data(s.grid.next);
  const int nx = s.grid.lattice.nx;
  const Real* mass = exec::data(std::as_const(s.particles.mass));
  const Positions<Real> at = positions(s);
  const CrossingSlots extra = crossing_slots(s, slots_are_shared(space, plan.scatter));
  const bool together = in_cells(s);
  const TileRun<Real> tiles{s.particles.tiles, s.grid.lattice, extra, {{at.x, at.y}, {mass}, {term, next}}};
  scatter_tiles<false>(space, "higher orders", plan.scatter, tiles, static_cast<Real*>(nullptr), next, WatchNothing{},
                       [at, extra, mass, term, next, nx, together] RIVEN_KERNEL(
                           auto stretch, long begin, long end, const NodeTarget<Real>& to, auto&) RIVEN_LANE {
                         if constexpr (OnlyCrossing && !decltype(stretch)::value)
                           return;
                         Block<Real, Shape> w;
                         for (long first = begin; first < end; first += L) {
                           const int count = static_cast<int>(std::min<long>(L, end - first));
                           ask_ahead(stretch, first);
                           w.template weigh<false, Affine>(at, first);
                           const auto momentum = [&](int k, auto slots) RIVEN_LANE {
                             auto g = gather_from<Affine, 4, Second::moments>(w, k, term, nx, slots);
                             g.value = mass[first + k] * g.value;
                             if constexpr (Affine) {
                               g.dx = mass[first + k] * inverse_of(w.xx[k]) * g.dx;
                               g.dy = mass[first + k] * inverse_of(w.yy[k]) * g.dy;
                             }
                             return g;
                           };
                           const auto one = [&](int k, auto slots) RIVEN_LANE {
                             constexpr bool crosses = std::is_pointer_v<decltype(slots)>;
                             if constexpr (OnlyCrossing && !crosses)
                               return;
                             const Gathered<Real> mv = momentum(k, slots);
                             if constexpr (crosses)
                               scatter_slots<false, Affine, Second::moments>(w, k, Real(0), mv.value, mv.dx, mv.dy, to,
                                                                             slots, extra, static_cast<Real*>(nullptr),
                                                                             next);
                             else
                               scatter<false, Affine, Second::moments>(w, k, Real(0), mv.value, mv.dx, mv.dy, to);
                           };
                           if constexpr (OnlyCrossing)
                             each_particle<Shape>(stretch, first, count, one);
                           else
                             each_four(stretch, w, first, count, together, one, [&](int k) RIVEN_LANE {
                               const Gathered<Real> mv[4]{momentum(k, nullptr), momentum(k + 1, nullptr),
                                                          momentum(k + 2, nullptr), momentum(k + 3, nullptr)};
                               const Quad<Real> A[4]{mv[0].value, mv[1].value, mv[2].value, mv[3].value};
                               if constexpr (Affine)
                                 scatter_moments_of_four(w, k, A, {mv[0].dx, mv[1].dx, mv[2].dx, mv[3].dx},
                                                         {mv[0].dy, mv[1].dy, mv[2].dy, mv[3].dy}, to);
                               else
                                 scatter_four(w, k, A, to);
                             });
                         }
                       });
}

/// The full mass matrix of all particles but those that see a node across a crack.
template <class Shape, class Real>
void build_full_mass(const exec::Space& space, State<Real, 2>& s) {
  constexpr int L = exec::lanes;
  exec::parallel_zero(space, "clear full mass", s.grid.full_mass);
  const FullMass<Real> full{exec::data(s.grid.full_mass), s.grid.lattice.nx};
  const Real* mass = exec::data(std::as_const(s.particles.mass));
  const Positions<Real> at = positions(s);
  const bool together = in_cells(s);
  const TileRun<Real> tiles{s.particles.tiles, s.grid.lattice, crossing_slots(s), {{at.x, at.y}, {mass}, {}}};
  scatter_tiles<false>(
      space, "full mass", ScatterKind::ordered, tiles, static_cast<Real*>(nullptr), full.entries, WatchNothing{},
      [at, full, mass, together] RIVEN_KERNEL(auto stretch, long begin, long end, const auto&, auto&) RIVEN_LANE {
        Block<Real, Shape> w;
        for (long first = begin; first < end; first += L) {
          const int count = static_cast<int>(std::min<long>(L, end - first));
          ask_ahead(stretch, first);
          w.template weigh<false>(at, first);
          each_four(
              stretch, w, first, count, together,
              [&](int k, auto slots) RIVEN_LANE {
                if constexpr (!std::is_pointer_v<decltype(slots)>)
                  full.template add<1>(w, k, mass + first + k);
              },
              [&](int k) RIVEN_LANE { full.template add<4>(w, k, mass + first + k); });
        }
      });
}

/// One step of the series: high += term, and next = term - m^-1 (next + M term) for the term after it. `First`: high
/// begins with this term. `Last`: it takes the one after it, too. Without `Full` there is no M, without `Passes` no
/// particle has added to `next`.
template <bool First, bool Last, bool Full, bool Passes, class Real>
void find_term(const exec::Space& space, State<Real, 2>& s, const Real* term) {
  Grid<Real>& g = s.grid;
  const Real least = Real(mass_cutoff(s));
  const FullMass<Real> full{exec::data(g.full_mass), g.lattice.nx};
  const long inside = 2L * g.lattice.nx + 2, end = g.lattice.nodes() - inside;  // ghosts, without mass, lie outside
  exec::parallel_for(space, "higher orders: term", g.slots(),
                     [term, full, inside, end, least, mass = exec::data(std::as_const(g.mass)),
                      high = exec::data(g.high), next = exec::data(g.next)] RIVEN_KERNEL(long n) {
                       const Quad<Real> t = quad_at<Real>(term + 4 * n);
                       Quad<Real> smoothed{};
                       if constexpr (Passes)
                         smoothed = quad_at<Real>(next + 4 * n);
                       if (Full && n >= inside && n < end && mass[n] > least)
                         smoothed += full.times(term, n);
                       const Real inverse = mass[n] > least ? Real(1) / mass[n] : Real(0);
                       const Quad<Real> after = t + (-inverse) * smoothed;
                       quad_at<Real>(next + 4 * n) = after;
                       Quad<Real> sum = t;
                       if constexpr (!First)
                         sum += quad_at<Real>(high + 4 * n);
                       if constexpr (Last)
                         sum += after;
                       quad_at<Real>(high + 4 * n) = sum;
                     });
}

/// v - dt a, as before the momentum update.
template <class Real>
void go_back(const exec::Space& space, State<Real, 2>& s) {
  const Real* q = exec::data(std::as_const(s.grid.q));
  const Real dt = Real(s.clock.dt);
  exec::parallel_for(
      space, "higher orders: before", s.grid.slots(), [=, term = exec::data(s.grid.term)] RIVEN_KERNEL(long n) {
        const Quad<Real> v{q[4 * n] - dt * q[4 * n + 2], q[4 * n + 1] - dt * q[4 * n + 3], Real(0), Real(0)};
        quad_at<Real>(term + 4 * n) = v;
      });
}

}  // namespace

template <class Real>
void higher_orders(const exec::Space& space, const Plan& plan, State<Real, 2>& s,
                   const std::function<void(bool last)>& hold) {
  Grid<Real>& g = s.grid;
  const bool full = plan.full_mass(), passes = !full || plan.cracks;
  if (plan.transfer == Transfer::xpic)
    go_back(space, s);
  with_shape(plan.shape, [&](auto chosen) {
    using Shape = typename decltype(chosen)::type;
    if (full)
      build_full_mass<Shape>(space, s);
    for (int j = 1; j < plan.order; ++j) {
      const bool given = j == 1 && plan.transfer == Transfer::fmpm, last = j + 1 == plan.order && !plan.constraints;
      const Real* term = exec::data(std::as_const(given ? g.q : g.term));
      if (passes) {
        exec::parallel_zero(space, "clear term", g.next);
        with_affine<Shape>(plan.affine, [&](auto affine) {
          with_flag(full, [&](auto rest) {
            smooth<Shape, decltype(rest)::value, decltype(affine)::value>(space, plan, s, term);
          });
        });
      }
      with_flags(
          [&](auto is_first, auto is_last, auto has_full, auto has_passes) {
            find_term<decltype(is_first)::value, decltype(is_last)::value, decltype(has_full)::value,
                      decltype(has_passes)::value>(space, s, term);
          },
          j == 1, last, full, passes);
      if (plan.constraints)
        prescribe_velocities(space, s, Stage::term);
      hold(last);
      g.term.swap(g.next);
    }
  });
  if (plan.constraints)
    exec::parallel_for(space, "higher orders: last", g.slots(),
                       [high = exec::data(g.high), term = exec::data(std::as_const(g.term))] RIVEN_KERNEL(long n) {
                         quad_at<Real>(high + 4 * n) += quad_at<Real>(term + 4 * n);
                       });
}

#define RIVEN_HIGHER_ORDERS(Real) \
  template void higher_orders(const exec::Space&, const Plan&, State<Real, 2>&, const std::function<void(bool)>&);
RIVEN_EACH_REAL(RIVEN_HIGHER_ORDERS)
#undef RIVEN_HIGHER_ORDERS

}  // namespace RIVEN_SIDE

}  // namespace riven
