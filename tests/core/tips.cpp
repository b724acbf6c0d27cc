// Which ends of cracks are tips: inside a body, on no border, on no other crack.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>

#include "core/fracture/tip_places.hpp"
#include "core/plan/plan.hpp"
#include "core/state/make_tips.hpp"

namespace riven {
namespace {

/// A plate of 20 x 20 with a round hole in the middle, cells of 1, two particles along each axis.
Scene plate(const std::vector<std::vector<Vec2>>& lines) {
  Scene s;
  s.cell = 1;
  s.materials.resize(2);
  Body b;
  b.material = 1;
  b.region = Rectangle{{0, 0}, {20, 20}};
  b.holes = {Disk{{10, 10}, 3}};
  s.bodies.push_back(b);
  for (const auto& points : lines) {
    CrackLine c;
    c.points = points;
    s.cracks.push_back(c);
  }
  return s;
}

using Ends = std::vector<std::pair<int, bool>>;

Ends tips_of(const std::vector<std::vector<Vec2>>& lines) {
  Ends ends;
  for (const Tip& t : make_tips(plate(lines))) {
    ends.emplace_back(t.crack, t.last);
    EXPECT_EQ(t.material, 1);
    EXPECT_TRUE(t.open);
  }
  return ends;
}

TEST(Tips, AreTheEndsInsideABody) {
  EXPECT_EQ(tips_of({{{4, 4}, {8, 4}}}), (Ends{{0, false}, {0, true}}));
  EXPECT_EQ(tips_of({{{-1, 4}, {8, 4}}}), (Ends{{0, true}}));                     // from outside
  EXPECT_EQ(tips_of({{{0, 4}, {8, 4}}}), (Ends{{0, true}}));                      // from the border
  EXPECT_EQ(tips_of({{{0.2, 4}, {8, 4}}}), (Ends{{0, true}}));                    // within half a particle of it
  EXPECT_EQ(tips_of({{{0.25, 4}, {8, 4}}}), (Ends{{0, false}, {0, true}}));       // half a particle away
  EXPECT_EQ(tips_of({{{10, 10}, {16, 10}}}), (Ends{{0, true}}));                  // from the hole
  EXPECT_EQ(tips_of({{{7.1, 10}, {4, 10}}}), (Ends{{0, true}}));                  // from its border
  EXPECT_EQ(tips_of({{{-1, 4}, {21, 4}}}), Ends{});                               // through the plate
  EXPECT_EQ(tips_of({{{2, 2}, {3, 2}, {3, 3}}}), (Ends{{0, false}, {0, true}}));  // bent
}

TEST(Tips, AreNotWhereCracksMeet) {
  EXPECT_EQ(tips_of({{{2, 4}, {8, 4}}, {{5, 4}, {5, 2}}}), (Ends{{0, false}, {0, true}, {1, true}}));    // T
  EXPECT_EQ(tips_of({{{2, 4}, {8, 4}}, {{5, 4.2}, {5, 2}}}), (Ends{{0, false}, {0, true}, {1, true}}));  // just over
  EXPECT_EQ(tips_of({{{2, 4}, {5, 4}}, {{5, 4}, {5, 2}}}), (Ends{{0, false}, {1, true}}));               // corner
  EXPECT_EQ(tips_of({{{2, 4}, {8, 4}}, {{5, 5}, {5, 2}}}).size(), 4u);                                   // cross
  EXPECT_EQ(tips_of({{{2, 2}, {4, 2}, {4, 4}, {2, 2}}}), Ends{});                                        // closed
  EXPECT_EQ(tips_of({{{2, 2}, {2.1, 2}, {2.2, 2}, {6, 2}}}).size(), 2u);  // short lines at the end
}

TEST(Tips, ACrackGrowsByItsOwnRuleElseTheScenes) {
  Scene s = plate({{{4, 4}, {8, 4}}, {{4, 16}, {8, 16}}, {{4, 18}, {8, 18}}});
  for (int c = 0; c < 3; ++c)
    EXPECT_EQ(growth_rule(s, c), nullptr);
  s.growth = GrowthRule{};
  s.cracks[1].growth = GrowthRule{};
  s.cracks[2].grows = false;
  EXPECT_EQ(growth_rule(s, 0), &*s.growth);
  EXPECT_EQ(growth_rule(s, 1), &*s.cracks[1].growth);
  EXPECT_EQ(growth_rule(s, 2), nullptr);
  const std::vector<Tip> tips = make_tips(s);
  ASSERT_EQ(tips.size(), 6u);
  for (const Tip& t : tips)
    EXPECT_EQ(t.grows, t.crack != 2);
}

TEST(Tips, ArePlannedWhereJOrGrowthIsAskedFor) {
  Scene s = plate({{{4, 4}, {8, 4}}});
  EXPECT_FALSE(make_plan(s).fracture);
  s.fracture.asked = true;
  EXPECT_TRUE(make_plan(s).fracture);
  EXPECT_FALSE(make_plan(s).growth);
  s.fracture.asked = false;
  s.growth = GrowthRule{};
  EXPECT_TRUE(make_plan(s).fracture);
  EXPECT_TRUE(make_plan(s).growth);
  s.cracks[0].grows = false;
  EXPECT_FALSE(make_plan(s).fracture);
}

TEST(TipPlaces, FindWhatIsNearAndNothingElse) {
  std::vector<Vec2> at;
  at.reserve(201);
  for (int k = 0; k < 200; ++k)
    at.push_back({std::fmod(k * 0.618, 1.0), std::fmod(k * 0.414, 1.0)});
  at.push_back(at.front());  // two tips may lie on each other
  const TipPlaces places(at);
  for (const double far : {0.01, 0.1, 2.0})
    for (const Vec2 x : {at[0], at[17], Vec2{0.5, 0.5}, Vec2{-1, 0.5}, Vec2{1.05, 1.05}}) {
      std::multiset<size_t> found, near;
      places.each_near(x, far, [&](size_t k) { found.insert(k); });
      for (size_t k = 0; k < at.size(); ++k)
        if (std::fabs(at[k].x - x.x) < far && std::fabs(at[k].y - x.y) < far)
          near.insert(k);
      EXPECT_EQ(found, near);
    }
}

}  // namespace
}  // namespace riven
