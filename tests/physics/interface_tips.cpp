// Tips of cracks whose faces springs hold, and tips on the border of two solids.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/physics/strip.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace test;

/// A strip that is pulled to a strain of 1e-3 in 30 us, and comes to rest.
Scene pulled_strip() {
  Scene s =
      Strip::scene(30 * Strip::mm, 1, {1e-3 * Strip::H / 20e-6, [](double t) { return t < 20e-6 ? 1. : 0.; }, ""});
  s.growth.reset();
  s.fracture.asked = true;
  s.grid_damping = constant(6e4);
  return s;
}

// With springs D behind the tip, the strip there holds energy as well: with C = 2 H (1 - nu^2) / E,
//   J = delta^2 / 2 [1/C - 1/(C + 1/D)],   delta the way of the clamps from each other,
// whatever the contour. Jumps at the nodes tell delta behind the tip to 2 %.
TEST(InterfaceTip, ReleasesWhatItsSpringsDoNotHold) {
  for (const double ratio : {1., 3.})
    for (const int contour : {4, 8}) {
      const double C = 2 * Strip::H * (1 - Strip::nu * Strip::nu) / Strip::E, D = ratio / C;
      Scene s = pulled_strip();
      s.contact = {ContactLaw::interface, 0, D, D};
      s.fracture.contour = contour;
      s.output.history_every = 1e-6;
      s.end_time = 250e-6;
      const ChosenSpace space;
      Simulation m(s, space);
      while (!m.finished())
        m.step();
      const double delta = 2 * Strip::strain(m) * Strip::H, J = 0.5 * delta * delta * (1 / C - 1 / (C + 1 / D));
      EXPECT_NEAR(m.state.tips[0].J / J, 1, 0.06) << ratio << ", contour " << contour;
    }
}

/// A strip of two solids that differ in toughness alone, on either side of a crack.
Scene welded_strip(double below, double above, bool below_first) {
  Scene s = Strip::scene(30 * Strip::mm, 0, {1.2 * Strip::H * 1e-3 / 20e-6, {}, ""});
  s.materials = {s.materials[0], s.materials[0]};
  s.materials[0].J_Ic = below;
  s.materials[1].J_Ic = above;
  s.bodies = {body("below", Rectangle{{0, -Strip::H}, {Strip::length, 0}}),
              body("above", Rectangle{{0, 0}, {Strip::length, Strip::H}})};
  s.bodies[1].material = 1;
  if (!below_first)
    std::swap(s.bodies[0], s.bodies[1]);
  s.growth->direction = GrowthDirection::self_similar;
  return s;
}

TEST(BorderTip, GrowsByTheLesserToughnessWhateverTheOrderOfBodies) {
  std::vector<double> lengths;
  for (const bool below_first : {true, false})
    for (const bool weak_below : {true, false}) {
      const Scene s = welded_strip(weak_below ? 20 : 2000, weak_below ? 2000 : 20, below_first);
      const ChosenSpace space;
      Simulation m(s, space);
      while (m.state.clock.time < 60e-6) {
        m.step();
        ASSERT_EQ(s.materials[static_cast<size_t>(m.state.tips[0].material)].J_Ic, 20);
      }
      lengths.push_back(m.state.tips[0].length);
    }
  EXPECT_GT(lengths[0], 5 * Strip::mm);
  for (const double length : lengths)
    EXPECT_NEAR(length, lengths[0], 1.5 * Strip::mm);
}

}  // namespace
}  // namespace riven
