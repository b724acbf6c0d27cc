#include "kernels/apply_loads.hpp"

#include <utility>

#include "core/exec/parallel.hpp"
#include "kernels/block.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/field_slots.hpp"
#include "kernels/make_loads.hpp"
#include "kernels/views.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

namespace {

/// Momentum that loads give in a step, and its moment about the origin, over the step; and the sum of the moments'
/// sizes, as those of loads that face each other add up to nothing.
struct Push {
  Vec2 force;
  double torque = 0, size = 0;
  RIVEN_FN Push& operator+=(const Push& o) {
    force += o.force;
    torque += o.torque;
    size += o.size;
    return *this;
  }
};

/// Spreads the forces on particles to the nodes of their fields.
template <class Shape, class Real>
void spread(const exec::Space& space, ScatterKind kind, State<Real, 2>& s) {
  const Lattice l = s.grid.lattice;
  const FieldSlots slots(s.fields, l.nodes());
  const Positions<Real> at = positions(s);
  const std::uint32_t* fields = s.fields.extra.empty() ? nullptr : exec::data(std::as_const(s.fields.fields));
  const int *loaded = exec::data(std::as_const(s.loads.loaded)),
            *position = exec::data(std::as_const(s.loads.position));
  const Vec2* force = exec::data(std::as_const(s.loads.force));
  Vec2* applied_at = exec::data_to_fill(s.loads.applied_at);
  Real* q = exec::data(s.grid.q);
  exec::scatter_for(space, "loads", kind == ScatterKind::ordered, s.loads.loaded.size(), [=] RIVEN_KERNEL(long n) {
    const long i = position[loaded[n]];
    const DomainSetting<Real, 2>& d = at.domain.of(i);
    const auto a = Shape::axis((at.x[i] - l.origin.x) / l.h, d.axis[0]);
    const auto b = Shape::axis((at.y[i] - l.origin.y) / l.h, d.axis[1]);
    const std::uint32_t word = fields ? fields[i] : 0;
    applied_at[n] = {at.x[i], at.y[i]};
    for (int j = 0; j < Shape::width; ++j)
      for (int m = 0; m < Shape::width; ++m) {
        const int node = (b.base + j) * l.nx + a.base + m;
        Real* to = q + 4 * slots.of(node, CrackFields::field_of(word, j * Shape::width + m));
        add(to[2], Real(force[n].x) * a.s[m] * b.s[j], in_team);
        add(to[3], Real(force[n].y) * a.s[m] * b.s[j], in_team);
      }
  });
}

}  // namespace

template <class Real>
void apply_loads(const exec::Space& space, const Plan& plan, State<Real, 2>& s) {
  Loads& loads = s.loads;
  Vec2* force = loads.force.data();
  for (const LoadGroup& g : loads.groups) {
    find_forces(space, g, s.clock.middle(), force);
    force += g.id.size();
  }
  with_shape(plan.shape, [&](auto shape) { spread<typename decltype(shape)::type>(space, plan.scatter, s); });
  const Push sum = exec::parallel_reduce<Push>(space, "loads", loads.loaded.size(),
                                               [force = exec::data(std::as_const(loads.force)),
                                                x = exec::data(std::as_const(loads.applied_at))] RIVEN_KERNEL(long n) {
                                                 const double moment = cross(x[n], force[n]);
                                                 return Push{force[n], moment, moment < 0 ? -moment : moment};
                                               });
  s.ledger.momentum.impulse += s.clock.dt * sum.force;
  s.ledger.momentum.torque_impulse += s.clock.dt * sum.torque;
  s.ledger.momentum.torque_size += s.clock.dt * sum.size;
}

template <class Real>
void settle_loads(const exec::Space& space, State<Real, 2>& state) {
  const State<Real, 2>& s = state;
  const double *x = exec::data(s.particles.x[0]), *y = exec::data(s.particles.x[1]);
  const int *loaded = exec::data(s.loads.loaded), *position = exec::data(s.loads.position);
  const Vec2 *force = exec::data(s.loads.force), *from = exec::data(s.loads.applied_at);
  state.ledger.energy.external_work +=
      exec::parallel_reduce<double>(space, "loads: work", s.loads.loaded.size(), [=] RIVEN_KERNEL(long n) {
        const long i = position[loaded[n]];
        return dot(force[n], Vec2{x[i], y[i]} - from[n]);
      });
}

#define RIVEN_APPLY_LOADS(Real)                                                \
  template void apply_loads(const exec::Space&, const Plan&, State<Real, 2>&); \
  template void settle_loads(const exec::Space&, State<Real, 2>&);
RIVEN_EACH_REAL(RIVEN_APPLY_LOADS)
#undef RIVEN_APPLY_LOADS

}  // namespace RIVEN_SIDE

}  // namespace riven
