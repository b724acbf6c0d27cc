// J of a tip that runs, at up to 0.7 of the shear wave speed: until the two cracks are abreast, J at one time is that
// of every contour, as inertia inside of it has its part. The control leaves that out.
#include "tests/physics/scene_gates.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace gates;

/// Mean J over rows of the run, J/m^2.
struct Contours {
  double small = 0, large = 0;  ///< by 4 cells, as is the default, and by 16
  double apart = 0;             ///< distance between both
  double small_without = 0, large_without = 0;
};

Contours run() {
  Scene s = shipped("offset_cracks", {"grid.cell=1 mm", "output.frames=0"});
  FractureRules large = s.fracture, small_without = s.fracture;
  large.contour = 16;
  small_without.area = AreaTerm::never;
  FractureRules large_without = small_without;
  large_without.contour = 16;
  s.readings = {{"far", large}, {"without", small_without}, {"far without", large_without}};
  s.output.history_every = 0.4e-6;
  const test::ChosenSpace space;
  Simulation m(s, space);
  const Tip& tip = m.state.tips[m.state.tips[0].open ? 0 : 1];
  const auto place = static_cast<size_t>(&tip - m.state.tips.data());
  Contours c;
  int rows = 0;
  for (long seen = -1; tip.length < 18e-3 && m.state.clock.time < 0.5e-3;) {
    m.step();
    if (tip.speed == 0 || m.state.readings[0].empty() || m.state.readings[0][place].step == seen)
      continue;
    seen = m.state.readings[0][place].step;
    if (tip.step != seen)
      continue;
    const double J = tip.J, far = m.state.readings[0][place].J;
    ++rows;
    c.small += J;
    c.large += far;
    c.apart += std::abs(far - J);
    c.small_without += m.state.readings[1][place].J;
    c.large_without += m.state.readings[2][place].J;
  }
  EXPECT_GE(tip.length, 18e-3);
  return {c.small / rows, c.large / rows, c.apart / rows, c.small_without / rows, c.large_without / rows};
}

TEST(RunningTip, ReleasesTheSameByAllContours) {
  const Contours J = run();
  report("tip that runs: mean J by 16 cells over that by 4, less 1", J.large / J.small - 1, "0.05");
  report("tip that runs: mean distance of both, over J", J.apart / J.small, "0.15");
  report("tip that runs, without inertia: mean J by 16 cells over that by 4, less 1",
         J.large_without / J.small_without - 1, "more than 0.1");
  report("tip that runs: mean J by 4 cells without inertia over that with it, less 1", J.small_without / J.small - 1,
         "more than 0.1");
  EXPECT_GT(J.small_without / J.small - 1, 0.1);
  EXPECT_LT(std::abs(J.large / J.small - 1), 0.05);
  EXPECT_LT(J.apart / J.small, 0.15);
  EXPECT_GT(J.large_without / J.small_without - 1, 0.1);
}

}  // namespace
}  // namespace riven
