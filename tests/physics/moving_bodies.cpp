// Cracks that run in bodies that fly or spin. No crack knows of how its body moves as a whole, but for the forces by
// which a body that spins is held together.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/physics/scene_gates.hpp"
#include "tests/physics/scenes.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace test;

constexpr double mm = 1e-3, us = 1e-6, MPa = 1e6;

/// A crack 0.2 mm above the middle of a free plate that is pulled at both ends until it has been cut in two.
Scene flying_plate(Vec2 velocity) {
  Scene s = pulled_plate(crack("centre", {{-5 * mm, 0.2 * mm}, {5 * mm, 0.2 * mm}}), 4);
  s.transfer = Transfer::flip;
  s.grid_damping = {};
  s.bodies[0].velocity = velocity;
  for (Load& l : s.loads)
    l.value[1] =
        TimeFunction{l.name == "top" ? 10 * MPa : -10 * MPa, [](double t) { return std::min(1., t / (60 * us)); }, ""};
  s.growth = GrowthRule{};
  s.growth->toughness = 1e6;
  return s;
}

/// Where both tips leave the plate, as seen from it, and when.
struct Exit {
  double aside = 0;  ///< m, of the line of the crack, the larger one
  double time[2] = {};
};
Exit run_through(Vec2 velocity) {
  const Scene s = flying_plate(velocity);
  const ChosenSpace space;
  Simulation m(s, space);
  while (!m.finished() && (m.state.tips[0].open || m.state.tips[1].open))
    m.step();
  Exit found;
  for (const CrackEvent& e : m.state.events) {
    if (e.kind != CrackEvent::Kind::exit)
      continue;
    found.aside = std::max(found.aside, std::abs(e.place.y - velocity.y * e.time - 0.2 * mm));
    found.time[e.last] = e.time;
  }
  return found;
}

TEST(MovingBody, IsCutAsOneAtRest) {
  const Exit rest = run_through({});
  ASSERT_GT(std::min(rest.time[0], rest.time[1]), 0);
  for (const Vec2 velocity : {Vec2{0, 50}, Vec2{100, 0}}) {
    const Exit flies = run_through(velocity);
    const std::string speed = fmt::format("plate that flies at ({}, {}) m/s: ", velocity.x, velocity.y);
    gates::report(speed + "way of its crack off a straight one, mm", flies.aside / mm, "0.5");
    EXPECT_LT(flies.aside, 0.5 * mm);
    for (int end = 0; end < 2; ++end) {
      gates::report(speed + "time until it is cut over that of one at rest", flies.time[end] / rest.time[end],
                    "1 +- 0.04");
      EXPECT_NEAR(flies.time[end] / rest.time[end], 1, 0.04);
    }
  }
}

/// At the tips of a crack through the middle of a disk v^2/2 of the spin would make J of rho omega^2 r times the area
/// within the contour, 2700 J/m^2; at rest such a crack has 380 to 510 by its stress.
TEST(MovingBody, SpinsWithoutJOfItsVelocity) {
  constexpr double omega = 4500, density = 1200;
  Scene s = empty_scene(1 * mm, {{-26 * mm, -26 * mm}, {26 * mm, 26 * mm}});
  s.materials = {{"disk", LawKind::linear_elastic, 3e9, 0.33, density}};
  s.plane = Plane::stress;
  s.thickness = 1 * mm;
  s.transfer = Transfer::flip;
  s.bodies = {body("disk", Disk{{0, 0}, 20 * mm})};
  s.bodies[0].spin = omega;
  s.cracks = {crack("centre", {{-6 * mm, 0}, {6 * mm, 0}})};
  s.fracture.asked = true;
  s.fracture.contour = 4;
  s.growth = GrowthRule{};
  s.growth->toughness = 0.05e6;
  s.growth->direction = GrowthDirection::self_similar;
  s.growth->speed_limit = 50;
  s.end_time = 30 * us;
  const ChosenSpace space;
  Simulation m(s, space);
  double most = 0;
  while (!m.finished()) {
    m.step();
    for (const Tip& t : m.state.tips)
      if (t.running)
        most = std::max(most, t.J);
  }
  const double of_velocity = density * omega * omega * 7 * mm * (4 * mm) * (4 * mm);
  gates::report("J of a tip that runs in a disk that spins, over what v^2/2 of the spin makes", most / of_velocity,
                "less than 0.3");
  EXPECT_GT(most, 0);
  EXPECT_LT(most, 0.3 * of_velocity);
}

}  // namespace
}  // namespace riven
