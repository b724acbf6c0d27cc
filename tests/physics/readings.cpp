// Several contours and methods from one run: each says what a run of its own would have said.
#include "tests/physics/tip_history.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace gates;

/// The crossed edge crack on cells of 2 mm, a while after the ends began to move.
Scene coarse(std::vector<std::string> more) {
  more.insert(more.begin(),
              {"grid.cell=2 mm", "grid.lower=[\"-6 mm\", \"-56 mm\"]", "grid.upper=[\"56 mm\", \"56 mm\"]",
               "grip.top.rectangle.upper.1=52 mm", "grip.bottom.rectangle.lower.1=-52 mm", "solver.time=0.1 ms",
               "output.history_every=10 us"});
  return shipped("sent_h_and_v", more);
}

TEST(Readings, AgreeWithRunsOfTheirOwn) {
  const FractureRules plain = coarse({}).fracture;
  FractureRules far = plain, blind = plain;
  far.contour = 8;
  far.area = AreaTerm::always;
  blind.contour = 8;
  blind.method = JMethod::pijc;
  const std::vector<TipHistory> together = run_with(coarse({}), {plain, far, blind});
  ASSERT_GE(together[0].size(), 9u);
  const std::vector<std::vector<std::string>> own = {
      {}, {"fracture.contour=8", "fracture.area_integral=always"}, {"fracture.contour=8", "fracture.method=pijc"}};
  for (size_t k = 0; k < own.size(); ++k) {
    const Scene scene = coarse(own[k]);
    const test::ChosenSpace space;
    Simulation m(scene, space);
    while (!m.finished())
      m.step();
    const std::vector<Tip>& read = together[k].back().tips;
    ASSERT_EQ(read.size(), m.state.tips.size());
    for (size_t t = 0; t < read.size(); ++t) {
      EXPECT_EQ(read[t].J, m.state.tips[t].J) << k << " " << t;
      EXPECT_EQ(read[t].K_I, m.state.tips[t].K_I) << k << " " << t;
      EXPECT_EQ(read[t].K_II, m.state.tips[t].K_II) << k << " " << t;
    }
  }
  EXPECT_NE(together[0].back().tips[0].J, together[1].back().tips[0].J);
  EXPECT_GT(std::abs(together[2].back().tips[0].J / together[1].back().tips[0].J - 1), 0.05);
}

}  // namespace
}  // namespace riven
