// A bar between two grips that pull it or push it together: its stress against that of a bar of its length.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "tests/physics/scene_gates.hpp"
#include "tests/physics/scenes.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace test;

constexpr double length = 20, height = 6;  // cells, each 1 m

/// Either end moves outwards by `way` (m) in 4 s, in which sound runs to and fro three times, and comes to rest.
Scene gripped_bar(double way) {
  Scene s = empty_scene(1, {{-6, -4}, {length + 6, height + 4}});
  s.materials[0].nu = 0;
  s.bodies = {body("bar", Rectangle{{0, 0}, {length, height}})};
  const auto shape = [](double t) { return t < 4 ? 0.25 * (1 - std::cos(0.5 * std::numbers::pi * t)) : 0; };
  for (const bool right : {false, true}) {
    Grip g;
    g.name = right ? "right" : "left";
    g.region = right ? Rectangle{{length, 0}, {length + 2, height}} : Rectangle{{-2, 0}, {0, height}};
    g.velocity[0] = TimeFunction{right ? way : -way, shape, ""};
    s.grips.push_back(g);
  }
  s.grid_damping = constant(5);
  s.end_time = 8;
  return s;
}

/// Of the stress in the middle third, relative to E ln(1 + 2 way / length).
double stress_error(double way) {
  const Scene s = gripped_bar(way);
  const ChosenSpace space;
  Simulation m(s, space);
  while (!m.finished())
    m.step();
  const auto& p = m.state.particles;
  double sum = 0;
  int count = 0;
  for (long i = 0; i < p.count(); ++i)
    if (std::abs(p.x[0][i] - length / 2) < length / 6) {
      sum += p.stress[0][i] * s.materials[0].density;
      ++count;
    }
  return sum / count / (s.materials[0].E * std::log1p(2 * way / length)) - 1;
}

// Of what a grip moves by past a grid line, the bar is longer, and softer, up to a tenth of a cell; beyond that it is
// shorter by what is left of the cell.
TEST(Grips, HoldABarAtItsEnds) {
  for (const auto& [way, limit] : {std::pair{0.01, 0.002}, {0.1, 0.02}, {0.3, 0.05}, {0.6, 0.05}})
    for (const double sign : {1., -1.}) {
      const double error = stress_error(sign * way);
      gates::report(fmt::format("bar of 20 cells between two grips that move {} cells {}: stress, less 1", way,
                                sign > 0 ? "apart" : "together"),
                    error, fmt::format("{}", limit));
      EXPECT_LT(std::abs(error), limit) << way;
    }
}

}  // namespace
}  // namespace riven
