#include "kernels/apply_loads.hpp"

#include <algorithm>
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

/// Weights of the nodes that take a load on a particle.
template <class Shape, class Real>
struct LoadWeights {
  static constexpr Real least = Real(1e-10);  ///< of a particle's mass, in a node that takes a part of its load
  static constexpr int middle = Shape::width / 2;
  Axis<Real, Shape::width> x, y;

  RIVEN_FN LoadWeights(const Lattice& l, Vec2 at, const DomainSetting<Real, 2>& d, Outward out)
      : x(along((at.x - l.origin.x) / l.h, d.axis[0], out.along[0])),
        y(along((at.y - l.origin.y) / l.h, d.axis[1], out.along[1])) {}

  static RIVEN_FN Axis<Real, Shape::width> along(double X, const AxisSetting<Real>& setting, int out) {
    Axis<Real, Shape::width> to = axis_at_edge<Shape>(X, setting, out);
    if (out == 0)
      return to;
    const auto seen = Shape::axis(X, setting);
    for (int m = 0; m < Shape::width; ++m)
      if (seen.s[m] < least && m != middle) {
        to.s[middle] += to.s[m];
        to.s[m] = 0;
      }
    return to;
  }

  RIVEN_FN int node(const Lattice& l, int m, int j) const { return (y.base + j) * l.nx + x.base + m; }

  /// Where the force has the moment that the nodes get.
  RIVEN_FN Vec2 place(const Lattice& l, Vec2 at, Outward out) const {
    Vec2 sum;
    for (int m = 0; m < Shape::width; ++m)
      sum += Vec2{double(x.s[m]) * (x.base + m), double(y.s[m]) * (y.base + m)};
    return {out.along[0] == 0 ? at.x : l.origin.x + l.h * sum.x, out.along[1] == 0 ? at.y : l.origin.y + l.h * sum.y};
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
  const Outward* out = exec::data(std::as_const(s.loads.out));
  Vec2 *from = exec::data_to_fill(s.loads.from), *applied_at = exec::data_to_fill(s.loads.applied_at);
  Real* q = exec::data(s.grid.q);
  exec::scatter_for(space, "loads", kind == ScatterKind::ordered, s.loads.loaded.size(), [=] RIVEN_KERNEL(long n) {
    const long i = position[loaded[n]];
    const LoadWeights<Shape, Real> w(l, {at.x[i], at.y[i]}, at.domain.of(i), out[n]);
    const std::uint32_t word = fields ? fields[i] : 0;
    from[n] = {at.x[i], at.y[i]};
    applied_at[n] = w.place(l, from[n], out[n]);
    for (int j = 0; j < Shape::width; ++j)
      for (int m = 0; m < Shape::width; ++m) {
        Real* to = q + 4 * slots.of(w.node(l, m, j), CrackFields::field_of(word, j * Shape::width + m));
        add(to[2], Real(force[n].x) * w.x.s[m] * w.y.s[j], in_team);
        add(to[3], Real(force[n].y) * w.x.s[m] * w.y.s[j], in_team);
      }
  });
}

/// The velocities by which the solid strains in a step: those after it (USL), those before it (USF), or the mean that
/// was extrapolated again.
template <class Real>
struct StrainingVelocity {
  const Real *q, *again;
  Real back;  ///< s

  StrainingVelocity(const Plan& plan, const State<Real, 2>& s)
      : q(exec::data(s.grid.q)),
        again(plan.extrapolate_again() ? exec::data(s.grid.again) : nullptr),
        back(plan.update == StressUpdate::usf ? Real(s.clock.dt) : Real(0)) {}

  RIVEN_FN Vec2 operator()(long slot) const {
    if (again)
      return {again[4 * slot + 2], again[4 * slot + 3]};
    return {q[4 * slot] - back * q[4 * slot + 2], q[4 * slot + 1] - back * q[4 * slot + 3]};
  }
};

/// Work of the forces along the way that edges go beyond the middles of their particles, J.
template <class Shape, class Real>
double work_of_edges(const exec::Space& space, const Plan& plan, const State<Real, 2>& s) {
  const Lattice l = s.grid.lattice;
  const FieldSlots slots(s.fields, l.nodes());
  const auto domain = positions(s).domain;
  const std::uint32_t* fields = s.fields.extra.empty() ? nullptr : exec::data(s.fields.fields);
  const int *loaded = exec::data(s.loads.loaded), *position = exec::data(s.loads.position);
  const Vec2 *force = exec::data(s.loads.force), *from = exec::data(s.loads.from);
  const Outward* out = exec::data(s.loads.out);
  const StrainingVelocity<Real> velocity(plan, s);
  const double dt = s.clock.dt;
  return exec::parallel_reduce<double>(space, "loads: work", s.loads.loaded.size(), [=] RIVEN_KERNEL(long n) {
    if (!out[n].any())
      return 0.0;
    const long i = position[loaded[n]];
    const LoadWeights<Shape, Real> edge(l, from[n], domain.of(i), out[n]), middle(l, from[n], domain.of(i), {});
    const std::uint32_t word = fields ? fields[i] : 0;
    Vec2 more;
    for (int j = 0; j < Shape::width; ++j)
      for (int m = 0; m < Shape::width; ++m) {
        const int field = CrackFields::field_of(word, j * Shape::width + m);
        more += double(edge.x.s[m] * edge.y.s[j] - middle.x.s[m] * middle.y.s[j]) *
                velocity(slots.of(edge.node(l, m, j), field));
      }
    return dt * dot(force[n], more);
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
void settle_loads(const exec::Space& space, const Plan& plan, State<Real, 2>& state) {
  const State<Real, 2>& s = state;
  const double *x = exec::data(s.particles.x[0]), *y = exec::data(s.particles.x[1]);
  const int *loaded = exec::data(s.loads.loaded), *position = exec::data(s.loads.position);
  const Vec2 *force = exec::data(s.loads.force), *from = exec::data(s.loads.from);
  state.ledger.energy.external_work +=
      exec::parallel_reduce<double>(space, "loads: work", s.loads.loaded.size(), [=] RIVEN_KERNEL(long n) {
        const long i = position[loaded[n]];
        return dot(force[n], Vec2{x[i], y[i]} - from[n]);
      });
  if (std::any_of(s.loads.groups.begin(), s.loads.groups.end(), [](const LoadGroup& g) { return g.out.any(); }))
    with_shape(plan.shape, [&](auto shape) {
      state.ledger.energy.external_work += work_of_edges<typename decltype(shape)::type>(space, plan, s);
    });
}

#define RIVEN_APPLY_LOADS(Real)                                                \
  template void apply_loads(const exec::Space&, const Plan&, State<Real, 2>&); \
  template void settle_loads(const exec::Space&, const Plan&, State<Real, 2>&);
RIVEN_EACH_REAL(RIVEN_APPLY_LOADS)
#undef RIVEN_APPLY_LOADS

}  // namespace RIVEN_SIDE

}  // namespace riven
