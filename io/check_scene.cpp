#include "io/check_scene.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.hpp"

namespace riven {

namespace {

constexpr double on_line = 1e-6;        // of a cell: as near to a grid line as decimal input gets
constexpr double node_bytes = 64;       // least that a node costs: mass, momentum and force, extra-field index
constexpr double particle_bytes = 160;  // least that a particle costs
constexpr double most_cells = 2e9;      // node slots are numbered in 32 bits
constexpr int path_samples = 1000;

[[noreturn]] void refuse(const Scene& s, const std::string& key, std::string what, std::string value, std::string limit,
                         std::string hint = {}) {
  fail({Exit::bad_input, std::move(what), place(s, key), std::move(value), std::move(limit), std::move(hint)});
}

std::string text(Vec2 p) {
  return fmt::format("({:.6g}, {:.6g}) mm", 1e3 * p.x, 1e3 * p.y);
}
std::string text(const Rectangle& r) {
  return text(r.lower) + " to " + text(r.upper);
}

bool inside(const Rectangle& inner, const Rectangle& outer, double slack) {
  return inner.lower.x >= outer.lower.x - slack && inner.lower.y >= outer.lower.y - slack &&
         inner.upper.x <= outer.upper.x + slack && inner.upper.y <= outer.upper.y + slack;
}

bool overlap(const Rectangle& a, const Rectangle& b) {
  return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y && b.lower.y <= a.upper.y;
}

template <class Part>
void check_names(const Scene& s, const std::vector<Part>& parts, const std::string& kind) {
  std::set<std::string> seen;
  for (const Part& p : parts)
    if (!seen.insert(p.name).second)
      refuse(s, kind + " " + p.name, fmt::format("two parts of kind {} have the same name", kind), p.name,
             "a name for each", "");
}

double memory() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

void check_grid(const Scene& s) {
  const Vec2 size = s.grid.upper - s.grid.lower;
  if (!(size.x > 0 && size.y > 0))
    refuse(s, "grid.upper", "the grid has no area", text(s.grid), "upper greater than lower in x and y");
  const double nx = size.x / s.cell, ny = size.y / s.cell;
  if (!(nx * ny <= most_cells) || nx * ny * node_bytes > memory())
    refuse(s, "grid.cell", "the grid is too large", fmt::format("{:.4g} x {:.4g} cells", nx, ny),
           fmt::format("at most {:.4g} cells, for the memory of this machine",
                       std::min(most_cells, memory() / node_bytes)),
           "larger cells");
  for (const double n : {nx, ny})
    if (std::abs(n - std::round(n)) > on_line || n < 0.5)
      refuse(s, "grid.upper", "the grid is not a whole number of cells", fmt::format("{:.9g} x {:.9g} cells", nx, ny),
             "whole numbers",
             fmt::format("upper at {}", text(s.grid.lower + Vec2{s.cell * std::max(1.0, std::round(nx)),
                                                                 s.cell * std::max(1.0, std::round(ny))})));
  if (nx < 2.5 || ny < 2.5)
    refuse(s, "grid.upper", "the grid is too small", fmt::format("{:.0f} x {:.0f} cells", nx, ny),
           "at least 3 cells along each axis, the reach of the shape functions");
}

/// A body or grip: in the grid with every place that it is moved to, and large enough for a particle.
void check_solid(const Scene& s, const std::string& key, const Region& region, int per_cell, Vec2 low, Vec2 high) {
  const Rectangle box = bounds(region), swept{box.lower + low, box.upper + high};
  const double slack = on_line * s.cell;
  if (!inside(box, s.grid, slack))
    refuse(s, key, "the grid is too small: this lies outside it", text(box), text(s.grid), "a larger grid");
  if (!inside(swept, s.grid, slack))
    refuse(s, key, "the grid is too small: this moves out of it", text(swept), text(s.grid), "a larger grid");
  const double spacing = s.cell / per_cell;
  const Vec2 size = box.upper - box.lower;
  if (std::min(size.x, size.y) < spacing * (1 - on_line))
    refuse(s, key, "too small to hold a particle", fmt::format("{:.6g} x {:.6g} mm", 1e3 * size.x, 1e3 * size.y),
           fmt::format("at least {:.6g} mm, the distance of particles", 1e3 * spacing), "smaller cells");
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

void check_solids(const Scene& s) {
  if (s.bodies.empty())
    refuse(s, "body", "the scene has no body", "", "at least one [[body]]", "");
  double particles = 0;
  const auto count = [&](const Region& region, int per_cell) {
    const Vec2 size = bounds(region).upper - bounds(region).lower;
    particles += size.x * size.y * per_cell * per_cell / (s.cell * s.cell);
  };
  for (const Body& b : s.bodies) {
    check_solid(s, "body " + b.name, b.region, b.particles_per_cell, {}, {});
    count(b.region, b.particles_per_cell);
  }
  for (const Grip& g : s.grips) {
    const auto [x0, x1] = path(g.velocity[0], s.end_time);
    const auto [y0, y1] = path(g.velocity[1], s.end_time);
    check_solid(s, "grip " + g.name, g.region, g.particles_per_cell, {x0, y0}, {x1, y1});
    count(g.region, g.particles_per_cell);
  }
  if (particles * particle_bytes > memory())
    refuse(s, "grid.cell", "there are too many particles", fmt::format("about {:.3g}", particles),
           fmt::format("at most {:.3g}, for the memory of this machine", memory() / particle_bytes),
           "larger cells or fewer particles_per_cell");
}

void check_conditions(const Scene& s) {
  const Vec2 o = s.grid.lower;
  for (size_t i = 0; i < s.symmetry.size(); ++i) {
    const SymmetryPlane& p = s.symmetry[i];
    const double low = p.axis == 0 ? o.x : o.y, high = p.axis == 0 ? s.grid.upper.x : s.grid.upper.y;
    const double line = (p.position - low) / s.cell;
    if (std::abs(line - std::round(line)) > on_line || p.position < low - on_line * s.cell ||
        p.position > high + on_line * s.cell)
      refuse(s, fmt::format("symmetry {}", i), "the symmetry plane is not on a grid line",
             fmt::format("{:.9g} mm", 1e3 * p.position),
             fmt::format("{:.9g} mm + n * {:.9g} mm, up to {:.9g} mm", 1e3 * low, 1e3 * s.cell, 1e3 * high),
             fmt::format("position = \"{:.9g} mm\"", 1e3 * (low + s.cell * std::round(line))));
  }
  for (const FixedNodes& f : s.fixed) {
    const auto nodes = [&](double a, double b, double low, double high) {
      return std::floor((std::min(b, high) - low) / s.cell + on_line) >=
             std::ceil((std::max(a, low) - low) / s.cell - on_line);
    };
    if (!nodes(f.box.lower.x, f.box.upper.x, o.x, s.grid.upper.x) ||
        !nodes(f.box.lower.y, f.box.upper.y, o.y, s.grid.upper.y))
      refuse(s, "fix " + f.name, "no grid node lies in the box", text(f.box),
             fmt::format("nodes at {} + n * {:.6g} mm", text(o), 1e3 * s.cell), "a box on a grid line");
  }
  const auto near_body = [&](const Rectangle& box) {
    return std::any_of(s.bodies.begin(), s.bodies.end(), [&](const Body& b) { return overlap(bounds(b.region), box); });
  };
  for (const Load& load : s.loads)
    if (!near_body(bounds(load.region)))
      refuse(s, "load " + load.name, "the load lies on no body", text(bounds(load.region)),
             "a region that has particles");
  for (const Probe& p : s.probes) {
    const bool point =
        p.kind == Probe::Kind::displacement || p.kind == Probe::Kind::velocity || p.kind == Probe::Kind::stress;
    const Vec2 reach{s.cell, s.cell};
    if (point && !near_body({p.point - reach, p.point + reach}))
      refuse(s, "probe " + p.name, "the probe lies on no body", text(p.point), "a point in a body");
  }
}

}  // namespace

std::string place(const Scene& s, const std::string& key) {
  const auto found = s.places.find(key);
  return found != s.places.end() ? found->second : s.source_path.empty() ? key : s.source_path + ": " + key;
}

void check_scene(const Scene& s) {
  check_names(s, s.materials, "material");
  check_names(s, s.bodies, "body");
  check_names(s, s.grips, "grip");
  check_names(s, s.fixed, "fix");
  check_names(s, s.loads, "load");
  check_names(s, s.cracks, "crack");
  check_names(s, s.probes, "probe");
  check_grid(s);
  check_solids(s);
  check_conditions(s);
  check_cracks(s);
}

}  // namespace riven
