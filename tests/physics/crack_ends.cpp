// Cracks that end on each other or cross, in whole runs: their mouths are open (beyond_end.hpp), and pressures act on
// the part of the solid that they belong to.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/physics/scene_gates.hpp"
#include "tests/physics/scenes.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace test;
using std::numbers::pi;

constexpr double mm = 1e-3, MPa = 1e6, arm = 10 * mm;

/// A square plate of half width 5 arms whose cracks are pressed open on cells of a tenth of an arm, brought to rest.
std::vector<Tip> press(std::vector<CrackLine> cracks) {
  Scene s = empty_scene(mm, {{-54 * mm, -54 * mm}, {54 * mm, 54 * mm}});
  s.materials = {{"solid", LawKind::linear_elastic, 3e9, 0.3, 1000}};
  s.bodies = {body("plate", Rectangle{{-50 * mm, -50 * mm}, {50 * mm, 50 * mm}})};
  s.transfer = Transfer::fmpm;
  s.order = 2;
  s.cracks = std::move(cracks);
  for (CrackLine& c : s.cracks) {
    c.traction = TractionSettings{};
    c.traction->pressure = {MPa, [](double t) { return t < 1e-4 ? 0.5 * (1 - std::cos(pi * t / 1e-4)) : 1; }, ""};
  }
  s.grid_damping = {4e4, [](double t) { return t < 1e-4 ? 0.2 : 1; }, ""};
  s.fracture.asked = true;
  s.fracture.contour = 8;
  s.end_time = 2e-4;
  const ChosenSpace space;
  Simulation m(s, space);
  while (!m.finished())
    m.step();
  return m.state.tips;
}

const double K = MPa * std::sqrt(pi * arm);

void expect_K(const char* what, double measured, double exact, double limit) {
  gates::report(fmt::format("{}, over P sqrt(pi a)", what), measured / K, fmt::format("{} +-{}", exact, limit));
  EXPECT_NEAR(measured / K, exact, limit) << what;
}

/// Turned by 10 degrees on the grid; the middle is no node.
const Vec2 middle{0.13 * mm, 0.21 * mm}, along{std::cos(pi / 18), std::sin(pi / 18)};

/// Against displacement discontinuities (S.L. Crouch, Int. J. Numer. Meth. Eng. 10 (1976) 301-343), 200 of them on each
/// arm and 320 on the plate's edges, over P sqrt(pi arm): host 0.995 and +-0.152, branch 0.722 and 0.001. Where the
/// parts before the host are held together at the branch's mouth, K_II of the host is 0.12 and K_I of the branch 0.695;
/// where what a point bears acts on one part alone, K_II of the branch is 0.02.
TEST(CrackEnds, AreOpenMouths) {
  const std::vector<Tip> tips = press({crack("host", {middle + arm * along, middle - arm * along}),
                                       crack("branch", {middle, middle + arm * turned(along)})});
  ASSERT_EQ(tips.size(), 3u);
  expect_K("T under pressure, K_I of the host's first end", tips[0].K_I, 0.995, 0.02);
  expect_K("T under pressure, K_I of the host's last end", tips[1].K_I, 0.995, 0.02);
  expect_K("T under pressure, K_II of the host's first end", tips[0].K_II, 0.153, 0.008);
  expect_K("T under pressure, K_II of the host's last end", tips[1].K_II, -0.151, 0.008);
  expect_K("T under pressure, K_I of the branch", tips[2].K_I, 0.722, 0.012);
  expect_K("T under pressure, K_II of the branch", tips[2].K_II, 0.001, 0.006);
}

/// A cross is as good as its four arms are alike: K_II = 0, and K_I that of the star of four arms,
/// 0.864 P sqrt(pi a) in an infinite plate (D.P. Rooke and I.N. Sneddon, Int. J. Eng. Sci. 7 (1969) 1079-1089) and
/// 0.886 in this one by displacement discontinuities. K_II is 0.017 where what a point bears acts on one part alone.
TEST(CrackEnds, LetCrossesBeLikeOnAllArms) {
  for (const bool on_node : {true, false}) {
    const Vec2 at = on_node ? Vec2{} : middle, e = on_node ? Vec2{1, 0} : along;
    const std::vector<Tip> tips = press(
        {crack("one", {at - arm * e, at + arm * e}), crack("other", {at - arm * turned(e), at + arm * turned(e)})});
    ASSERT_EQ(tips.size(), 4u);
    const double mean = 0.25 * (tips[0].K_I + tips[1].K_I + tips[2].K_I + tips[3].K_I);
    expect_K("cross under pressure, K_I", mean, 0.886, 0.012);
    for (const Tip& tip : tips) {
      expect_K("cross under pressure, K_I of one tip", tip.K_I, mean / K, 0.006);
      expect_K("cross under pressure, K_II of one tip", tip.K_II, 0, 0.006);
    }
  }
}

}  // namespace
}  // namespace riven
