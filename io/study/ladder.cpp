#include "io/study/ladder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/laws/elastic.hpp"
#include "core/plan/predict_memory.hpp"
#include "io/check_scene.hpp"
#include "io/format_length.hpp"

namespace riven::study {

namespace {

constexpr double on_line = 1e-6;  ///< of a cell

bool whole(double number) {
  return std::abs(number - std::round(number)) < on_line;
}

/// Do the edges of a rectangle lie between particles?
bool fits(const Region& region, int per_cell, const Scene& s) {
  const auto* box = std::get_if<Rectangle>(&region);
  if (!box)
    return true;
  const double d = s.cell / per_cell;
  const Vec2 low = (box->lower - s.grid.lower) * (1 / d), size = (box->upper - box->lower) * (1 / d);
  return whole(low.x) && whole(low.y) && whole(size.x) && whole(size.y) && size.x > 0.5 && size.y > 0.5;
}

/// The grid of `cell` around the scene's, with a line through the corner of the first body.
Rectangle grid_of(const Scene& s, double cell) {
  const Vec2 corner = bounds(s.bodies.front().region).lower;
  const auto low = [&](double line, double wall) { return line - cell * std::ceil((line - wall) / cell - on_line); };
  const auto high = [&](double from, double wall) { return from + cell * std::ceil((wall - from) / cell - on_line); };
  Rectangle g;
  g.lower = {low(corner.x, s.grid.lower.x), low(corner.y, s.grid.lower.y)};
  g.upper = {high(g.lower.x, s.grid.upper.x), high(g.lower.y, s.grid.upper.y)};
  return g;
}

bool can_be_run(const Scene& s) {
  for (const Body& b : s.bodies)
    if (!fits(b.region, b.particles_per_cell, s))
      return false;
  for (const Grip& g : s.grips)
    if (!fits(g.region, g.particles_per_cell, s))
      return false;
  try {
    check_scene(s);
    make_plan(s);
    return true;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

double work_of(const Scene& s) {
  double fastest = 0;
  for (const Material& m : s.materials) {
    const Elasticity e = elasticity(m);
    fastest = std::max(fastest, std::sqrt(e.lambda + 2 * e.mu));
  }
  return predict_memory(s, make_plan(s)).particles * s.end_time * fastest / (s.cfl * s.cell);
}

std::vector<Rung> rungs(const Scene& scene) {
  std::vector<Rung> list;
  for (const double factor :
       {8., 6., 5., 4., 3., 2.5, 2., 1.5, 1.25, 1., 0.8, 2. / 3, 0.5, 0.4, 1. / 3, 0.25, 0.2, 1. / 6, 0.125}) {
    Scene s = scene;
    s.cell = factor * scene.cell;
    s.grid = grid_of(scene, s.cell);
    if (!can_be_run(s))
      continue;
    Rung r{s.cell, {"grid.cell=" + format_length(s.cell, 12)}, work_of(s)};
    r.set.push_back(fmt::format("grid.lower=[\"{:.12g} m\", \"{:.12g} m\"]", s.grid.lower.x, s.grid.lower.y));
    r.set.push_back(fmt::format("grid.upper=[\"{:.12g} m\", \"{:.12g} m\"]", s.grid.upper.x, s.grid.upper.y));
    list.push_back(std::move(r));
  }
  return list;
}

}  // namespace riven::study
