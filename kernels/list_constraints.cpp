#include "kernels/list_constraints.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "kernels/dispatch.hpp"
#include "kernels/field_slots.hpp"
#include "kernels/rigid_sight.hpp"

namespace riven {

namespace {

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
  unsigned all_of(int node) const { return (1u << slots_.count(node)) - 1; }
  /// Those of a node's fields that have less mass than `most`, kg.
  template <class Real>
  unsigned light_of(int node, const exec::Array<Real>& mass, double most) const {
    unsigned fields = 0;
    for (int f = 0; f < slots_.count(node); ++f)
      fields |= (mass[slots_.of(node, f)] < most ? 1u : 0u) << f;
    return fields;
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

/// The fields of a node that a box of fixed nodes holds: those on the sides of cracks on which it lies, within reach of
/// a particle and not all but on a crack; none for a line along a crack, or a point on it.
unsigned fields_in_box(const RigidSight& sight, const Lattice& l, const Rectangle& box, int node) {
  const double reach = 1.2 * l.h, near = 0.3 * l.h;
  const Vec2 x = l.position(node);
  unsigned fields = 0;
  for (const Vec2 step : {Vec2{reach, 0}, Vec2{-reach, 0}, Vec2{0, reach}, Vec2{0, -reach}}) {
    const Vec2 p{std::clamp(x.x + step.x, std::min(x.x, box.lower.x), std::max(x.x, box.upper.x)),
                 std::clamp(x.y + step.y, std::min(x.y, box.lower.y), std::max(x.y, box.upper.y))};
    if (sight.distance_to_cracks(p, node) > near)
      fields |= sight.fields_of(p, nullptr, node);
  }
  return fields;
}

/// Planes of symmetry hold all fields of their nodes.
void claim_fixed(FieldClaims& claims, const RigidSight& sight, const Lattice& l, const Scene& scene,
                 const Constraint& fixed) {
  const int planes = static_cast<int>(scene.symmetry.size());
  for (int axis = 0; axis < 2; ++axis) {
    const unsigned mask = 1u << axis;
    const int owner = fixed.owner[axis];
    if (!(fixed.mask & mask))
      continue;
    unsigned fields = 0;
    if (owner >= planes && sight.sees_cracks(fixed.node))
      fields = fields_in_box(sight, l, scene.fixed[static_cast<size_t>(owner - planes)].box, fixed.node);
    claims.claim(fixed.node, fields == 0 ? claims.all_of(fixed.node) : fields, mask, owner);
  }
}

/// The nodes on which a rigid particle has a weight of a hundredth or more along both axes. With less, those of the
/// next row move as the body has them: else it would be a cell shorter as soon as a grip is pushed into it, however
/// little. With a larger share left free, what a bar's stress loses at its ends where they move past grid lines would
/// be more than a per cent. Of a node near cracks only the field on the particle's side moves with it, and that with
/// any weight that is a hundredth of the field's own: all that it holds may be the next to nothing of a body that the
/// grip covers, whose particles it would strain by what meets them across the crack.
template <class Shape, class Real>
void claim_grip(FieldClaims& claims, const RigidSight& sight, const State<Real, 2>& s, const GripBlock& grip,
                const ConstraintOwner& owner) {
  constexpr double least = 0.01;
  const Lattice& l = s.grid.lattice;
  AxisSetting<double> a{grip.half, 1 / (4 * grip.half), l.wall_lower[0], l.wall_upper[0]}, b = a;
  b.wall_lower = l.wall_lower[1];
  b.wall_upper = l.wall_upper[1];
  const unsigned mask = (owner.velocity[0] ? 1u : 0u) | (owner.velocity[1] ? 2u : 0u);
  for (const Vec2 p : grip.points) {
    const Vec2 first = p - owner.travel;
    const auto x = Shape::axis((p.x - l.origin.x) / l.h, a);
    const auto y = Shape::axis((p.y - l.origin.y) / l.h, b);
    for (int j = 0; j < Shape::width; ++j)
      for (int i = 0; i < Shape::width; ++i) {
        const int node = (y.base + j) * l.nx + x.base + i;
        const double weight = x.s[i] * y.s[j];
        const bool weighs = x.s[i] > least && y.s[j] > least;
        if (!weighs && (!(weight > 0) || !sight.sees_cracks(node)))
          continue;
        unsigned fields = sight.fields_of(p, &first, node);
        if (!weighs)
          fields &= claims.light_of(node, s.grid.mass, weight * s.particle_mass / least);
        if (fields != 0 || weighs)
          claims.claim(node, fields, mask, grip.owner);
      }
  }
}

}  // namespace

template <class Real>
void list_constraints(const Scene& scene, const Plan& plan, State<Real, 2>& s) {
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
  const State<Real, 2>& state = s;
  const RigidSight sight(l, s.cracks, s.fields);
  FieldClaims claims(FieldSlots(s.fields, l.nodes()), c.at_node);
  for (const Constraint& k : c.fixed)
    claim_fixed(claims, sight, l, scene, k);
  with_shape(plan.shape, [&](auto shape) {
    for (const GripBlock& g : c.grips)
      claim_grip<typename decltype(shape)::type>(claims, sight, state, g, c.owners[static_cast<size_t>(g.owner)]);
  });
  c.list.resize(static_cast<long>(claims.list().size()));
  std::copy(claims.list().begin(), claims.list().end(), c.list.begin());
  c.impulse.resize(c.list.size());
  for (exec::Array<Vec2>& change : c.change) {
    change.resize(c.list.size());
    change.zero();
  }
}

void mark_prescribed(const Constraints& constraints, const CrackFields& fields, long slots, double early_impulse,
                     ContactSums& sums) {
  sums.early_impulse = early_impulse;
  const auto parted = [&](const Constraint& c) { return c.mask != 0 && fields.node_index[c.node] >= 0; };
  const exec::Array<Constraint>& list = constraints.list;
  const bool any = !fields.nodes.empty() && std::any_of(list.begin(), list.end(), parted);
  sums.prescribed.resize(any ? slots : 0);
  sums.prescribed.zero();
  sums.resisted.resize(any ? slots : 0);
  for (long n = 0; any && n < list.size(); ++n) {
    sums.resisted[list[n].slot] = {};
    if (parted(list[n]))
      sums.prescribed[list[n].slot] = list[n].mask;
  }
}

#define RIVEN_LIST_CONSTRAINTS(Real) template void list_constraints(const Scene&, const Plan&, State<Real, 2>&);
RIVEN_EACH_REAL(RIVEN_LIST_CONSTRAINTS)
#undef RIVEN_LIST_CONSTRAINTS

}  // namespace riven
