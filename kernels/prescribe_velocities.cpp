#include "kernels/prescribe_velocities.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/exec/parallel.hpp"
#include "core/state/lay_points.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/field_slots.hpp"
#include "kernels/rigid_sight.hpp"
#include "kernels/strain_shares.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

namespace {

/// Adds a component of a node to those fixed, or hands it to a later owner.
void claim_node(std::vector<Constraint>& fixed, exec::Array<int>& at_node, int node, int axis, int owner) {
  int& at = at_node[node];
  if (at == 0) {
    fixed.push_back({node, node, 0, {-1, -1}});
    at = static_cast<int>(fixed.size());
  }
  Constraint& c = fixed[static_cast<size_t>(at - 1)];
  c.mask = static_cast<std::uint8_t>(c.mask | (1u << axis));
  c.owner[axis] = static_cast<std::int16_t>(owner);
}

/// The list of a step in the making. A node that is claimed gets an entry for each of its fields.
class FieldClaims {
 public:
  FieldClaims(const FieldSlots& slots, exec::Array<int>& at_node) : slots_(slots), at_node_(at_node) {}
  ~FieldClaims() {
    for (const Constraint& k : list_)
      at_node_[k.node] = 0;
  }

  /// The components of `mask`, of the fields whose bits are set.
  void claim(int node, unsigned fields, unsigned mask, int owner) {
    for (size_t at = first_of(node); fields != 0; fields >>= 1, ++at) {
      if (!(fields & 1u))
        continue;
      Constraint& c = list_[at];
      c.mask = static_cast<std::uint8_t>(c.mask | mask);
      for (int axis = 0; axis < 2; ++axis)
        if (mask & (1u << axis))
          c.owner[axis] = static_cast<std::int16_t>(owner);
    }
  }
  void claim_all(const Constraint& of) {
    const size_t first = first_of(of.node);
    for (size_t k = first; k < list_.size(); ++k)
      list_[k] = {of.node, list_[k].slot, of.mask, {of.owner[0], of.owner[1]}};
  }
  const std::vector<Constraint>& list() const { return list_; }

 private:
  size_t first_of(int node) {
    int& at = at_node_[node];
    if (at == 0) {
      at = static_cast<int>(list_.size()) + 1;
      for (int f = 0; f < slots_.count(node); ++f)
        list_.push_back({node, static_cast<int>(slots_.of(node, f)), 0, {-1, -1}});
    }
    return static_cast<size_t>(at - 1);
  }

  const FieldSlots slots_;
  exec::Array<int>& at_node_;
  std::vector<Constraint> list_;
};

/// Node numbers along one axis that lie in [lower, upper]; a range that touches a wall goes on behind it.
std::pair<int, int> node_range(const Lattice& l, int axis, double lower, double upper) {
  const double origin = axis == 0 ? l.origin.x : l.origin.y;
  int first = static_cast<int>(std::ceil((lower - origin) / l.h - 1e-6));
  int last = static_cast<int>(std::floor((upper - origin) / l.h + 1e-6));
  if (first <= l.wall_lower[axis])
    first = 0;
  if (last >= l.wall_upper[axis])
    last = (axis == 0 ? l.nx : l.ny) - 1;
  return {std::max(first, 0), std::min(last, (axis == 0 ? l.nx : l.ny) - 1)};
}

void claim_box(std::vector<Constraint>& fixed, exec::Array<int>& at_node, const Lattice& l, std::pair<int, int> x,
               std::pair<int, int> y, const ConstraintOwner& owner, int number) {
  for (int j = y.first; j <= y.second; ++j)
    for (int i = x.first; i <= x.second; ++i)
      for (int axis = 0; axis < 2; ++axis)
        if (owner.velocity[axis])
          claim_node(fixed, at_node, j * l.nx + i, axis, number);
}

/// The nodes on which a rigid particle has a weight of a hundredth or more along both axes. With less, those of the
/// next row move as the body has them: else it would be a cell shorter as soon as a grip is pushed into it, however
/// little. With a larger share left free, what a bar's stress loses at its ends where they move past grid lines would
/// be more than a per cent. Of a node near cracks only the field on the particle's side moves with it.
template <class Shape>
void claim_grip(FieldClaims& claims, const RigidSight& sight, const Lattice& l, const GripBlock& grip,
                const ConstraintOwner& owner) {
  constexpr double least = 0.01;
  AxisSetting<double> a{grip.half, 1 / (4 * grip.half), l.wall_lower[0], l.wall_upper[0]}, b = a;
  b.wall_lower = l.wall_lower[1];
  b.wall_upper = l.wall_upper[1];
  const unsigned mask = (owner.velocity[0] ? 1u : 0u) | (owner.velocity[1] ? 2u : 0u);
  for (const Vec2 p : grip.points) {
    const auto x = Shape::axis((p.x - l.origin.x) / l.h, a);
    const auto y = Shape::axis((p.y - l.origin.y) / l.h, b);
    for (int j = 0; j < Shape::width; ++j)
      for (int i = 0; i < Shape::width; ++i) {
        if (!(x.s[i] > least && y.s[j] > least))
          continue;
        const int node = (y.base + j) * l.nx + x.base + i;
        claims.claim(node, sight.fields_of(p, node), mask, grip.owner);
      }
  }
}

}  // namespace

