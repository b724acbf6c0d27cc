// Scenes built in memory, and what tests read off their particles.
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/scene/names.hpp"
#include "kernels/simulation.hpp"

namespace riven::test {

/// E = 1 MPa, nu = 0.3, 1000 kg/m^3: sqrt(E / rho) = 31.6 m/s.
inline Material solid(LawKind law = LawKind::linear_elastic) {
  return {"solid", law, 1e6, 0.3, 1000};
}

inline Scene empty_scene(double cell, Rectangle grid, LawKind law = LawKind::linear_elastic) {
  Scene s;
  s.cell = cell;
  s.grid = grid;
  s.end_time = 1e3;
  s.thickness = 1;
  s.materials = {solid(law)};
  s.deterministic = true;
  return s;
}

inline Body body(const char* name, Region region) {
  Body b;
  b.name = name;
  b.region = region;
  return b;
}

inline CrackLine crack(const char* name, std::vector<Vec2> points) {
  CrackLine c;
  c.name = name;
  c.points = std::move(points);
  return c;
}

inline TimeFunction constant(double value) {
  return {value, {}, ""};
}

inline Grip grip_at_rest(const char* name, Region region) {
  Grip g;
  g.name = name;
  g.region = std::move(region);
  for (auto& v : g.velocity)
    v = constant(0);
  return g;
}

/// A traction on one side of what lies in the region, without a value.
inline Load traction_on(Load::Edge edge, Region region) {
  Load load;
  load.kind = Load::Kind::traction;
  load.edge = edge;
  load.region = std::move(region);
  return load;
}

/// A plate of 40 mm x 40 mm about the origin on cells of 1 mm, pulled up and down by 1 MPa until it rests: plane
/// stress, E = 3 GPa, nu = 0.3, 1200 kg/m^3.
inline Scene pulled_plate(CrackLine line, int contour) {
  Scene s = empty_scene(1e-3, {{-26e-3, -26e-3}, {26e-3, 26e-3}});
  s.materials = {{"plate", LawKind::linear_elastic, 3e9, 0.3, 1200}};
  s.thickness = 1e-3;
  s.plane = Plane::stress;
  s.transfer = Transfer::fmpm;
  s.order = 1;
  s.bodies = {body("plate", Rectangle{{-20e-3, -20e-3}, {20e-3, 20e-3}})};
  s.cracks = {std::move(line)};
  for (const bool top : {false, true}) {
    Load l =
        traction_on(top ? Load::Edge::top : Load::Edge::bottom,
                    top ? Rectangle{{-20e-3, 18e-3}, {20e-3, 20e-3}} : Rectangle{{-20e-3, -20e-3}, {20e-3, -18e-3}});
    l.name = top ? "top" : "bottom";
    l.value[1] =
        TimeFunction{top ? 1e6 : -1e6,
                     [](double t) { return t < 1e-4 ? 0.5 - 0.5 * std::cos(std::numbers::pi * t / 1e-4) : 1; }, ""};
    s.loads.push_back(l);
  }
  s.grid_damping = constant(6e4);
  s.end_time = 3e-4;
  s.fracture.asked = true;
  s.fracture.contour = contour;
  return s;
}

/// J/m^2 at the first tip, at the end of the run.
inline double last_J(const Scene& s, const exec::Space& space) {
  Simulation m(s, space);
  while (!m.finished())
    m.step();
  return m.state.tips[0].J;
}

/// Pa, the largest component over all particles (of bodies of `density`).
inline double largest_stress(const Simulation& m, double density) {
  double most = 0;
  for (const auto& component : m.state.particles.stress)
    for (const double s : component)
      most = std::max(most, std::abs(s));
  return density * most;
}

}  // namespace riven::test
