// The opening behind a tip, from which K_I and K_II are told apart.
#include "core/fracture/opening.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace riven {
namespace {

/// A straight crack of points half a cell (1 m) apart, from `a` along `t`, whose faces part as `gap(distance)` from
/// either end: x across the crack, towards above, y along `t`.
template <class F>
Cracks open_crack(Vec2 a, Vec2 t, int segments, const F& gap) {
  Scene scene;
  CrackLine line;
  const double length = 0.5 * segments;
  line.points = {a, a + length * t};
  scene.cracks = {line};
  Cracks cracks = make_cracks(scene, 0.5);
  for (int k = 0; k < cracks.points(); ++k) {
    const double s = norm(cracks.plane[k] - a);
    const Vec2 g = gap(std::min(s, length - s)), half = 0.5 * (g.x * turned(t) + g.y * t);
    cracks.upper[k] = cracks.plane[k] + half;
    cracks.lower[k] = cracks.plane[k] - half;
  }
  return cracks;
}

TEST(Opening, IsTheFirstTermOfTheExpansionBehindEitherEnd) {
  for (const double angle : {0.0, 0.7, 2.0, 4.1}) {
    const Vec2 t{std::cos(angle), std::sin(angle)};
    const auto gap = [](double r) { return std::sqrt(r) * Vec2{0.03 * (1 + 0.1 * r), 0.02 * (1 - 0.05 * r)}; };
    const Cracks cracks = open_crack({1, 2}, t, 40, gap);
    Tip tip;
    tip.last = true;
    const Vec2 end = opening_behind(cracks, tip, 1);
    EXPECT_NEAR(end.x, 0.03, 1e-6);
    EXPECT_NEAR(end.y, 0.02, 1e-6);
    // seen from the other end the upper face is on the right, and what is forwards is back
    tip.last = false;
    const Vec2 start = opening_behind(cracks, tip, 1);
    EXPECT_NEAR(start.x, 0.03, 1e-6);
    EXPECT_NEAR(start.y, 0.02, 1e-6);
  }
}

TEST(Opening, OfAShortCrackIsThatOfItsPoints) {
  const auto gap = [](double r) { return std::sqrt(r) * Vec2{0.03, -0.02}; };
  for (const int segments : {2, 4, 7}) {
    const Cracks cracks = open_crack({0, 0}, {1, 0}, segments, gap);
    Tip tip;
    for (const bool last : {false, true}) {
      tip.last = last;
      const Vec2 o = opening_behind(cracks, tip, 1);
      EXPECT_GT(o.x, 0) << segments;
      EXPECT_NEAR(o.y, -o.x * 2 / 3, 1e-9) << segments;
    }
  }
}

/// Behind a crack across, the faces have moved apart by as much as they like.
TEST(Opening, StopsWhereAnotherCrackCutsTheFaces) {
  const auto gap = [](double r) { return r < 2.7 ? std::sqrt(r) * Vec2{0.03, -0.02} : Vec2{5, -7}; };
  const Cracks cracks = open_crack({0, 0}, {1, 0}, 40, gap);
  Tip tip;
  for (const bool last : {false, true}) {
    tip.last = last;
    const Vec2 o = opening_behind(cracks, tip, 1, 2.7);
    EXPECT_NEAR(o.x, 0.03, 1e-9);
    EXPECT_NEAR(o.y, -0.02, 1e-9);
  }
}

}  // namespace
}  // namespace riven