template <class Real>
void make_constraints(const Scene& scene, State<Real, 2>& s) {
  Constraints& c = s.constraints;
  const Lattice& l = s.grid.lattice;
  c.at_node.resize(l.nodes());
  const auto add_owner = [&](std::string name, const std::optional<TimeFunction>* velocity) -> int {
    ConstraintOwner o;
    o.name = std::move(name);
    o.velocity[0] = velocity[0];
    o.velocity[1] = velocity[1];
    c.owners.push_back(std::move(o));
    return static_cast<int>(c.owners.size()) - 1;
  };
  int planes[2] = {0, 0};  // so far, across each axis
  const std::pair<int, int> all_x{0, l.nx - 1}, all_y{0, l.ny - 1};
  for (const SymmetryPlane& plane : scene.symmetry) {
    std::optional<TimeFunction> velocity[2];
    velocity[plane.axis] = TimeFunction{};
    std::string name = plane.axis == 0 ? "symmetry x" : "symmetry y";
    if (planes[plane.axis]++ > 0)
      name += " " + std::to_string(planes[plane.axis]);
    const int owner = add_owner(std::move(name), velocity);
    const auto at = node_range(l, plane.axis, plane.position, plane.position);
    auto behind =
        plane.solid > 0 ? std::pair{0, at.second} : std::pair{at.first, plane.axis == 0 ? l.nx - 1 : l.ny - 1};
    claim_box(c.fixed, c.at_node, l, plane.axis == 0 ? behind : all_x, plane.axis == 0 ? all_y : behind,
              c.owners.back(), owner);
  }
  for (const FixedNodes& f : scene.fixed) {
    const int owner = add_owner(f.name, f.velocity);
    claim_box(c.fixed, c.at_node, l, node_range(l, 0, f.box.lower.x, f.box.upper.x),
              node_range(l, 1, f.box.lower.y, f.box.upper.y), c.owners.back(), owner);
  }
  for (const Constraint& k : c.fixed)
    c.at_node[k.node] = 0;
  for (const Grip& g : scene.grips) {
    const int owner = add_owner(g.name, g.velocity);
    c.grips.push_back({owner, lay_points(g.region, {}, l, g.particles_per_cell), 0.5 / g.particles_per_cell});
  }
}

