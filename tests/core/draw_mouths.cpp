// Cracks that end on an edge of the solid are drawn on out of it; others stay as they are.
#include "core/state/draw_mouths.hpp"

#include <gtest/gtest.h>

#include "core/state/make_tips.hpp"
#include "tests/physics/scenes.hpp"

namespace riven {
namespace {

using namespace test;

/// A plate of 20 x 20 cells of 1 m, with a slot of a cell and a half that comes in from above.
Scene plate(std::vector<Vec2> points) {
  Scene s = empty_scene(1, {{-5, -5}, {25, 25}});
  s.bodies = {body("plate", Rectangle{{0, 0}, {20, 20}})};
  s.bodies[0].holes = {Rectangle{{12, 12}, {13.5, 21}}};
  s.cracks = {crack("crack", std::move(points))};
  return s;
}

std::vector<Vec2> drawn(const Scene& s) {
  return draw_mouths(s).cracks[0].points;
}

void expect_point(Vec2 x, Vec2 wanted) {
  EXPECT_NEAR(x.x, wanted.x, 0.02);
  EXPECT_NEAR(x.y, wanted.y, 0.02);
}

TEST(DrawMouths, OfEndsOnTheEdgeAndWithinHalfAParticleOfIt) {
  for (const double x : {0., 0.1, 0.2, -0.5}) {
    const std::vector<Vec2> points = drawn(plate({{x, 8.3}, {7, 8.3}}));
    ASSERT_EQ(points.size(), 3u) << x;
    expect_point(points[0], {-2, 8.3});
    EXPECT_EQ(points[1].x, x);
    EXPECT_EQ(points[2].x, 7);
  }
  const std::vector<Vec2> both = drawn(plate({{20, 4}, {10, 6}, {0, 4}}));
  ASSERT_EQ(both.size(), 5u);
  EXPECT_NEAR(norm(both[0] - both[1]), 2, 0.02) << "straight on, at a slant";
  EXPECT_NEAR(norm(both[3] - both[4]), 2, 0.02);
  EXPECT_LT(both[0].y, 4);
  EXPECT_LT(both[4].y, 4);
}

TEST(DrawMouths, LeaveOthersAsTheyAre) {
  EXPECT_EQ(drawn(plate({{-1, 8}, {7, 8}})).size(), 2u) << "a cell outside is enough";
  EXPECT_EQ(drawn(plate({{-3, 8}, {7, 8}})).size(), 2u);
  EXPECT_EQ(drawn(plate({{0.3, 8}, {7, 8}})).size(), 2u) << "a tip";
  EXPECT_EQ(drawn(plate({{5, 0.1}, {9, 0.1}})).size(), 2u) << "along the edge";
  Scene s = plate({{-3, 8}, {7, 8}});
  s.cracks.push_back(crack("branch", {{5, 8}, {5, 14}}));
  EXPECT_EQ(draw_mouths(s).cracks[1].points.size(), 2u) << "it ends on the other one";
}

TEST(DrawMouths, HalfWayToWhatSolidIsAhead) {
  const std::vector<Vec2> points = drawn(plate({{9, 15}, {12, 15}}));
  ASSERT_EQ(points.size(), 3u);
  expect_point(points[2], {12.75, 15});
}

TEST(DrawMouths, AHundredthOfACellOverAWall) {
  Scene s = plate({{0, 8}, {7, 8}});
  s.grid.lower.x = 0;
  const std::vector<Vec2> points = drawn(s);
  ASSERT_EQ(points.size(), 3u);
  EXPECT_NEAR(points[0].x, -0.01, 1e-12);
}

TEST(DrawMouths, MakeNoTips) {
  const Scene s = plate({{0, 8}, {7, 8}});
  EXPECT_EQ(end_of(s, 0, false), CrackEnd::mouth);
  EXPECT_EQ(end_of(s, 0, true), CrackEnd::tip);
  EXPECT_EQ(make_tips(s).size(), 1u);
  EXPECT_EQ(make_tips(draw_mouths(s)).size(), 1u);
}

}  // namespace
}  // namespace riven
