// J of a tip that has just turned: a slanted crack grows by one segment of half a cell in the direction of the greatest
// hoop stress and is then held.
//
// What the turned tip releases, over what the straight one did under the same load, is that of a crack with the same
// kink in a wide plate: for one of 0.127 mm, turned by 21.2 to 22.6 degrees, 1.032 to 1.036 by edge dislocations along
// the crack (pieces of 1 um at its ends; 0.001 from those of 2 um). The greatest hoop stress alone would say 1.08: the
// stress along a crack across the pull closes what turns out of its line.
#include <numbers>

#include "core/fracture/growth.hpp"
#include "tests/physics/plates.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace gates;

constexpr double mm = 1e-3, pull = 0.4e-3;

/// The slanted crack of the ten that grows first when they are pulled slowly, alone in a plate around it. Its far end
/// stays.
Scene plate_with_slanted_crack() {
  Scene s = shipped("ten_cracks");
  const double h = s.cell = 0.254 * mm;
  const double left = 48 * h, right = 144 * h, bottom = 45 * h, top = 141 * h;
  s.grid = {{left - 12 * h, bottom - 12 * h}, {right + 12 * h, top + 12 * h}};
  s.bodies[0].region = Rectangle{{left, bottom}, {right, top}};
  s.grips[0].region = Rectangle{{left, top}, {right, top + h}};
  s.grips[1].region = Rectangle{{left, bottom - h}, {right, bottom}};
  for (const int k : {0, 1}) {
    const auto shape = [](double t) { return std::sin(std::numbers::pi * std::min(t, pull) / pull); };
    s.grips[static_cast<size_t>(k)].velocity[1] = TimeFunction{k == 0 ? 0.5 : -0.5, shape, ""};
  }
  s.grid_damping = TimeFunction{20e3, [](double t) { return t > pull ? 1. : 0.; }, ""};  // 1/s
  CrackLine crack = s.cracks[5];
  crack.points = {{27.616 * mm, 24.314 * mm}, {21.075 * mm, 22.944 * mm}};
  s.cracks = {crack};
  return s;
}

/// The tip at rest; `toughness` (Pa m^0.5) lets it grow by one segment.
Tip tip_at_rest(double toughness) {
  Scene s = plate_with_slanted_crack();
  s.growth->toughness = toughness;
  const test::ChosenSpace space;
  Simulation m(s, space);
  Tip& far = m.state.tips[0].last ? m.state.tips[1] : m.state.tips[0];
  Tip& tip = m.state.tips[0].last ? m.state.tips[0] : m.state.tips[1];
  far.grows = false;
  s.output.history_every = 10e-6;
  while (m.state.clock.time < 0.7e-3) {
    m.step();
    tip.grows = tip.grows && m.state.events.empty();
  }
  return tip;
}

TEST(TurnedTip, ReleasesWhatTheKinkedCrackDoes) {
  const Tip straight = tip_at_rest(1e9);
  const HoopStress hoop = greatest_hoop_stress(straight.K_I, straight.K_II);
  const Tip turned = tip_at_rest(0.98 * hoop.K);
  ASSERT_GT(turned.length, 0.12 * mm);
  ASSERT_LT(turned.length, 0.13 * mm);
  report("tip turned by a segment: J over that before, kink of half a cell", turned.J / straight.J, "1.034 +- 0.05");
  report("tip turned by a segment: K_II over K_I", turned.K_II / turned.K_I, "none");
  EXPECT_NEAR(turned.J / straight.J, 1.034, 0.05);
}

}  // namespace
}  // namespace riven
