// A crack along a strip of rubber between clamps that are drawn apart far. Behind the tip the strip is slack, ahead it
// is stretched by lambda without contraction along it: as the crack grows, the release is that of the strip ahead,
//   J = 2 H W(lambda),
// at any stretch (R.S. Rivlin and A.G. Thomas, J. Polym. Sci. 10 (1953) 291-318), by the first area of the crack.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "tests/physics/scene_gates.hpp"
#include "tests/physics/strip.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace test;

constexpr double E = 30e6, nu = 0.4, ramp = 0.5e-3, mm = Strip::mm;

/// Its right end does not contract either. Stretched to `stretch` in 0.5 ms; the crack runs half a cell beside the
/// middle of the strip.
Scene soft_strip(double stretch, double tip, double toughness) {
  const double speed = (stretch - 1) * Strip::H / ramp;
  Scene s = Strip::scene(tip, toughness, {speed, [](double t) { return t < ramp ? 1. : 0.; }, ""});
  s.grid = {{-8 * mm, -22 * mm}, {Strip::length + 8 * mm, 22 * mm}};
  s.plane = Plane::strain;
  s.order = 2;
  s.materials[0] = {"rubber", LawKind::neo_hookean, E, nu, 100};
  s.bodies[0].particles_per_cell = 4;
  s.grid_damping = constant(8e3);
  FixedNodes end;
  end.name = "end";
  end.box = {{Strip::length, -22 * mm}, {Strip::length, 22 * mm}};
  end.velocity[0] = constant(0);
  s.fixed = {end};
  for (Vec2& point : s.cracks[0].points)
    point.y = 0.5 * mm;
  return s;
}

double energy_ahead(double stretch) {
  const double mu = E / (2 * (1 + nu)), lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), square = stretch * stretch;
  return (0.5 * mu + 0.25 * lambda) * (square - 1) - (mu + 0.5 * lambda) * std::log(stretch);
}

/// Strains turn the faces behind the blunt tip by more than what makes a bend.
TEST(SoftStrip, HasTheJOfItsStretch) {
  constexpr double stretch = 1.15;
  Scene s = soft_strip(stretch, 30 * mm, 1);
  s.end_time = 1.6 * ramp;
  s.growth.reset();
  s.fracture.asked = true;
  s.fracture.contour = 8;
  s.readings.push_back({"near", s.fracture});
  s.readings[0].rules.contour = 4;
  const ChosenSpace space;
  Simulation m(s, space);
  while (!m.finished())
    m.step();
  const double J = 2 * Strip::H * energy_ahead(stretch);
  for (const auto& [contour, tip] : {std::pair{8, m.state.tips[0]}, std::pair{4, m.state.readings[0][0]}}) {
    gates::report(fmt::format("strip stretched by 1.15, J by {} cells over that of the strip ahead", contour),
                  tip.J / J, "1 +- 0.05");
    EXPECT_NEAR(tip.J, J, 0.05 * J);
  }
}

/// With small particles, too, of which there is none within two of their first sizes ahead of the tip. (Beyond a
/// release of 0.35 E times a cell its modes no longer say which way is straight on.)
TEST(SoftStrip, IsTornToItsEnd) {
  using enum GrowthDirection;
  for (const auto& [toughness, direction] :
       {std::pair{8e3, hoop}, std::pair{10e3, hoop}, std::pair{12e3, self_similar}}) {
    Scene s = soft_strip(1.15, 20 * mm, toughness);
    s.growth->direction = direction;
    const ChosenSpace space;
    Simulation m(s, space);
    while (m.state.clock.time < 3 * ramp && m.state.tips[0].open)
      m.step();
    ASSERT_FALSE(m.state.events.empty());
    const CrackEvent& last = m.state.events.back();
    EXPECT_EQ(last.kind, CrackEvent::Kind::exit) << toughness;
    EXPECT_GT(last.place.x, Strip::length - 3 * mm) << toughness;
  }
}

}  // namespace
}  // namespace riven
