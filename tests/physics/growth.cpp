// A crack that runs along the middle of a stretched strip, and when it starts.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/physics/scene_gates.hpp"
#include "tests/physics/scenes.hpp"
#include "tests/physics/strip.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace test;

constexpr double mm = 1e-3, toughness = 1000;

Scene strip(GrowthCriterion criterion) {
  Scene s = Strip::scene(30 * mm, toughness, {0.2, [](double t) { return std::min(1., t / 0.1e-3); }, ""});
  s.growth->criterion = criterion;
  if (criterion == GrowthCriterion::k_max)
    s.growth->toughness = std::sqrt(toughness * Strip::E);
  return s;
}

// How fast a crack may run says nothing of when it starts: at 1 m/s a particle takes as long as the whole run.
TEST(CrackGrowth, StartsAtItsToughnessWhateverItsSpeedLimit) {
  const ChosenSpace space;
  double start[2] = {};
  for (const bool slow : {false, true}) {
    Scene s = pulled_plate(crack("edge", {{-22e-3, 0}, {-8e-3, 0}}), 4);
    s.order = 2;
    s.growth = GrowthRule{};
    s.growth->toughness = 0.2e6;
    s.growth->speed_limit = slow ? 1 : 0;
    Simulation m(s, space);
    while (!m.finished() && m.state.events.empty())
      m.step();
    ASSERT_FALSE(m.state.events.empty());
    start[slow] = m.state.events[0].time;
  }
  gates::report("start of a crack that may run at 1 m/s over that of one as fast as waves, less 1",
                start[1] / start[0] - 1, "1e-9");
  EXPECT_NEAR(start[1] / start[0], 1, 1e-9);
}

TEST(CrackGrowth, StartsWhenTheStripAheadReleasesEnough) {
  for (const GrowthCriterion criterion : {GrowthCriterion::critical_j, GrowthCriterion::k_max}) {
    const Scene scene = strip(criterion);
    const ChosenSpace space;
    Simulation m(scene, space);
    ASSERT_EQ(m.state.tips.size(), 1u);
    while (m.state.events.empty() && m.state.clock.time < 1e-3)
      m.step();
    ASSERT_FALSE(m.state.events.empty());
    EXPECT_NEAR(Strip::J(Strip::strain(m)), toughness, 0.05 * toughness);
    EXPECT_NEAR(m.state.events[0].place.y, 0, 0.05 * mm);
    // the clamps go on, and the crack runs straight through, no faster than its limit
    double held = 0;  // J, by the strip that it runs through
    while (m.state.tips[0].open && m.state.clock.time < 1e-3) {
      const double way = m.state.tips[0].length;
      m.step();
      held += Strip::J(Strip::strain(m)) * (m.state.tips[0].length - way) * mm;
      EXPECT_LE(m.state.tips[0].speed, 900);
    }
    EXPECT_EQ(m.state.events.back().kind, CrackEvent::Kind::exit);
    EXPECT_NEAR(m.state.events.back().place.y, 0, mm);
    EXPECT_NEAR(m.state.tips[0].length, 30 * mm, mm);
    while (m.state.clock.time < 1e-3)
      m.step();
    m.take_stock();  // which would say so if growth made the run unstable
    // What the strip held that the crack ran through is what the body has lost, once all waves are worn down by this
    // transfer. A tip that gathers speed all the way leaves some of it to the halves of the strip, which it sets
    // moving, and takes up its toughness or what is beyond that at its limit (of steady motion see RunningTip).
    const Energy& e = m.state.ledger.energy;
    EXPECT_NEAR(-e.numerical(), held, 0.05 * held);
    EXPECT_GT(e.fracture, 0.97 * toughness * 30 * mm * mm);
    EXPECT_LT(e.fracture, held);
  }
}

}  // namespace
}  // namespace riven
