// Laws of tractions between crack faces against closed forms: the areas under their curves are the toughnesses, and
// what they dissipate and store adds up to the work done on them, along any path.
#include <gtest/gtest.h>

#include <numbers>

#include "core/laws/traction.hpp"

using namespace riven;

namespace {

TractionSettings settings(TractionKind kind) {
  TractionSettings s;
  s.kind = kind;
  s.strength = 30e6;
  s.toughness = 600;
  s.shear_strength = 50e6;
  s.shear_toughness = 1500;
  s.peak = 0.1;
  s.knee = 0.4;
  s.knee_strength = 0.2;
  s.decay = 5;
  return s;
}

class CohesiveLaw : public ::testing::TestWithParam<TractionKind> {
 protected:
  const TractionSettings said = settings(GetParam());
  const Cohesive law{said};

  /// Follows a path delta(s), s from 0 to 1, by the trapezoidal rule.
  struct Outcome {
    double work = 0, dissipated = 0, least_step = 0;
    FacePair share;  ///< parts of the toughnesses that the two modes have dissipated
    CohesiveHistory history;
    FacePair end;
  };
  template <class Path>
  Outcome follow(Path path, int steps = 200000) const {
    Outcome o;
    FacePair d = path(0.0), T = law.traction(d, o.history);
    for (int i = 1; i <= steps; ++i) {
      const FacePair next = path(double(i) / steps);
      const double taken = law.damage(next, o.history);
      o.least_step = std::min(o.least_step, taken);
      o.dissipated += taken;
      const FacePair now = law.traction(next, o.history);
      o.work += 0.5 * (T.normal + now.normal) * (next.normal - d.normal) +
                0.5 * (T.sliding + now.sliding) * (next.sliding - d.sliding);
      if (taken > 0) {
        const double n = std::max(next.normal, 0.) / law.critical.normal / law.effective(next);
        const double of_mode = taken / (said.toughness * n * n + said.shear_toughness * (1 - n * n));
        o.share.normal += n * n * of_mode;
        o.share.sliding += (1 - n * n) * of_mode;
      }
      d = next;
      T = now;
    }
    o.end = d;
    return o;
  }
};

INSTANTIATE_TEST_SUITE_P(Curves, CohesiveLaw,
                         ::testing::Values(TractionKind::triangular, TractionKind::trilinear,
                                           TractionKind::exponential),
                         [](const auto& p) {
                           return std::string(p.param == TractionKind::triangular  ? "triangular"
                                              : p.param == TractionKind::trilinear ? "trilinear"
                                                                                   : "exponential");
                         });

TEST_P(CohesiveLaw, EncloseTheToughnessOfEachMode) {
  const Outcome opening = follow([&](double s) { return FacePair{1.2 * s * law.critical.normal, 0}; });
  const Outcome sliding = follow([&](double s) { return FacePair{0, -1.2 * s * law.critical.sliding}; });
  for (const auto& [o, toughness] : {std::pair{opening, said.toughness}, {sliding, said.shear_toughness}}) {
    EXPECT_NEAR(o.work, toughness, 1e-6 * toughness);
    EXPECT_NEAR(o.dissipated, toughness, 1e-10 * toughness);
    EXPECT_NEAR(o.history.dissipated, o.dissipated, 1e-10 * toughness);
    EXPECT_EQ(law.traction(o.end, o.history).normal, 0);
    EXPECT_EQ(law.traction(o.end, o.history).sliding, 0);
  }
}

TEST_P(CohesiveLaw, ReachTheStrengthOfEachModeAtThePeak) {
  EXPECT_DOUBLE_EQ(law.traction({0.1 * law.critical.normal, 0}, {}).normal, 30e6);
  EXPECT_DOUBLE_EQ(law.traction({0, 0.1 * law.critical.sliding}, {}).sliding, 50e6);
  EXPECT_DOUBLE_EQ(law.stiffness(), std::max(30e6 / law.critical.normal, 50e6 / law.critical.sliding) / 0.1);
  EXPECT_NEAR(law.traction({1e-9 * law.critical.normal, 0}, {}).normal, 30e6 / 0.1 * 1e-9, 1e-9);
}

TEST_P(CohesiveLaw, FallEverAfterThePeak) {
  CohesiveHistory h;
  double last = 30e6;
  for (int i = 11; i <= 100; ++i) {
    const FacePair d{0.01 * i * law.critical.normal, 0};
    EXPECT_GT(law.damage(d, h), 0);
    const double now = law.traction(d, h).normal;
    EXPECT_LT(now, last);
    last = now;
  }
  EXPECT_NEAR(last, 0, 1e-6);
}

TEST_P(CohesiveLaw, UnloadAndReloadAlongTheLineThroughTheOrigin) {
  CohesiveHistory h;
  const FacePair worst{0.5 * law.critical.normal, 0.3 * law.critical.sliding};
  law.damage(worst, h);
  const FacePair T = law.traction(worst, h);
  const CohesiveHistory kept = h;
  for (const double part : {0.7, 0.2, 0.0, 0.6, 1.0}) {
    const FacePair d{part * worst.normal, part * worst.sliding};
    EXPECT_EQ(law.damage(d, h), 0);
    EXPECT_NEAR(law.traction(d, h).normal, part * T.normal, 1e-9 * T.normal);
    EXPECT_NEAR(law.traction(d, h).sliding, part * T.sliding, 1e-9 * T.sliding);
    EXPECT_NEAR(law.stored(d, h), 0.5 * part * part * (T.normal * worst.normal + T.sliding * worst.sliding),
                1e-9 * law.stored(worst, h));
  }
  EXPECT_EQ(h.worst, kept.worst);
  EXPECT_EQ(h.dissipated, kept.dissipated);
}

TEST_P(CohesiveLaw, BearNoNormalTractionAndNoDamageWhenPressedTogether) {
  CohesiveHistory h;
  EXPECT_EQ(law.damage({-5 * law.critical.normal, 0}, h), 0);
  EXPECT_EQ(law.traction({-law.critical.normal, 0}, h).normal, 0);
  EXPECT_EQ(law.stored({-law.critical.normal, 0}, h), 0);
  // sliding is resisted, and damages, as without the pressing
  EXPECT_EQ(law.traction({-law.critical.normal, 0.2 * law.critical.sliding}, h).sliding,
            law.traction({0, 0.2 * law.critical.sliding}, h).sliding);
  EXPECT_GT(law.damage({-law.critical.normal, 0.2 * law.critical.sliding}, h), 0);
}

TEST_P(CohesiveLaw, BalanceEnergyAlongMixedPaths) {
  using std::numbers::pi;
  const double n = law.critical.normal, t = law.critical.sliding;
  const auto straight = [&](double s) { return FacePair{0.9 * s * n, 0.8 * s * t}; };
  const auto turning = [&](double s) { return FacePair{0.6 * std::sin(pi / 2 * s) * n, 1.2 * s * s * t}; };
  const auto to_and_fro = [&](double s) {
    return FacePair{0.8 * s * n * std::cos(9 * pi * s), 1.3 * s * t * std::sin(7 * pi * s)};
  };
  const auto check = [&](const auto& path, bool broken) {
    const Outcome o = follow(path);
    EXPECT_GE(o.least_step, 0);
    // a step takes the mix of modes at its end: 1e-4 for 200000 steps of a winding path
    EXPECT_NEAR(o.work, o.dissipated + law.stored(o.end, o.history), 1e-4 * said.toughness);
    EXPECT_EQ(o.history.worst >= 1, broken);
    if (broken) {
      EXPECT_NEAR(o.share.normal + o.share.sliding, 1, 1e-9);
      EXPECT_GT(o.share.normal, 0.05);
      EXPECT_GT(o.share.sliding, 0.05);
    }
  };
  check(straight, true);
  check(turning, true);
  check(to_and_fro, true);
  check([&](double s) { return to_and_fro(0.5 * s); }, false);
}

TEST(Pressure, PushesTheFacesApartWhateverTheOpening) {
  const Pressure p{5e6};
  EXPECT_EQ(p.traction().normal, -5e6);
  EXPECT_EQ(p.traction().sliding, 0);
  EXPECT_EQ(p.stored({2e-6, 7}), -10);
}

TEST(SofteningCurve, WorkIsTheIntegralOfTheTraction) {
  for (const TractionKind kind : {TractionKind::triangular, TractionKind::trilinear, TractionKind::exponential}) {
    const SofteningCurve c{kind, 0.1, 0.4, 0.2, 5};
    double sum = 0;
    constexpr int n = 130000;
    for (int i = 0; i < n; ++i) {
      sum += c.traction((i + 0.5) * 1e-5) * 1e-5;
      if ((i + 1) % 10000 == 0) {
        EXPECT_NEAR(c.work((i + 1) * 1e-5), sum, 1e-8);
      }
    }
  }
}

}  // namespace
