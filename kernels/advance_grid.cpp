#include "kernels/advance_grid.hpp"

#include <utility>

#include "core/exec/parallel.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/field_slots.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

template <class Real>
void momenta_to_velocities(const exec::Space& space, State<Real, 2>& s) {
  const Real* mass = exec::data(std::as_const(s.grid.mass));
  Real* q = exec::data(s.grid.q);
  const Real least = Real(mass_cutoff(s));
  exec::parallel_for(space, "momenta to velocities", s.grid.slots(), [=] RIVEN_KERNEL(long n) {
    const Real inverse = mass[n] > least ? Real(1) / mass[n] : Real(0);
    q[4 * n] *= inverse;
    q[4 * n + 1] *= inverse;
  });
}

namespace {

template <bool FromVelocity, class Real>
void advance(const exec::Space& space, State<Real, 2>& s, double damping) {
  const Real* mass = exec::data(std::as_const(s.grid.mass));
  Real* q = exec::data(s.grid.q);
  const Real least = Real(mass_cutoff(s)), dt = Real(s.clock.dt), kappa = Real(damping);
  exec::parallel_for(space, "advance grid", s.grid.slots(), [=] RIVEN_KERNEL(long n) {
    const Real inverse = mass[n] > least ? Real(1) / mass[n] : Real(0);
    const Real scale = FromVelocity ? Real(1) : inverse;
    const Real vx = q[4 * n] * scale, vy = q[4 * n + 1] * scale;
    const Real ax = q[4 * n + 2] * inverse - kappa * vx, ay = q[4 * n + 3] * inverse - kappa * vy;
    q[4 * n] = vx + ax * dt;
    q[4 * n + 1] = vy + ay * dt;
    q[4 * n + 2] = ax;
    q[4 * n + 3] = ay;
  });
}

}  // namespace

template <class Real>
void advance_grid(const exec::Space& space, State<Real, 2>& s, bool from_velocity, double damping) {
  with_flag(from_velocity, [&](auto flag) { advance<decltype(flag)::value>(space, s, damping); });
}

template <class Real>
void velocities_again(const exec::Space& space, const Plan& plan, double particle_damping, State<Real, 2>& s) {
  const bool own = plan.cracks && !plan.cracks_move_again();
  const int* flagged = own ? exec::data(std::as_const(s.fields.node_index)) : nullptr;
  const Real *mass = exec::data(std::as_const(s.grid.mass)), *q = exec::data(std::as_const(s.grid.q));
  Real* again = exec::data(s.grid.again);
  const Real least = Real(mass_cutoff(s)), dt = Real(s.clock.dt),
             slowed = Real(0.5 * (1 - particle_damping * s.clock.dt));
  const long nodes = s.grid.lattice.nodes();
  exec::parallel_for(space, "velocities again", s.grid.slots(), [=] RIVEN_KERNEL(long n) {
    Real* to = again + 4 * n;
    if (!(mass[n] > least)) {
      to[0] = to[1] = 0;
      return;
    }
    const Real inverse = Real(1) / mass[n], vx = q[4 * n], vy = q[4 * n + 1];
    const Real fx = vx - dt * q[4 * n + 2], fy = vy - dt * q[4 * n + 3];  // before the update
    to[0] *= inverse;
    to[1] *= inverse;
    const bool by_grid = flagged && (n >= nodes || flagged[n] >= 0);
    to[2] = by_grid ? Real(0.5) * vx + slowed * fx : Real(0.5) * (to[0] + fx);
    to[3] = by_grid ? Real(0.5) * vy + slowed * fy : Real(0.5) * (to[1] + fy);
  });
}

namespace {

/// What one slot of a node at x adds.
template <class Real>
struct SlotSums {
  const Real *mass, *q;
  double dt, damping;

  RIVEN_FN GridSums operator()(long slot, Vec2 x) const {
    GridSums g;
    const double m = mass[slot];
    if (!(m > 0))
      return g;
    const Vec2 after{q[4 * slot], q[4 * slot + 1]}, a{q[4 * slot + 2], q[4 * slot + 3]};
    const Vec2 before = after - dt * a;
    g.mass = m;
    g.momentum = 0.5 * m * (before + after);
    g.moment = m * x;
    g.damping_impulse = -damping * dt * m * before;
    g.damping_work = -0.5 * dot(g.damping_impulse, before + after);
    g.damping_torque = cross(x, g.damping_impulse);
    return g;
  }
};

}  // namespace

template <class Real>
GridSums grid_sums(const exec::Space& space, const State<Real, 2>& s, double damping) {
  const SlotSums<Real> one{exec::data(s.grid.mass), exec::data(s.grid.q), s.clock.dt, damping};
  const Lattice lattice = s.grid.lattice;
  GridSums sums = exec::parallel_reduce<GridSums>(space, "grid sums", lattice.nodes(), [=] RIVEN_KERNEL(long n) {
    return one(n, lattice.position(static_cast<int>(n)));
  });
  const FieldSlots slots(s.fields, lattice.nodes());
  const NodeCracks* flagged = exec::data(s.fields.nodes);
  sums +=
      exec::parallel_sum<GridSums>(space, "grid sums", s.fields.nodes.size(), [=] RIVEN_KERNEL(long n, GridSums& sum) {
        const int node = flagged[n].node;
        for (int f = 1; f < slots.count(node); ++f)
          sum += one(slots.of(node, f), lattice.position(node));
      });
  if (damping == 0)
    return sums;
  // Damping acted on what grips had made of velocities, which they hand to the accelerations later.
  const Constraint* list = exec::data(s.constraints.list);
  const Vec2* change = exec::data(s.constraints.change[0]);
  const int first_grip = s.constraints.first_grip();
  sums += exec::parallel_sum<GridSums>(
      space, "grid sums", s.constraints.list.size(), [=] RIVEN_KERNEL(long n, GridSums& sum) {
        const Constraint& c = list[n];
        const Vec2 carried{c.owner[0] >= first_grip ? change[n].x : 0, c.owner[1] >= first_grip ? change[n].y : 0};
        const Vec2 more = -one.damping * one.dt * carried;
        const Real* q = one.q + 4L * c.slot;
        sum.damping_impulse += more;
        sum.damping_work -= dot(more, Vec2{q[0], q[1]} - 0.5 * one.dt * Vec2{q[2], q[3]});
        sum.damping_torque += cross(lattice.position(c.node), more);
      });
  return sums;
}

#define RIVEN_ADVANCE_GRID(Real)                                                            \
  template void momenta_to_velocities(const exec::Space&, State<Real, 2>&);                 \
  template void velocities_again(const exec::Space&, const Plan&, double, State<Real, 2>&); \
  template void advance_grid(const exec::Space&, State<Real, 2>&, bool, double);            \
  template GridSums grid_sums(const exec::Space&, const State<Real, 2>&, double);
RIVEN_EACH_REAL(RIVEN_ADVANCE_GRID)
#undef RIVEN_ADVANCE_GRID

}  // namespace RIVEN_SIDE

}  // namespace riven
