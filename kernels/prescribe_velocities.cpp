#include "kernels/prescribe_velocities.hpp"

#include <utility>
#include <vector>

#include "core/exec/parallel.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/strain_shares.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

namespace {

/// What the owners of nodes gave to the body.
void book_impulses(const Lattice& lattice, const exec::Array<Constraint>& list, const exec::Array<Vec2>& impulse,
                   std::vector<ConstraintOwner>& owners) {
  for (long n = 0; n < list.size(); ++n) {
    const Vec2 x = lattice.position(list[n].node);
    for (int axis = 0; axis < 2; ++axis) {
      if (!(list[n].mask & (1u << axis)))
        continue;
      const Vec2 part = axis == 0 ? Vec2{impulse[n].x, 0} : Vec2{0, impulse[n].y};
      ConstraintOwner& o = owners[static_cast<size_t>(list[n].owner[axis])];
      o.impulse += part;
      o.torque_impulse += cross(x, part);
      o.work_now += (axis == 0 ? part.x : part.y) * 0.5 * (o.now[axis] + o.next[axis]);
    }
  }
}

}  // namespace

template <class Real>
void prescribe_velocities(const exec::Space& space, State<Real, 2>& s, Stage stage, double early_impulse) {
  Constraints& c = s.constraints;
  const int first_grip = c.first_grip();
  const Constraint* list = exec::data(std::as_const(c.list));
  const Vec2* velocity = exec::data(std::as_const(stage == Stage::before ? c.now : c.next));
  Vec2* impulse = exec::data(c.impulse);
  Vec2 *first = exec::data(c.change[0]),
       *noted = stage == Stage::term ? nullptr : exec::data(c.change[static_cast<int>(stage)]);
  const Real* mass = exec::data(std::as_const(s.grid.mass));
  Real* q = exec::data(stage == Stage::again ? s.grid.again : stage == Stage::term ? s.grid.next : s.grid.q);
  const bool momenta = stage == Stage::before || stage == Stage::again;
  const double inv_dt = 1 / s.clock.dt;
  exec::parallel_for(space, "prescribe velocities", c.list.size(), [=] RIVEN_KERNEL(long n) {
    const Constraint k = list[n];
    const double m = mass[k.slot];
    double given[2] = {0, 0}, changed[2] = {0, 0};
    for (int axis = 0; axis < 2 && m > 0; ++axis) {
      if (!(k.mask & (1u << axis)))
        continue;
      const Vec2 given_v = stage == Stage::term ? Vec2{} : velocity[k.owner[axis]];
      const double v = axis == 0 ? given_v.x : given_v.y, earlier = axis == 0 ? first[n].x : first[n].y;
      Real& value = q[4L * k.slot + axis];
      const double change = momenta ? m * v - value : m * (v - value);
      value = Real(momenta ? m * v : v);
      const bool carry = k.owner[axis] >= first_grip;
      if (stage == Stage::after)
        q[4L * k.slot + 2 + axis] += Real((change + (carry ? earlier : 0)) / m * inv_dt);
      changed[axis] = change;
      given[axis] = stage == Stage::before && !carry ? early_impulse * change : change;
    }
    if (noted)
      noted[n] = {changed[0], changed[1]};
    impulse[n] = {given[0], given[1]};
  });
  if (stage == Stage::again)
    return;  // changes strain rates only; no impulse reaches the particles
  book_impulses(s.grid.lattice, std::as_const(c.list), std::as_const(c.impulse), c.owners);
}

namespace {
/// What a component of a field of a node gains by prescribed motion, as field_impulses.hpp has it for contact.
struct Gain {
  double particles = 0, early = 0;  ///< J; the part that the transfer hands over
  RIVEN_FN Gain& operator+=(const Gain& o) {
    particles += o.particles;
    early += o.early;
    return *this;
  }
};

/// Of a component of a slot, given how its momentum changed at the stages of the step.
template <class Real>
struct Gains {
  const Real *mass, *q, *again;  ///< `again`: null without a second extrapolation
  StrainShares share;
  double dt, early_impulse;

