// The weight q of the J integral, and where its rectangle goes.
#include "core/fracture/j_domain.hpp"

#include <gtest/gtest.h>

#include "core/fracture/place_domain.hpp"

namespace riven {
namespace {

JDomain uneven() {
  const double reach[4] = {2, 3.5, 0.5, 2.25};
  return plain_domain({10, 20}, reach, 1);
}

TEST(JDomain, IsOneAtTheTipAndZeroOutside) {
  const JDomain d = uneven();
  EXPECT_EQ(d.weight({0, 0}), 1);
  EXPECT_EQ(d.weight({d.outer(right), 0}), 0);
  EXPECT_EQ(d.weight({0, -d.outer(bottom)}), 0);
  EXPECT_EQ(d.weight({-5, 5}), 0);
}

TEST(JDomain, FallsToHalfOnTheContour) {
  const JDomain d = uneven();
  EXPECT_NEAR(d.weight({d.reach[right], 0}), 0.5, 1e-15);
  EXPECT_NEAR(d.weight({0, -d.reach[bottom]}), 0.5, 1e-15);
  EXPECT_NEAR(d.weight({-d.reach[left], d.reach[top]}), 0.25, 1e-15);
}

TEST(JDomain, GradientIsThatOfTheWeight) {
  const JDomain d = uneven();
  const double e = 1e-6;
  for (double y = -3.9; y < 5; y += 0.37)
    for (double x = -1.9; x < 4; x += 0.29) {
      const Vec2 g = d.at({x, y}).gradient();
      EXPECT_NEAR(g.x, (d.weight({x + e, y}) - d.weight({x - e, y})) / (2 * e), 1e-5);
      EXPECT_NEAR(g.y, (d.weight({x, y + e}) - d.weight({x, y - e})) / (2 * e), 1e-5);
    }
}

// What makes the sums over a regular lattice of particles exact wherever the tip lies among them.
TEST(JDomain, SlopesAddUpToTheEdgesOnAnyRegularLattice) {
  for (double spacing : {0.5, 0.25})
    for (double shift : {0.0, 0.11, 0.26, 0.49}) {
      const double reach[4] = {2, 3, 2, 4};
      const JDomain d = plain_domain({0, 0}, reach, 1);
      double sum[4] = {0, 0, 0, 0};
      for (double y = -6 + shift; y < 6; y += spacing)
        for (double x = -6 + 0.7 * shift; x < 6; x += spacing)
          for (int e = 0; e < 4; ++e)
            sum[e] += d.at({x, y}).slope(e) * spacing * spacing;
      for (int e = 0; e < 4; ++e)
        EXPECT_NEAR(sum[e], d.length(e), 1e-12);
    }
}

constexpr double eight[4] = {4, 4, 4, 4};

TEST(PlaceDomain, StaysAsAskedAwayFromOtherTips) {
  const PlacedDomain p = place_domain({0, 0}, eight, 1, {{5.5, 0}, {-3, 7}});  // a tip acts half a cell ahead
  EXPECT_FALSE(p.adapted);
  for (double r : p.domain.reach)
    EXPECT_EQ(r, 4);
}

TEST(PlaceDomain, LeavesOutATipByMovingTheEdgeThatMovesLeast) {
  const PlacedDomain p = place_domain({0, 0}, eight, 1, {{4.5, 1}});
  EXPECT_TRUE(p.adapted);
  EXPECT_DOUBLE_EQ(p.domain.reach[right], 2.5);
  EXPECT_EQ(p.domain.reach[top], 4);
  EXPECT_EQ(p.domain.reach[left], 4);
}

TEST(PlaceDomain, LeavesOutATipInTheNextCell) {
  EXPECT_TRUE(place_domain({0, 0}, eight, 1, {{4.9, 0}}).adapted);
}

TEST(PlaceDomain, WeightIsZeroAtEveryTipThatCanBeLeftOut) {
  const std::vector<Vec2> others{{3, 0.2}, {0.4, 2.1}, {-1.4, -0.9}, {-3.9, 3.9}, {1.1, -0.3}};
  const PlacedDomain p = place_domain({0, 0}, eight, 1, others);
  EXPECT_FALSE(p.in_cell);
  EXPECT_EQ(p.domain.weight({0, 0}), 1);
  for (const Vec2 r : others) {
    EXPECT_EQ(p.domain.weight(r), 0) << r.x << " " << r.y;
    EXPECT_EQ(norm(p.domain.at(r).gradient()), 0) << r.x << " " << r.y;
  }
}

TEST(PlaceDomain, SaysSoWhereATipIsTooNear) {
  EXPECT_TRUE(place_domain({0, 0}, eight, 1, {{0.6, -0.8}}).in_cell);
}

}  // namespace
}  // namespace riven
