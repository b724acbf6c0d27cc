// A crack that runs along the middle of a stretched strip, and when it starts.
#include <gtest/gtest.h>

#include <algorithm>

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
    while (m.state.tips[0].open && m.state.clock.time < 1e-3) {
      m.step();
      EXPECT_LE(m.state.tips[0].speed, 900);
    }
    EXPECT_EQ(m.state.events.back().kind, CrackEvent::Kind::exit);
    EXPECT_NEAR(m.state.events.back().place.y, 0, mm);
    EXPECT_NEAR(m.state.tips[0].length, 30 * mm, mm);
    m.take_stock();  // which would say so if growth made the run unstable
    // the waves that growth sends out are worn down by this transfer: its loss is what the crack took, the toughness
    // times its area (8 % more is measured). Each segment is booked at what it releases when it comes, which is more.
    const Energy& e = m.state.ledger.energy;
    EXPECT_GT(e.fracture, 30 * mm * mm * toughness);
    EXPECT_NEAR(-e.numerical(), 30 * mm * mm * toughness, 0.1 * 30 * mm * mm * toughness);
  }
}

}  // namespace
}  // namespace riven
