// A body that is pressed on fixed nodes along its edge stays where it is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/physics/scene_gates.hpp"
#include "tests/physics/scenes.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace test;

constexpr double side = 12, strain = 0.01;

/// A block pressed by `strain` towards one of its edges, lower or left, which a line of fixed nodes holds.
Scene block_on_line(bool left) {
  Scene s = empty_scene(1, {{-4, -4}, {side + 4, side + 4}});
  s.materials[0].nu = 0;
  s.bodies = {body("block", Rectangle{{0, 0}, {side, side}})};
  const int axis = left ? 0 : 1;
  FixedNodes line;
  line.name = "line";
  line.box = left ? Rectangle{{0, -4}, {0, side + 4}} : Rectangle{{-4, 0}, {side + 4, 0}};
  line.velocity[axis] = constant(0);
  s.fixed = {line};
  Load push = traction_on(left ? Load::Edge::right : Load::Edge::top,
                          left ? Rectangle{{side - 1, 0}, {side, side}} : Rectangle{{0, side - 1}, {side, side}});
  push.name = "push";
  push.value[axis] = TimeFunction{-strain * s.materials[0].E, [](double t) { return std::clamp(t / 3, 0., 1.); }, ""};
  s.loads = {push};
  s.grid_damping = constant(8);
  s.end_time = 18;
  return s;
}

// Each row bears the load. That at the edge is pushed out by a quarter of `strain` cells: past the line there is a row
// of nodes that it reaches with a weight of as little.
TEST(FixedNodes, BearABodyThatIsPressedOnThem) {
  const ChosenSpace space;
  for (const bool left : {false, true})
    for (const Transfer transfer : {Transfer::flip, Transfer::fmpm}) {
      Scene s = block_on_line(left);
      s.transfer = transfer;
      Simulation m(s, space);
      while (!m.finished())
        m.step();
      const auto& p = m.state.particles;
      const int axis = left ? 0 : 1;
      double most = 0;
      for (long i = 0; i < p.count(); ++i)
        if (p.x[axis][i] < side - 2)
          most =
              std::max(most, std::abs(p.stress[axis][i] * s.materials[0].density / (-strain * s.materials[0].E) - 1));
      gates::report("block pressed on a line of fixed nodes: stress over the load - 1, at most", most, "0.02");
      EXPECT_LT(most, 0.02) << left;
    }
}

}  // namespace
}  // namespace riven