  /// `resisted`: of contact, which gave the field as much the other way, and has booked that with the velocities in
  /// between as the grid has them (field_impulses.hpp).
  RIVEN_FN Gain operator()(long slot, int axis, double before, double now, double last, double resisted,
                           bool carry) const {
    const double m = mass[slot], v1 = q[4 * slot + axis], a = q[4 * slot + 2 + axis];
    const double given = now + (carry ? before : 0), early = carry ? 0 : early_impulse * before;
    const double v0 = v1 - dt * a - (carry ? 0 : before / m);
    const double v2 = again ? again[4 * slot + axis] - last / m : v0 + dt * a + early / m, mean = 0.5 * (v0 + v2);
    const double strains = share.by_first * before + share.by_last * last;
    const double on_grid = 0.5 * (v1 - dt * a + (again ? again[4 * slot + axis] : v1));
    return {(given + early) * mean + resisted * on_grid - (dt * a - given / m) * strains, early * mean};
  }
};

/// Books what prescribed motion took beyond the work of the reactions.
template <class Real>
void book_capture(const exec::Space& space, const Plan& plan, double early_impulse, const exec::Array<Vec2>& resisted,
                  State<Real, 2>& state) {
  const State<Real, 2>& s = state;
  const Constraints& c = s.constraints;
  const Gains<Real> gain{
      exec::data(s.grid.mass),    exec::data(s.grid.q), plan.extrapolate_again() ? exec::data(s.grid.again) : nullptr,
      strain_shares(plan.update), s.clock.dt,           early_impulse};
  const Constraint* list = exec::data(c.list);
  const Vec2 *before = exec::data(c.change[0]), *now = exec::data(c.change[1]), *last = exec::data(c.change[2]);
  const int first_grip = c.first_grip();
  const Vec2* held = resisted.empty() ? nullptr : exec::data(resisted);
  const Gain sum =
      exec::parallel_sum<Gain>(space, "boundary: capture", c.list.size(), [=] RIVEN_KERNEL(long n, Gain& all) {
        const Constraint k = list[n];
        if (!(gain.mass[k.slot] > 0))
          return;
        const Vec2 r = held ? held[k.slot] : Vec2{};
        if (k.mask & 1u)
          all += gain(k.slot, 0, before[n].x, now[n].x, last[n].x, r.x, k.owner[0] >= first_grip);
        if (k.mask & 2u)
          all += gain(k.slot, 1, before[n].y, now[n].y, last[n].y, r.y, k.owner[1] >= first_grip);
      });
  Energy& e = state.ledger.energy;
  e.transfer += sum.early;
  e.capture -= sum.particles;
  for (const ConstraintOwner& o : c.owners)
    e.capture += o.work_now;
}

}  // namespace

template <class Real>
void settle_constraints(const exec::Space& space, const Plan& plan, double early_impulse,
                        const exec::Array<Vec2>& resisted, State<Real, 2>& s) {
  Constraints& c = s.constraints;
  if (!resisted.empty()) {
    for (long n = 0; n < c.list.size(); ++n)
      c.impulse[n] = resisted[std::as_const(c.list)[n].slot];
    book_impulses(s.grid.lattice, std::as_const(c.list), std::as_const(c.impulse), c.owners);
  }
  book_capture(space, plan, early_impulse, resisted, s);
  for (ConstraintOwner& o : c.owners) {
    o.reaction = (1 / s.clock.dt) * o.impulse;
    o.mean.add(o.impulse, s.clock.dt);
    s.ledger.momentum.impulse += o.impulse;
    s.ledger.momentum.turn(o.torque_impulse);
    s.ledger.energy.external_work += o.work_now;
    o.work += o.work_now;
    o.impulse = {};
    o.torque_impulse = o.work_now = 0;
    o.travel += o.move(s.clock.dt);
  }
  for (GripBlock& g : c.grips)
    for (Vec2& p : g.points)
      p += c.owners[static_cast<size_t>(g.owner)].move(s.clock.dt);
}

#define RIVEN_PRESCRIBE_VELOCITIES(Real)                                                  \
  template void prescribe_velocities(const exec::Space&, State<Real, 2>&, Stage, double); \
  template void settle_constraints(const exec::Space&, const Plan&, double, const exec::Array<Vec2>&, State<Real, 2>&);
RIVEN_EACH_REAL(RIVEN_PRESCRIBE_VELOCITIES)
#undef RIVEN_PRESCRIBE_VELOCITIES

}  // namespace RIVEN_SIDE

}  // namespace riven
