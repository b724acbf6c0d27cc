// Points added at the ends of cracks, what lies in their way, and ends that are tied to other cracks.
#include "core/fracture/extend_crack.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/state/junctions.hpp"

namespace riven {
namespace {

Cracks cracks_of(const std::vector<std::vector<Vec2>>& lines) {
  Scene scene;
  for (const auto& points : lines) {
    CrackLine line;
    line.name = "crack " + std::to_string(scene.cracks.size());
    line.points = points;
    scene.cracks.push_back(line);
  }
  return make_cracks(scene, 1);
}

std::vector<Vec2> line_of(const Cracks& c, int crack) {
  const auto k = static_cast<size_t>(crack);
  return {c.plane.begin() + c.start[k], c.plane.begin() + c.start[k + 1]};
}

const std::vector<std::vector<Vec2>> three{{{0, 0}, {2, 0}}, {{5, 1}, {5, 4}}, {{9, 9}, {10, 9}}};

TEST(ExtendCrack, AddsAPointAtEitherEndAndMovesTheRest) {
  for (const int crack : {0, 1, 2})
    for (const bool last : {false, true}) {
      Cracks c = cracks_of(three);
      c.jump.resize(c.points());
      for (int k = 0; k < c.points(); ++k) {
        c.upper_velocity[k] = {double(k), 1};
        c.lower_velocity[k] = {double(k), 3};
        c.jump[k] = {double(k), 7};
      }
      const Cracks before = c;
      const Vec2 to{4, -3}, first{4.5, -3.5};
      const int at = extend_crack(c, crack, last, to, first);
      EXPECT_EQ(c.points(), before.points() + 1);
      EXPECT_EQ(at, c.end_point(crack, last));
      c.each_point_array([&](const auto& a) { EXPECT_EQ(a.size(), c.points()); });
      for (int other = 0; other < 3; ++other) {
        std::vector<Vec2> expected = line_of(before, other);
        if (other == crack)
          expected.insert(last ? expected.end() : expected.begin(), to);
        EXPECT_EQ(line_of(c, other), expected);
      }
      for (int k = 0; k < c.points(); ++k) {
        EXPECT_EQ(k >= c.start[static_cast<size_t>(c.crack[k])] && k < c.start[static_cast<size_t>(c.crack[k]) + 1],
                  true);
        if (k == at)
          continue;
        const int was = k - (k > at);
        EXPECT_EQ(c.jump[k], before.jump[was]);
        EXPECT_EQ(c.upper_velocity[k], before.upper_velocity[was]);
        EXPECT_EQ(c.upper[k], before.upper[was]);
      }
      const double end = before.end_point(crack, last);
      EXPECT_EQ(c.upper[at], to);
      EXPECT_EQ(c.lower[at], to);
      EXPECT_EQ(c.plane0[at], first);
      EXPECT_EQ(c.jump[at], Vec2{});
      EXPECT_EQ(c.upper_velocity[at], (Vec2{end, 2}));
      EXPECT_EQ(c.lower_velocity[at], (Vec2{end, 2}));
    }
}

TEST(ExtendCrack, SeesTheFirstCrackInItsWay) {
  const Cracks c = cracks_of({{{0, 0}, {2, 0}}, {{5, -2}, {5, 4}}, {{6, -2}, {6, 4}}, {{3, 0.3}, {3, 2}}});
  const Vec2 x{1, 0};
  EXPECT_FALSE(first_obstacle(c, 0, true, x, 2.9, 0.2));
  const auto cross = first_obstacle(c, 0, true, x, 9, 0.2);
  ASSERT_TRUE(cross);
  EXPECT_EQ(cross->on.other, 1);
  EXPECT_EQ(cross->on.segment, 1);  // from -1 to 0: way through a joint
  EXPECT_NEAR(cross->on.along, 1, 1e-12);
  EXPECT_NEAR(cross->distance, 3, 1e-12);
  EXPECT_LT(norm(cross->place - Vec2{5, 0}), 1e-12);
  EXPECT_FALSE(cross->end);
  const auto end = first_obstacle(c, 0, true, x, 9, 0.4);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->on.other, 3);
  EXPECT_TRUE(end->end);
  EXPECT_FALSE(end->end_last);
  EXPECT_EQ(end->place, (Vec2{3, 0.3}));
  EXPECT_FALSE(first_obstacle(c, 0, false, -x, 9, 0.4));
  EXPECT_FALSE(first_obstacle(c, 0, true, {0, 1}, 9, 0.4));
}

TEST(ExtendCrack, SeesItselfFurtherAlong) {
  const Cracks c = cracks_of({{{0, 0}, {4, 0}, {4, 2}, {1, 2}}});
  const auto o = first_obstacle(c, 0, true, {0, -1}, 3, 0.1);
  ASSERT_TRUE(o);
  EXPECT_EQ(o->on.other, 0);
  EXPECT_NEAR(o->distance, 2, 1e-12);
  EXPECT_FALSE(first_obstacle(c, 0, true, {-1, 0}, 3, 0.1));
}

/// A tied end stays on the segment that it joined while that crack moves and grows at both ends.
TEST(ExtendCrack, ATiedEndMovesWithTheCrackThatItJoined) {
  const double h = 0.5;
  Cracks c = cracks_of({{{0, 0.3}, {2, 0.3}}, {{5, -2}, {5, 4}}});
  const auto o = first_obstacle(c, 0, true, {1, 0}, 9, 0.1);
  ASSERT_TRUE(o);
  join_crack(c, *o, {5, 0.3}, h);
  const auto end = [&] { return c.plane[c.end_point(0, true)]; };
  EXPECT_NEAR(end().x, 5 + 1e-6 * h, 1e-15);  // over it, so that no path leads through
  EXPECT_NEAR(end().y, 0.3, 1e-15);
  EXPECT_LT(c.upper[c.end_point(0, true)].x, 5);
  extend_crack(c, 1, false, {5, -3}, {5, -3});
  extend_crack(c, 1, true, {5, 5}, {5, 5});
  extend_crack(c, 0, false, {-1, 0.3}, {-1, 0.3});
  for (int k = c.start[1]; k < c.start[2]; ++k)
    c.plane[k] += Vec2{0.1 * c.plane[k].y, 0.2 * c.plane[k].y};
  tie_junctions(c, h);
  EXPECT_NEAR(end().x, 5 + 0.03, 1e-6);
  EXPECT_NEAR(end().y, 0.36, 1e-6);
}

TEST(ExtendCrack, ACrackMayJoinItself) {
  for (const bool last : {false, true}) {
    std::vector<Vec2> line{{0.4, 0}, {4.4, 0}, {4.4, 2}, {1, 2}};
    if (!last)
      std::reverse(line.begin(), line.end());
    Cracks c = cracks_of({line});
    const auto o = first_obstacle(c, 0, last, {0, -1}, 3, 0.1);
    ASSERT_TRUE(o);
    join_crack(c, *o, {1, 0}, 1);
    const Vec2 end = c.plane[c.end_point(0, last)];
    EXPECT_NEAR(end.x, 1, 1e-12);
    EXPECT_NEAR(end.y, -1e-6, 1e-12);
    extend_crack(c, 0, !last, {0, 0}, {0, 0});
    tie_junctions(c, 1);
    EXPECT_NEAR(c.plane[c.end_point(0, last)].x, 1, 1e-12);
  }
}

}  // namespace
}  // namespace riven
