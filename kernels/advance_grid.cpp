#include "kernels/advance_grid.hpp"

#include "core/exec/parallel.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/field_slots.hpp"

namespace riven {

GridSums& GridSums::operator+=(const GridSums& o) {
  mass += o.mass;
  momentum += o.momentum;
  moment += o.moment;
  damping_work += o.damping_work;
  damping_impulse += o.damping_impulse;
  damping_torque += o.damping_torque;
  return *this;
}

template <class Real>
void momenta_to_velocities(const exec::Space& space, State<Real, 2>& s, Real* q) {
  const Real* mass = s.grid.mass.data();
  const Real least = Real(mass_cutoff(s));
  exec::parallel_for(space, "momenta to velocities", s.grid.slots(), [=](long n) {
    const Real inverse = mass[n] > least ? Real(1) / mass[n] : Real(0);
    q[4 * n] *= inverse;
    q[4 * n + 1] *= inverse;
  });
}

template <class Real>
void advance_grid(const exec::Space& space, State<Real, 2>& s, bool from_velocity, double damping) {
  const Real* mass = s.grid.mass.data();
  Real* q = s.grid.q.data();
  const Real least = Real(mass_cutoff(s)), dt = Real(s.clock.dt), kappa = Real(damping);
  with_flag(from_velocity, [&](auto has_velocity) {
    exec::parallel_for(space, "advance grid", s.grid.slots(), [=](long n) {
      const Real inverse = mass[n] > least ? Real(1) / mass[n] : Real(0);
      const Real scale = decltype(has_velocity)::value ? Real(1) : inverse;
      const Real vx = q[4 * n] * scale, vy = q[4 * n + 1] * scale;
      const Real ax = q[4 * n + 2] * inverse - kappa * vx, ay = q[4 * n + 3] * inverse - kappa * vy;
      q[4 * n] = vx + ax * dt;
      q[4 * n + 1] = vy + ay * dt;
      q[4 * n + 2] = ax;
      q[4 * n + 3] = ay;
    });
  });
}

template <class Real>
GridSums grid_sums(const exec::Space& space, const State<Real, 2>& s, double damping) {
  const Real *mass = s.grid.mass.data(), *q = s.grid.q.data();
  const Lattice lattice = s.grid.lattice;
  const double dt = s.clock.dt;
  const int nodes = lattice.nodes();
  const auto one = [=](long slot, Vec2 x) {
    GridSums g;
    const double m = mass[slot];
    const Vec2 after{q[4 * slot], q[4 * slot + 1]}, a{q[4 * slot + 2], q[4 * slot + 3]};
    const Vec2 before = after - dt * a;
    g.mass = m;
    g.momentum = 0.5 * m * (before + after);
    g.moment = m * x;
    g.damping_impulse = -damping * dt * m * before;
    g.damping_work = -0.5 * dot(g.damping_impulse, before + after);
    g.damping_torque = cross(x, g.damping_impulse);
    return g;
  };
  GridSums sums = exec::parallel_reduce<GridSums>(space, "grid sums", nodes, [=](long n) {
    return mass[n] > 0 ? one(n, lattice.position(static_cast<int>(n))) : GridSums{};
  });
  const FieldSlots slots(s.fields, nodes);
  for (const NodeCracks& c : s.fields.nodes)
    for (int f = 1; f < slots.count(c.node); ++f)
      if (mass[slots.of(c.node, f)] > 0)
        sums += one(slots.of(c.node, f), lattice.position(c.node));
  // Damping acted on what grips had made of velocities, which they hand to the accelerations later.
  const Constraints& c = s.constraints;
  for (long n = 0; n < c.list.size() && damping != 0; ++n)
    for (int f = 0; f < slots.count(c.list[n].node); ++f) {
      const long slot = slots.of(c.list[n].node, f);
      const auto carried = [&](int axis) {
        return c.list[n].owner[axis] >= c.first_grip() ? c.change[0][slots.component(n, f, axis)] : 0;
      };
      const Vec2 more = -damping * dt * Vec2{carried(0), carried(1)};
      const Vec2 after{q[4 * slot], q[4 * slot + 1]}, a{q[4 * slot + 2], q[4 * slot + 3]};
      sums.damping_impulse += more;
      sums.damping_work -= dot(more, after - 0.5 * dt * a);
      sums.damping_torque += cross(lattice.position(c.list[n].node), more);
    }
  return sums;
}

#define RIVEN_ADVANCE_GRID(Real)                                                   \
  template void momenta_to_velocities(const exec::Space&, State<Real, 2>&, Real*); \
  template void advance_grid(const exec::Space&, State<Real, 2>&, bool, double);   \
  template GridSums grid_sums(const exec::Space&, const State<Real, 2>&, double);
RIVEN_EACH_REAL(RIVEN_ADVANCE_GRID)
#undef RIVEN_ADVANCE_GRID

}  // namespace riven
