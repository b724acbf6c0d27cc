// Impulses between fields of which some components of the motion are prescribed.
#include "kernels/prescribed_fields.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace riven {
namespace {

// Two fields of which some components are prescribed: faces do not come closer, friction bears or opposes the sliding
// that is left, and no impulse gives energy. The impulses are (lambda n + tau t), the relative velocity u loses W times
// that; with one free component of W alone the other one is as it was.
TEST(CoupledImpulse, StopsFacesAndBearsOrOpposesTheirSliding) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1), part(0.01, 1);
  int sticks = 0, slides = 0, jams = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const double angle = std::numbers::pi * any(random), mu = part(random);
    const Vec2 n{std::cos(angle), std::sin(angle)}, t = turned(n), u{any(random), any(random)};
    const Vec2 W{trial % 4 == 0 ? 0 : part(random), part(random)};
    const ContactPair p = touching_pair({ContactLaw::coulomb, mu, 0, 0}, 0, 1, n, 0, 1, false);
    const PairImpulse r = coupled_impulse(p, W, {dot(u, n), dot(u, t)});
    const Vec2 J = r.lambda * n + r.tau * t, after{u.x - W.x * J.x, u.y - W.y * J.y};
    ASSERT_GE(r.lambda, 0);
    ASSERT_LE(std::abs(r.tau), mu * r.lambda * (1 + 1e-12));
    if (r.lambda == 0) {
      EXPECT_LE(dot(u, n), 0);
      continue;
    }
    const double scale = 1e-9 * (1 + norm(J));
    EXPECT_NEAR(dot(after, n), 0, scale) << trial;
    if (r.tau == 0) {
      ++jams;
    } else if (std::abs(r.tau) < 0.999999 * mu * r.lambda) {
      EXPECT_NEAR(dot(after, t), 0, scale) << trial;
      ++sticks;
    } else {
      EXPECT_GE(dot(after, t) * r.tau, -scale) << trial;
      ++slides;
    }
    const double work = -dot(u, J) + 0.5 * (W.x * J.x * J.x + W.y * J.y * J.y);
    EXPECT_LE(work, scale) << trial;
  }
  EXPECT_GT(sticks, 1000);
  EXPECT_GT(slides, 1000);
  EXPECT_LT(jams, 1500) << "friction that nothing could overcome";
}

}  // namespace
}  // namespace riven
