// A crack that ends on another one, in whole runs: its mouth is open (beyond_end.hpp).
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

/// A square plate of half width 5 arms with a T of three arms under pressure, turned by 10 degrees on cells of a tenth
/// of an arm, brought to rest. The host is one crack, on which the other
/// begins.
std::vector<Tip> press_tee() {
  Scene s = empty_scene(mm, {{-54 * mm, -54 * mm}, {54 * mm, 54 * mm}});
  s.materials = {{"solid", LawKind::linear_elastic, 3e9, 0.3, 1000}};
  s.bodies = {body("plate", Rectangle{{-50 * mm, -50 * mm}, {50 * mm, 50 * mm}})};
  s.transfer = Transfer::fmpm;
  s.order = 2;
  const Vec2 middle{0.13 * mm, 0.21 * mm}, along{std::cos(pi / 18), std::sin(pi / 18)};
  s.cracks = {crack("host", {middle + arm * along, middle - arm * along}),
              crack("branch", {middle, middle + arm * turned(along)})};
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

/// Against displacement discontinuities (S.L. Crouch, Int. J. Numer. Meth. Eng. 10 (1976) 301-343), 200 of them on each
/// arm and 320 on the plate's edges, over P sqrt(pi arm): host 0.995 and +-0.152, branch 0.722 and 0.001. Where the
/// parts before the host are held together at the branch's mouth, K_II of the host is 0.12 and K_I of the branch 0.695.
TEST(CrackEnds, AreOpenMouths) {
  const std::vector<Tip> tips = press_tee();
  ASSERT_EQ(tips.size(), 3u);
  const double K = MPa * std::sqrt(pi * arm);
  const auto expect = [&](const char* what, double measured, double exact, double limit) {
    gates::report(fmt::format("T under pressure, {}, over P sqrt(pi a)", what), measured / K,
                  fmt::format("{} +-{}", exact, limit));
    EXPECT_NEAR(measured / K, exact, limit) << what;
  };
  expect("K_I of the host's first end", tips[0].K_I, 0.995, 0.02);
  expect("K_I of the host's last end", tips[1].K_I, 0.995, 0.02);
  expect("K_II of the host's first end", tips[0].K_II, 0.153, 0.012);
  expect("K_II of the host's last end", tips[1].K_II, -0.151, 0.012);
  expect("K_I of the branch", tips[2].K_I, 0.722, 0.012);
  expect("K_II of the branch", tips[2].K_II, 0.001, 0.03);
}

}  // namespace
}  // namespace riven
