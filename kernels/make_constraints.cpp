#include "kernels/make_constraints.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/state/keep_off_cracks.hpp"
#include "core/state/lay_points.hpp"
#include "core/state/make_tips.hpp"

namespace riven {

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

/// Is there no body from x on for a cell along `way`?
bool is_void(const Scene& scene, Vec2 x, Vec2 way) {
  constexpr double rounding = 1e-6;  // cells: what lies on an edge is neither
  for (const double cells : {rounding, 0.25, 0.5, 0.75, 1.})
    if (body_at(scene, x + (cells * scene.cell) * way) >= 0)
      return false;
  return true;
}

/// Where a box of fixed nodes ends on the edge of a body, or within a cell of it, the row of nodes that follows is held
/// as the last one is. Particles that are pressed a little past that reach it, with next to no mass: left free, it
/// would take them out of the body, and the stress at its edge with them.
void claim_beyond_edge(std::vector<Constraint>& fixed, exec::Array<int>& at_node, const Lattice& l, const Scene& scene,
                       const FixedNodes& f, const std::pair<int, int> (&range)[2], int number) {
  for (int axis = 0; axis < 2; ++axis)
    for (const bool upper : {false, true}) {
      const int row = upper ? range[axis].second : range[axis].first, step = upper ? 1 : -1;
      if (!f.velocity[axis] || row + step < 0 || row + step >= (axis == 0 ? l.nx : l.ny))
        continue;
      const Vec2 out = axis == 0 ? Vec2{double(step), 0} : Vec2{0, double(step)};
      const auto& along = range[1 - axis];
      for (int k = along.first; k <= along.second; ++k) {
        const int i = axis == 0 ? row : k, j = axis == 0 ? k : row, next = axis == 0 ? step : step * l.nx;
        const int node = j * l.nx + i, beyond = node + next, at = at_node[beyond];
        const bool claimed = at != 0 && (fixed[static_cast<size_t>(at - 1)].mask & (1u << axis));
        const auto body_behind = [&](double cells) {
          return !is_void(scene, l.position(node) + (cells * l.h) * turned(out), -out);
        };
        // what is pressed spreads along the edge, past its ends
        if (!claimed && is_void(scene, l.position(node), out) && (body_behind(0) || body_behind(-1) || body_behind(1)))
          claim_node(fixed, at_node, beyond, axis, number);
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
  const auto nodes_of = [&](const FixedNodes& f, int axis) {
    return axis == 0 ? node_range(l, 0, f.box.lower.x, f.box.upper.x) : node_range(l, 1, f.box.lower.y, f.box.upper.y);
  };
  const int first_fixed = static_cast<int>(c.owners.size());
  for (const FixedNodes& f : scene.fixed) {
    const int owner = add_owner(f.name, f.velocity);
    claim_box(c.fixed, c.at_node, l, nodes_of(f, 0), nodes_of(f, 1), c.owners.back(), owner);
  }
  for (size_t k = 0; k < scene.fixed.size(); ++k)
    claim_beyond_edge(c.fixed, c.at_node, l, scene, scene.fixed[k],
                      {nodes_of(scene.fixed[k], 0), nodes_of(scene.fixed[k], 1)}, first_fixed + static_cast<int>(k));
  for (const Constraint& k : c.fixed)
    c.at_node[k.node] = 0;
  const KeepOffCracks keep_off(s.cracks, l);
  for (const Grip& g : scene.grips) {
    const int owner = add_owner(g.name, g.velocity);
    std::vector<Vec2> points = lay_points(g.region, {}, l, g.particles_per_cell);
    for (Vec2& x : points)
      x = keep_off.from(x, [&](Vec2 at) { return contains(g.region, at); });
    c.grips.push_back({owner, std::move(points), 0.5 / g.particles_per_cell});
  }
}

#define RIVEN_MAKE_CONSTRAINTS(Real) template void make_constraints(const Scene&, State<Real, 2>&);
RIVEN_EACH_REAL(RIVEN_MAKE_CONSTRAINTS)
#undef RIVEN_MAKE_CONSTRAINTS

}  // namespace riven