template <class Real>
void list_constraints(const Plan& plan, State<Real, 2>& s) {
  Constraints& c = s.constraints;
  for (ConstraintOwner& o : c.owners)
    for (int axis = 0; axis < 2; ++axis)
      if (o.velocity[axis]) {
        o.now[axis] = (*o.velocity[axis])(s.clock.time);
        o.next[axis] = (*o.velocity[axis])(s.clock.time + s.clock.dt);
      }
  c.now.resize(static_cast<long>(c.owners.size()));
  c.next.resize(c.now.size());
  for (long i = 0; i < c.now.size(); ++i) {
    const ConstraintOwner& o = c.owners[static_cast<size_t>(i)];
    c.now[i] = {o.now[0], o.now[1]};
    c.next[i] = {o.next[0], o.next[1]};
  }
  const Lattice& l = s.grid.lattice;
  FieldClaims claims(FieldSlots(s.fields, l.nodes()), c.at_node);
  for (const Constraint& k : c.fixed)
    claims.claim_all(k);
  const RigidSight sight(l, s.cracks, s.fields);
  with_shape(plan.shape, [&](auto shape) {
    for (const GripBlock& g : c.grips)
      claim_grip<typename decltype(shape)::type>(claims, sight, l, g, c.owners[static_cast<size_t>(g.owner)]);
  });
  c.list.resize(static_cast<long>(claims.list().size()));
  std::copy(claims.list().begin(), claims.list().end(), c.list.begin());
  c.impulse.resize(c.list.size());
  for (exec::Array<Vec2>& change : c.change) {
    change.resize(c.list.size());
    change.zero();
  }
}

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

  RIVEN_FN Gain operator()(long slot, int axis, double before, double now, double last, bool carry) const {
    const double m = mass[slot], v1 = q[4 * slot + axis], a = q[4 * slot + 2 + axis];
    const double given = now + (carry ? before : 0), early = carry ? 0 : early_impulse * before;
    const double v0 = v1 - dt * a - (carry ? 0 : before / m);
    const double v2 = again ? again[4 * slot + axis] - last / m : v0 + dt * a + early / m, mean = 0.5 * (v0 + v2);
    const double strains = share.by_first * before + share.by_last * last;
    return {(given + early) * mean - (dt * a - given / m) * strains, early * mean};
  }
};

/// Books what prescribed motion took beyond the work of the reactions.
template <class Real>
void book_capture(const exec::Space& space, const Plan& plan, double early_impulse, State<Real, 2>& state) {
  const State<Real, 2>& s = state;
  const Constraints& c = s.constraints;
  const Gains<Real> gain{
      exec::data(s.grid.mass),    exec::data(s.grid.q), plan.extrapolate_again() ? exec::data(s.grid.again) : nullptr,
      strain_shares(plan.update), s.clock.dt,           early_impulse};
  const Constraint* list = exec::data(c.list);
  const Vec2 *before = exec::data(c.change[0]), *now = exec::data(c.change[1]), *last = exec::data(c.change[2]);
  const int first_grip = c.first_grip();
  const Gain sum =
      exec::parallel_sum<Gain>(space, "boundary: capture", c.list.size(), [=] RIVEN_KERNEL(long n, Gain& all) {
        const Constraint k = list[n];
        if (!(gain.mass[k.slot] > 0))
          return;
        if (k.mask & 1u)
          all += gain(k.slot, 0, before[n].x, now[n].x, last[n].x, k.owner[0] >= first_grip);
        if (k.mask & 2u)
          all += gain(k.slot, 1, before[n].y, now[n].y, last[n].y, k.owner[1] >= first_grip);
      });
  Energy& e = state.ledger.energy;
  e.transfer += sum.early;
  e.capture -= sum.particles;
  for (const ConstraintOwner& o : c.owners)
    e.capture += o.work_now;
}

}  // namespace

template <class Real>
void settle_constraints(const exec::Space& space, const Plan& plan, double early_impulse, State<Real, 2>& s) {
  Constraints& c = s.constraints;
  book_capture(space, plan, early_impulse, s);
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
  template void make_constraints(const Scene&, State<Real, 2>&);                          \
  template void list_constraints(const Plan&, State<Real, 2>&);                           \
  template void prescribe_velocities(const exec::Space&, State<Real, 2>&, Stage, double); \
  template void settle_constraints(const exec::Space&, const Plan&, double, State<Real, 2>&);
RIVEN_EACH_REAL(RIVEN_PRESCRIBE_VELOCITIES)
#undef RIVEN_PRESCRIBE_VELOCITIES

}  // namespace RIVEN_SIDE

}  // namespace riven
