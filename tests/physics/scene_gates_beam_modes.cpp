// K_I and K_II of split beams at rest (Y. Guo and J.A. Nairn, "Calculation of J-integral and stress intensity factors
// using the material point method", section 4.1), held against converged finite elements.
#include "tests/physics/tip_history.hpp"

namespace riven {
namespace {

using namespace gates;

/// Of a load of 1 mN per mm of thickness and arm, Pa m^0.5.
constexpr double dcb = 153.043, enf = 119.839;

/// The scene at rest, with the tip in the middle of a cell of `h` mm and the load on the lower arm in mN.
Tip at_rest(double h, double lower, const char* time = "5 ms") {
  Scene scene = shipped("beam_modes", {fmt::format("grid.cell={} mm", h), fmt::format("solver.time={}", time),
                                       fmt::format("grid.lower=[\"{} mm\", \"-20 mm\"]", -4 - h / 2),
                                       fmt::format("grid.upper=[\"{} mm\", \"20 mm\"]", 108 - h / 2),
                                       fmt::format("load.lower.force_y.value={} mN", lower)});
  return run_tips(scene).back().tips[0];
}

void print(const char* what, double h, const Tip& t, double K_I, double K_II) {
  report(fmt::format("{}, {} mm, K_I by J, Pa m^0.5", what, h), t.K_I, fmt::format("reference {}", K_I));
  report(fmt::format("{}, {} mm, K_II by J", what, h), t.K_II, fmt::format("reference {}", K_II));
  report(fmt::format("{}, {} mm, K_I by J and opening", what, h), t.O_I, fmt::format("reference {}", K_I));
  report(fmt::format("{}, {} mm, K_II by J and opening", what, h), t.O_II, fmt::format("reference {}", K_II));
  report(fmt::format("{}, {} mm, interaction integral alone, K_I", what, h), t.M_I, "none");
  report(fmt::format("{}, {} mm, interaction integral alone, K_II", what, h), t.M_II, "none");
}

/// Limits: those of each beam's own mode, 2 % of it in the other, and 4 % for each of the two with one arm loaded.
void check(double h, double most_dcb, double most_enf, const char* time) {
  const Tip I = at_rest(h, -1, time), II = at_rest(h, 1, time), one = at_rest(h, 0, time);
  print("DCB", h, I, dcb, 0);
  print("ENF", h, II, 0, enf);
  print("one arm", h, one, dcb / 2, enf / 2);
  EXPECT_NEAR(I.K_I, dcb, most_dcb * dcb);
  EXPECT_NEAR(I.K_II, 0, 0.02 * dcb);
  EXPECT_NEAR(I.O_II, 0, 0.02 * dcb);
  EXPECT_NEAR(II.K_II, enf, most_enf * enf);
  EXPECT_NEAR(II.K_I, 0, 0.02 * enf);
  EXPECT_NEAR(II.O_I, 0, 0.02 * enf);
  // the interaction integral shares J out by the mode I of a tip 0.25 cells ahead: 3.6 % and -4.6 % on 2 mm
  const double most_shared = h < 2 ? 0.04 : 0.06;
  EXPECT_NEAR(one.K_I, dcb / 2, most_shared * dcb / 2);
  EXPECT_NEAR(one.K_II, enf / 2, most_shared * enf / 2);
  EXPECT_NEAR(one.O_I, dcb / 2, 0.04 * dcb / 2);
  EXPECT_NEAR(one.O_II, enf / 2, 0.04 * enf / 2);
}

TEST(BeamModes, AreTheReferencesOnTwoMillimetres) {
  check(2, 0.03, 0.04, "4 ms");
}

// build/release/tests/test_physics --gtest_also_run_disabled_tests --gtest_filter=BeamModes.*
TEST(BeamModes, DISABLED_AreTheReferencesOnOneMillimetre) {
  check(1, 0.02, 0.04, "5 ms");
}

}  // namespace
}  // namespace riven
