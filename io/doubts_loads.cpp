// Tractions that act where they are seldom meant to: on edges at an angle to the grid, and in holes.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "io/checks.hpp"
#include "io/doubts.hpp"

namespace riven {

using namespace checks;

namespace {

/// A place on an edge, and the unit vector out of what the edge surrounds.
struct EdgePoint {
  Vec2 at, out;
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
      list.push_back({p[j] + ((k + 0.5) / per_side) * along, twice_area > 0 ? right : -right});
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
    list.push_back({d.center + d.radius * out, out});
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

}  // namespace

void doubt_loads(const Scene& s, std::vector<Doubt>& list) {
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
