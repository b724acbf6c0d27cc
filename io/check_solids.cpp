#include <algorithm>
#include <cmath>
#include <iterator>

#include "io/checks.hpp"

namespace riven::checks {

namespace {

constexpr double particle_bytes = 160;  // least that a particle costs
constexpr int path_samples = 1000;
constexpr double most_steps = 200;   // along an axis, to find a point in two bodies
constexpr size_t most_bodies = 100;  // compared with each other
constexpr size_t most_in_all = 256;  // particles know theirs by eight bits

bool inside(const Rectangle& inner, const Rectangle& outer, double slack) {
  return inner.lower.x >= outer.lower.x - slack && inner.lower.y >= outer.lower.y - slack &&
         inner.upper.x <= outer.upper.x + slack && inner.upper.y <= outer.upper.y + slack;
}

/// A body or grip: in the grid with every place that it is moved to, and large enough for a particle.
void check_solid(const Scene& s, const std::string& key, const Region& region, int per_cell, Vec2 low, Vec2 high) {
  const Rectangle box = bounds(region), swept{box.lower + low, box.upper + high};
  const double slack = on_line * s.cell;
  if (!inside(box, s.grid, slack))
    refuse(s, key, "the grid is too small: this lies outside it", text(box), text(s.grid), "a larger grid");
  if (!inside(swept, s.grid, slack))
    refuse(s, key, "the grid is too small: this moves out of it", text(swept), text(s.grid), "a larger grid");
  for (const SymmetryPlane& p : s.symmetry) {
    const double low_side = p.axis == 0 ? box.lower.x : box.lower.y,
                 high_side = p.axis == 0 ? box.upper.x : box.upper.y;
    if (p.solid > 0 ? low_side < p.position - slack : high_side > p.position + slack)
      refuse(s, key, "this lies beyond a symmetry plane", text(box),
             fmt::format("{} {} {}", p.axis == 0 ? "x" : "y", p.solid > 0 ? "at least" : "at most",
                         format_length(p.position, 9)),
             "only the part that is simulated");
  }
  const double spacing = s.cell / per_cell;
  const Vec2 size = box.upper - box.lower;
  if (std::min(size.x, size.y) < spacing * (1 - on_line))
    refuse(s, key, "too small to hold a particle", format_size(size),
           fmt::format("at least {}, the distance of particles", format_length(spacing)), "smaller cells");
  if (const auto* p = std::get_if<Polygon>(&region)) {
    double area = 0;
    for (size_t i = 0, j = p->points.size() - 1; i < p->points.size(); j = i++)
      area += 0.5 * cross(p->points[j], p->points[i]);
    if (!(std::abs(area) > 1e-9 * size.x * size.y))
      refuse(s, key, "the polygon has no area", text(box), "corners in order around it, not crossing");
  }
}

/// Least and greatest displacement of one component of a grip over the run, by the midpoint rule.
std::pair<double, double> path(const std::optional<TimeFunction>& velocity, double end) {
  double at = 0, low = 0, high = 0;
  if (!velocity)
    return {0, 0};
  const double dt = end / path_samples;
  for (int i = 0; i < path_samples; ++i) {
    at += dt * (*velocity)((i + 0.5) * dt);
    low = std::min(low, at);
    high = std::max(high, at);
  }
  return {low, high};
}

/// True when some point lies in both bodies, looked at every half cell where they may meet. Edges that they share, or
/// that overlap by as little as what points were rounded to, do not count.
bool overlap(const Scene& s, const Body& a, const Body& b) {
  const Rectangle p = bounds(a.region), q = bounds(b.region);
  const Vec2 low{std::max(p.lower.x, q.lower.x), std::max(p.lower.y, q.lower.y)};
  const Vec2 size = Vec2{std::min(p.upper.x, q.upper.x), std::min(p.upper.y, q.upper.y)} - low;
  if (size.x < on_line * s.cell || size.y < on_line * s.cell)
    return false;
  const auto steps = [&](double length) {
    return static_cast<int>(std::clamp(std::ceil(2 * length / s.cell), 2.0, most_steps));
  };
  const auto in = [](const Body& body, Vec2 x) {
    return contains(body.region, x) &&
           std::none_of(body.holes.begin(), body.holes.end(), [&](const Region& hole) { return contains(hole, x); });
  };
  const double aside = 0.01 * s.cell;
  const Vec2 about[] = {{0, 0}, {aside, 0}, {-aside, 0}, {0, aside}, {0, -aside}};
  const int nx = steps(size.x), ny = steps(size.y);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const Vec2 x = low + Vec2{size.x * (i + 0.5) / nx, size.y * (j + 0.5) / ny};
      if (std::all_of(std::begin(about), std::end(about), [&](Vec2 d) { return in(a, x + d) && in(b, x + d); }))
        return true;
    }
  return false;
}

void check_overlaps(const Scene& s) {
  for (size_t i = 0; i < s.bodies.size() && i < most_bodies; ++i)
    for (size_t j = 0; j < i; ++j)
      if (overlap(s, s.bodies[i], s.bodies[j]))
        refuse(s, "body " + s.bodies[i].name, "two bodies lie in the same place", s.bodies[j].name,
               "material once everywhere", "a hole in the one for the other");
}

void check_holes(const Scene& s, const Body& b) {
  for (const Region& hole : b.holes)
    if (!checks::overlap(bounds(hole), bounds(b.region)))
      refuse(s, "body " + b.name, "a hole lies outside its body", text(bounds(hole)), text(bounds(b.region)));
}

}  // namespace

Rectangle travel(const Scene& s, const Grip& g) {
  const auto [x0, x1] = path(g.velocity[0], s.end_time);
  const auto [y0, y1] = path(g.velocity[1], s.end_time);
  return {{x0, y0}, {x1, y1}};
}

void check_solids(const Scene& s) {
  if (s.bodies.empty())
    refuse(s, "body", "the scene has no body", "", "at least one [[body]]", "");
  if (s.bodies.size() > most_in_all)
    refuse(s, "body", "the scene has too many bodies", fmt::format("{}", s.bodies.size()),
           fmt::format("at most {}", most_in_all), "");
  double particles = 0;
  const auto count = [&](const Region& region, int per_cell) {
    const Vec2 size = bounds(region).upper - bounds(region).lower;
    particles += size.x * size.y * per_cell * per_cell / (s.cell * s.cell);
  };
  for (const Body& b : s.bodies) {
    check_solid(s, "body " + b.name, b.region, b.particles_per_cell, {}, {});
    check_holes(s, b);
    count(b.region, b.particles_per_cell);
  }
  for (const Grip& g : s.grips) {
    const Rectangle way = travel(s, g);
    check_solid(s, "grip " + g.name, g.region, g.particles_per_cell, way.lower, way.upper);
    count(g.region, g.particles_per_cell);
  }
  if (particles * particle_bytes > memory())
    refuse(s, "grid.cell", "there are too many particles", fmt::format("about {:.3g}", particles),
           fmt::format("at most {:.3g}, for the memory of this machine", memory() / particle_bytes),
           "larger cells or fewer particles_per_cell");
  check_overlaps(s);
}

}  // namespace riven::checks
