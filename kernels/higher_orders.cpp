#include "kernels/higher_orders.hpp"

#include <algorithm>

#include "kernels/advance_grid.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/prescribe_velocities.hpp"
#include "kernels/tiles.hpp"
#include "kernels/views.hpp"
#include "kernels/watch.hpp"

namespace riven {

namespace {

/// next += S^T M S term, in one pass over the particles.
template <class Shape, class Real>
void smooth(const exec::Space& space, const Plan& plan, State<Real, 2>& s) {
  constexpr int L = exec::lanes;
  const Real* term = s.grid.term.data();
  Real* next = s.grid.next.data();
  const int nx = s.grid.lattice.nx;
  const Real* mass = s.particles.mass.data();
  const Positions<Real> at = positions(s);
  const CrossingSlots extra = crossing_slots(s, plan.scatter == ScatterKind::atomic && space.threads() > 1);
  const TileRun<Real> tiles{s.particles.tiles, s.grid.lattice, extra, {{at.x, at.y}, {mass}, {term, next}}};
  scatter_tiles<false>(space, "higher orders", plan.scatter, tiles, static_cast<Real*>(nullptr), next, WatchNothing{},
                       [=](auto stretch, long begin, long end, const NodeTarget<Real>& to, auto&) RIVEN_LANE {
                         Block<Real, Shape> w;
                         for (long first = begin; first < end; first += L) {
                           const int count = static_cast<int>(std::min<long>(L, end - first));
                           ask_ahead(stretch, first);
                           w.weigh(at, first);
                           each_particle<Shape>(stretch, first, count, [&](int k, auto slots) RIVEN_LANE {
                             const Quad<Real> v = gather_from<false>(w, k, term, nx, slots).value;
                             const Quad<Real> mv = mass[first + k] * v, zero{};
                             if constexpr (std::is_pointer_v<decltype(slots)>)
                               scatter_slots<false, false>(w, k, Real(0), mv, zero, zero, to, slots, extra,
                                                           static_cast<Real*>(nullptr), next);
                             else
                               scatter<false, false>(w, k, Real(0), mv, zero, zero, to);
                           });
                         }
                       });
}

}  // namespace

template <class Real>
void higher_orders(const exec::Space& space, const Plan& plan, State<Real, 2>& s) {
  Grid<Real>& g = s.grid;
  const long slots = g.slots();
  const Real *q = g.q.data(), *mass = g.mass.data();
  const Real back = Real(plan.transfer == Transfer::xpic ? s.clock.dt : 0), least = Real(mass_cutoff(s));
  exec::parallel_for(
      space, "higher orders: first", slots,
      [=, high = g.high.data(), term = g.term.data(), next = g.next.data()](long n) {
        const Quad<Real> v{q[4 * n] - back * q[4 * n + 2], q[4 * n + 1] - back * q[4 * n + 3], Real(0), Real(0)};
        quad_at<Real>(high + 4 * n) = v;
        quad_at<Real>(term + 4 * n) = v;
        quad_at<Real>(next + 4 * n) = Quad<Real>{};
      });
  for (int j = 1; j < plan.order; ++j) {
    with_shape(plan.shape, [&](auto shape) { smooth<typename decltype(shape)::type>(space, plan, s); });
    exec::parallel_for(space, "higher orders: term", slots, [=, term = g.term.data(), next = g.next.data()](long n) {
      const Real inverse = mass[n] > least ? Real(1) / mass[n] : Real(0);
      quad_at<Real>(next + 4 * n) = quad_at<Real>(term + 4 * n) + (-inverse) * quad_at<Real>(next + 4 * n);
    });
    if (plan.constraints)
      prescribe_velocities(space, s, Stage::term);
    g.term.swap(g.next);
    exec::parallel_for(space, "higher orders: sum", slots,
                       [=, high = g.high.data(), term = g.term.data(), next = g.next.data()](long n) {
                         quad_at<Real>(high + 4 * n) += quad_at<Real>(term + 4 * n);
                         quad_at<Real>(next + 4 * n) = Quad<Real>{};
                       });
  }
}

#define RIVEN_HIGHER_ORDERS(Real) template void higher_orders(const exec::Space&, const Plan&, State<Real, 2>&);
RIVEN_HIGHER_ORDERS(double)
RIVEN_HIGHER_ORDERS(float)
#undef RIVEN_HIGHER_ORDERS

}  // namespace riven
