// Tractions that act where they are seldom meant to, on edges at an angle to the grid and in holes; and loads that
// nothing holds against.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "core/scene/area.hpp"
#include "io/checks.hpp"
#include "io/doubts.hpp"

namespace riven {

using namespace checks;

namespace {

/// A place on an edge, the unit vector out of what the edge surrounds, and the length that it stands for, m.
struct EdgePoint {
  Vec2 at, out;
  double length;
};

std::vector<EdgePoint> points_of_edge(const Polygon& polygon) {
  constexpr int per_side = 16;
  const std::vector<Vec2>& p = polygon.points;
  double twice_area = 0;
  for (size_t i = 0, j = p.size() - 1; i < p.size(); j = i++)
    twice_area += cross(p[j], p[i]);
  std::vector<EdgePoint> list;
  for (size_t i = 0, j = p.size() - 1; i < p.size(); j = i++) {
    const Vec2 along = p[i] - p[j], right = -(1 / norm(along)) * turned(along);
    for (int k = 0; k < per_side; ++k)
      list.push_back({p[j] + ((k + 0.5) / per_side) * along, twice_area > 0 ? right : -right, norm(along) / per_side});
  }
  return list;
}

std::vector<EdgePoint> points_of_edge(const Rectangle& r) {
  return points_of_edge(Polygon{{r.lower, {r.upper.x, r.lower.y}, r.upper, {r.lower.x, r.upper.y}}});
}

std::vector<EdgePoint> points_of_edge(const Disk& d) {
  constexpr int points = 128;
  std::vector<EdgePoint> list;
  for (int k = 0; k < points; ++k) {
    const double angle = 2 * std::numbers::pi * k / points;
    const Vec2 out{std::cos(angle), std::sin(angle)};
    list.push_back({d.center + d.radius * out, out, 2 * std::numbers::pi * d.radius / points});
  }
  return list;
}

std::vector<EdgePoint> edge_of(const Region& region) {
  return std::visit([](const auto& shape) { return points_of_edge(shape); }, region);
}

Vec2 side_of(Load::Edge edge) {
  switch (edge) {
    case Load::Edge::left: return {-1, 0};
    case Load::Edge::right: return {1, 0};
    case Load::Edge::bottom: return {0, -1};
    case Load::Edge::top: break;
  }
  return {0, 1};
}

/// Does an edge in the region of a traction face its side as wanted? By the cosine between the side and the normal out
/// of the solid, which is within the edge (`solid` = 1) or around it (-1).
template <class Wanted>
bool acts_on(const Load& load, const Region& region, double solid, const Wanted& wanted) {
  const std::vector<EdgePoint> edge = edge_of(region);
  return std::any_of(edge.begin(), edge.end(), [&](const EdgePoint& p) {
    return contains(load.region, p.at) && wanted(solid * dot(p.out, side_of(load.edge)));
  });
}

/// The force of a load at a time, about, N.
Vec2 resultant(const Scene& s, const Load& load, double t) {
  Vec2 sum;
  for (const int axis : {0, 1}) {
    double& all = axis == 0 ? sum.x : sum.y;
    if (load.kind == Load::Kind::force)
      all = load.value[axis].at(t, Places{{bounds(load.region).lower.x}, {bounds(load.region).lower.y}})[0];
    else
      for (const Body& b : s.bodies) {
        const double thickness = b.thickness > 0 ? b.thickness : s.thickness;
        for (const EdgePoint& p : edge_of(b.region))
          if (const double facing = dot(p.out, side_of(load.edge)); facing > 0 && contains(load.region, p.at))
            all += facing * p.length * thickness * load.value[axis].at(t, Places{{p.at.x}, {p.at.y}})[0];
      }
  }
  return sum;
}

bool is_held(const Scene& s, int axis) {
  const auto holds = [axis](const auto& part) { return part.velocity[axis].has_value(); };
  return std::any_of(s.grips.begin(), s.grips.end(), holds) || std::any_of(s.fixed.begin(), s.fixed.end(), holds) ||
         std::any_of(s.symmetry.begin(), s.symmetry.end(), [axis](const auto& plane) { return plane.axis == axis; });
}

/// How far the loads take the bodies all together along an axis, at most, m; none where they balance to a hundredth.
double drift(const Scene& s, int axis) {
  constexpr int moments = 64;
  double mass = 0;
  for (const Body& b : s.bodies)
    mass += area_of(b) * (b.thickness > 0 ? b.thickness : s.thickness) *
            s.materials[static_cast<size_t>(b.material)].density;
  const double dt = s.end_time / moments;
  double speed = 0, way = 0, farthest = 0, most = 0, most_of_each = 0;
  for (int n = 0; n < moments; ++n) {
    double force = 0, of_each = 0;
    for (const Load& load : s.loads) {
      const Vec2 f = resultant(s, load, (n + 0.5) * dt);
      force += axis == 0 ? f.x : f.y;
      of_each += std::fabs(axis == 0 ? f.x : f.y);
    }
    speed += force / mass * dt;
    way += speed * dt;
    farthest = std::max(farthest, std::fabs(way));
    most = std::max(most, std::fabs(force));
    most_of_each = std::max(most_of_each, of_each);
  }
  return most > 0.01 * most_of_each ? farthest : 0;
}

/// Loads that nothing holds against, and that do not balance.
void doubt_balance(const Scene& s, std::vector<Doubt>& list) {
  constexpr double cells = 2;
  const bool pushed = s.body_force[0] || s.body_force[1];
  if (s.loads.empty() || pushed || std::any_of(s.loads.begin(), s.loads.end(), [](const Load& load) {
        return load.kind == Load::Kind::acceleration;
      }))
    return;
  for (const int axis : {0, 1})
    if (const double way = is_held(s, axis) ? 0 : drift(s, axis); way > cells * s.cell)
      list.push_back(
          {place(s, "load " + s.loads[0].name),
           fmt::format("nothing holds the bodies along {}, and the loads do not balance: they would take them "
                       "{:.0f} cells away in the run",
                       axis == 0 ? "x" : "y", way / s.cell),
           "add a load that faces them, or a grip, fixed nodes or a symmetry plane"});
}

}  // namespace

void doubt_loads(const Scene& s, std::vector<Doubt>& list) {
  doubt_balance(s, list);
  for (const Load& load : s.loads) {
    if (load.kind != Load::Kind::traction)
      continue;
    for (const Body& b : s.bodies) {
      if (acts_on(load, b.region, 1, [](double facing) { return facing > 0.1 && facing < 0.99; }))
        list.push_back({place(s, "load " + load.name),
                        fmt::format("an edge of body {} lies at an angle to the grid, and bears the traction on its "
                                    "projection alone",
                                    b.name),
                        "try kind = \"force\", or the traction divided by the cosine of the angle"});
      if (std::any_of(b.holes.begin(), b.holes.end(), [&](const Region& hole) {
            return acts_on(load, hole, -1, [](double facing) { return facing > 0.1; });
          }))
        list.push_back({place(s, "load " + load.name),
                        fmt::format("the traction acts in a hole of body {}, too, whose edge is in its region", b.name),
                        "try a region that holds the outer edge alone"});
    }
  }
}

}  // namespace riven
