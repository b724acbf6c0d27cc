// Scenes built in memory, and what tests read off their particles.
#pragma once
#include <algorithm>
#include <cmath>
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

/// Pa, the largest component over all particles (of bodies of `density`).
inline double largest_stress(const Simulation& m, double density) {
  double most = 0;
  for (const auto& component : m.state.particles.stress)
    for (const double s : component)
      most = std::max(most, std::abs(s));
  return density * most;
}

}  // namespace riven::test
