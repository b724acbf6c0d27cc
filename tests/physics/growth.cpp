// A crack along the middle of a strip between clamps that are pulled apart: behind the tip the strip is slack, ahead it
// is stretched without contraction along it, so that the energy release rate is that of the strip ahead,
//   J = 2 H W = E eps^2 H / (1 - nu^2)   (plane stress, half height H, eps = u / H),
// whatever the crack's length (Rice, J. Appl. Mech. 35 (1968) 379-386).
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/physics/scenes.hpp"

namespace riven {
namespace {

using namespace test;

constexpr double mm = 1e-3, H = 12 * mm, toughness = 1000;

Scene strip(GrowthCriterion criterion) {
  Scene s = empty_scene(mm, {{-4 * mm, -18 * mm}, {64 * mm, 18 * mm}});
  s.plane = Plane::stress;
  s.thickness = mm;
  s.materials = {{"strip", LawKind::linear_elastic, 2.5e9, 0.33, 1000}};
  s.transfer = Transfer::fmpm;
  s.order = 1;
  s.bodies = {body("strip", Rectangle{{0, -H}, {60 * mm, H}})};
  s.cracks = {crack("middle", {{-mm, 0}, {30 * mm, 0}})};
  s.growth = GrowthRule{};
  s.growth->criterion = criterion;
  s.growth->toughness = criterion == GrowthCriterion::k_max ? std::sqrt(toughness * 2.5e9) : toughness;
  const auto clamp = [&](const char* name, double from, double sign) {
    Grip g;
    g.name = name;
    g.region = Rectangle{{0, from}, {60 * mm, from + mm}};
    g.velocity[0] = TimeFunction{0, {}, ""};
    g.velocity[1] = TimeFunction{sign * 0.2, [](double t) { return std::min(1., t / 0.1e-3); }, ""};
    s.grips.push_back(g);
  };
  clamp("low", -H - mm, -1);
  clamp("high", H, 1);
  return s;
}

TEST(CrackGrowth, StartsWhenTheStripAheadReleasesEnough) {
  for (const GrowthCriterion criterion : {GrowthCriterion::critical_j, GrowthCriterion::k_max}) {
    const Scene scene = strip(criterion);
    const exec::Space space;
    Simulation m(scene, space);
    ASSERT_EQ(m.state.tips.size(), 1u);
    while (m.state.events.empty() && m.state.clock.time < 1e-3)
      m.step();
    ASSERT_FALSE(m.state.events.empty());
    const double strain = m.state.constraints.owners[1].travel.y / H;
    EXPECT_NEAR(2.5e9 * strain * strain * H / (1 - 0.33 * 0.33), toughness, 0.05 * toughness);
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
