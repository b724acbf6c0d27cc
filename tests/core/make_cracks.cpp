// The points of a crack, from those that a scene gives.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/state/cracks.hpp"

namespace riven {
namespace {

constexpr double cell = 2;

Scene scene_of(std::vector<Vec2> points) {
  Scene s;
  s.cell = cell;
  CrackLine line;
  line.name = "crack";
  line.points = std::move(points);
  s.cracks.push_back(line);
  return s;
}

double distance_from(const Cracks& c, Vec2 x) {
  double least = 1e9;
  for (int k = 0; k + 1 < c.points(); ++k) {
    const Vec2 a = c.plane[k], d = c.plane[k + 1] - a;
    const double along = std::clamp(dot(x - a, d) / dot(d, d), 0., 1.);
    least = std::min(least, norm(x - a - along * d));
  }
  return least;
}

TEST(PointsOfACrack, AreThoseGivenAndWhatTheResolutionAsksFor) {
  const Cracks c = make_cracks(scene_of({{0, 0}, {0.3, 0}, {0.6, 0.1}, {3.6, 0.1}}), 1);
  ASSERT_EQ(c.points(), 6);
  EXPECT_EQ(c.plane[1], (Vec2{0.3, 0}));
  EXPECT_EQ(c.plane[2], (Vec2{0.6, 0.1}));
  EXPECT_DOUBLE_EQ(c.plane[3].x, 1.6);
}

/// Of a wave in a thousand points, as of a straight line in as many, those stay that the grid can tell from the rest.
TEST(PointsOfACrack, AreThinnedWhereTheyCrowd) {
  constexpr int many = 1000;
  for (const double amplitude : {0., 0.5 * cell}) {
    std::vector<Vec2> points;
    for (int k = 0; k < many; ++k) {
      const double x = 10. * k / (many - 1);
      points.push_back({x, amplitude * std::sin(2 * std::numbers::pi * x / 5)});
    }
    const Cracks c = make_cracks(scene_of(points), 1);
    EXPECT_EQ(c.plane[0], points.front());
    EXPECT_EQ(c.plane[c.points() - 1], points.back());
    EXPECT_LT(c.points(), amplitude > 0 ? many / 5 : 12);
    double most = 0;
    for (const Vec2 x : points)
      most = std::max(most, distance_from(c, x));
    EXPECT_LE(most, 5e-4 * cell);
    for (int k = 0; k + 1 < c.points(); ++k)
      EXPECT_LE(norm(c.plane[k + 1] - c.plane[k]), 1 + 1e-9);
  }
}

TEST(PointsOfACrack, OfARingStayARing) {
  std::vector<Vec2> points;
  for (int k = 0; k <= 500; ++k) {
    const double angle = 2 * std::numbers::pi * (k % 500) / 500;
    points.push_back({3 * std::cos(angle), 3 * std::sin(angle)});
  }
  const Cracks c = make_cracks(scene_of(points), 1);
  EXPECT_LT(c.points(), 200);
  for (const Vec2 x : points)
    EXPECT_LE(distance_from(c, x), 5e-4 * cell);
}

}  // namespace
}  // namespace riven
