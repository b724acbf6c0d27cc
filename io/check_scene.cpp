#include "io/check_scene.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "io/checks.hpp"
#include "io/history_columns.hpp"

namespace riven {

using namespace checks;

namespace {

constexpr double node_bytes = 64;   // least that a node costs: mass, momentum and force, extra-field index
constexpr double most_cells = 2e9;  // node slots are numbered in 32 bits

template <class Part>
void check_names(const Scene& s, const std::vector<Part>& parts, const std::string& kind) {
  std::set<std::string> seen;
  for (const Part& p : parts)
    if (!seen.insert(p.name).second)
      refuse(s, kind + " " + p.name, fmt::format("two parts of kind {} have the same name", kind), p.name,
             "a name for each", "");
}

/// Probes stand in columns beside the quantities of the run.
void check_columns(const Scene& s) {
  for (const Probe& p : s.probes)
    if (is_quantity(p.name))
      refuse(s, "probe " + p.name, "history.csv has a column of this name already", p.name, "a name of its own",
             fmt::format("name = \"{}_1\"", p.name));
}

/// Results name grips and fixed nodes alike.
void check_owners(const Scene& s) {
  for (const FixedNodes& f : s.fixed)
    if (std::any_of(s.grips.begin(), s.grips.end(), [&](const Grip& g) { return g.name == f.name; }))
      refuse(s, "fix " + f.name, "a grip and a fix have the same name", f.name, "a name for each", "");
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

void check_symmetry(const Scene& s) {
  const Vec2 o = s.grid.lower;
  for (size_t i = 0; i < s.symmetry.size(); ++i) {
    const SymmetryPlane& p = s.symmetry[i];
    const double low = p.axis == 0 ? o.x : o.y, high = p.axis == 0 ? s.grid.upper.x : s.grid.upper.y;
    const double line = (p.position - low) / s.cell;
    if (std::abs(line - std::round(line)) > on_line || p.position < low - on_line * s.cell ||
        p.position > high + on_line * s.cell)
      refuse(
          s, fmt::format("symmetry {}", i), "the symmetry plane is not on a grid line", format_length(p.position, 9),
          fmt::format("{} + n * {}, up to {}", format_length(low, 9), format_length(s.cell, 9), format_length(high, 9)),
          fmt::format("position = \"{}\"", format_length(low + s.cell * std::round(line), 9)));
  }
}

void check_conditions(const Scene& s) {
  const Vec2 o = s.grid.lower;
  for (const FixedNodes& f : s.fixed) {
    const auto nodes = [&](double a, double b, double low, double high) {
      return std::floor((std::min(b, high) - low) / s.cell + on_line) >=
             std::ceil((std::max(a, low) - low) / s.cell - on_line);
    };
    if (!nodes(f.box.lower.x, f.box.upper.x, o.x, s.grid.upper.x) ||
        !nodes(f.box.lower.y, f.box.upper.y, o.y, s.grid.upper.y))
      refuse(s, "fix " + f.name, "no grid node lies in the box", text(f.box),
             fmt::format("nodes at {} + n * {}", text(o), format_length(s.cell)), "a box on a grid line");
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

/// Contact and the motion of cracks sum up m x^2, down to a millionth of a particle's mass, and single precision ends
/// at 1e-38.
void check_precision(const Scene& s) {
  constexpr double least = 1e-32;  // kg m^2
  for (const Body& b : s.bodies) {
    const double spacing = s.cell / b.particles_per_cell, thickness = b.thickness > 0 ? b.thickness : s.thickness;
    const double mass = s.materials[static_cast<size_t>(b.material)].density * spacing * spacing * thickness;
    if (s.precision == Precision::as_float && mass * s.cell * s.cell < least)
      refuse(s, "solver.precision", "particles of body " + b.name + " are too small for single precision",
             fmt::format("{:.2g} kg in cells of {}", mass, format_length(s.cell)),
             fmt::format("{:.2g} kg or more", least / (s.cell * s.cell)), "precision = \"double\"");
  }
}

}  // namespace

void check_scene(const Scene& s) {
  check_names(s, s.materials, "material");
  check_names(s, s.bodies, "body");
  check_names(s, s.grips, "grip");
  check_names(s, s.fixed, "fix");
  check_owners(s);
  check_names(s, s.loads, "load");
  check_names(s, s.cracks, "crack");
  check_names(s, s.probes, "probe");
  check_columns(s);
  check_grid(s);
  check_symmetry(s);
  check_solids(s);
  check_precision(s);
  check_conditions(s);
  check_cracks(s);
}

}  // namespace riven
