// J of a tip that runs, at up to 0.7 of the shear wave speed: until the two cracks are abreast, J at one time is that
// of every contour, if inertia inside of it has its part. The control leaves that out.
#include "tests/physics/scene_gates.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace gates;

/// Over rows of the run: mean J by 4 cells, by 16 cells, and the mean distance between both, J/m^2.
struct Contours {
  double small = 0, large = 0, apart = 0;
};

Contours run(AreaTerm area) {
  Scene s = shipped("offset_cracks", {"grid.cell=1 mm", "output.frames=0"});
  s.fracture.area = area;
  FractureRules large = s.fracture;
  large.contour = 16;
  s.readings = {{"far", large}};
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
  }
  EXPECT_GE(tip.length, 18e-3);
  return {c.small / rows, c.large / rows, c.apart / rows};
}

TEST(RunningTip, ReleasesTheSameByAllContours) {
  const Contours all = run(AreaTerm::always), without = run(AreaTerm::never);
  report("tip that runs: mean J by 16 cells over that by 4, less 1", all.large / all.small - 1, "0.05");
  report("tip that runs: mean distance of both, over J", all.apart / all.small, "0.15");
  report("tip that runs, without inertia: mean J by 16 cells over that by 4, less 1", without.large / without.small - 1,
         "more than 0.1");
  report("tip that runs: mean J by 4 cells without inertia over that with it, less 1", without.small / all.small - 1,
         "more than 0.1");
  EXPECT_GT(without.small / all.small - 1, 0.1);
  EXPECT_LT(std::abs(all.large / all.small - 1), 0.05);
  EXPECT_LT(all.apart / all.small, 0.15);
  EXPECT_GT(without.large / without.small - 1, 0.1);
}

}  // namespace
}  // namespace riven
