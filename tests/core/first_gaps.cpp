// Gaps between cracks and solids as they lie at first, and particles with these gaps closed.
#include "core/state/first_gaps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/scene/scene.hpp"

namespace riven {
namespace {

Body body_of(Region region) {
  Body b;
  b.name = "body";
  b.region = std::move(region);
  return b;
}

Scene scene_of(std::vector<Region> bodies, std::vector<std::vector<Vec2>> cracks) {
  Scene s;
  s.cell = 1;
  s.grid = {{-40, -40}, {40, 60}};
  s.materials = {Material{"solid", LawKind::linear_elastic, 1e6, 0.3, 1000}};
  for (Region& r : bodies)
    s.bodies.push_back(body_of(std::move(r)));
  for (auto& points : cracks) {
    CrackLine c;
    c.name = "crack";
    c.points = std::move(points);
    s.cracks.push_back(c);
  }
  return s;
}

Cracks with_gaps(const Scene& s) {
  Cracks c = make_cracks(s, 0.5);
  c.gap = first_gaps(s, c);
  return c;
}

void expect_place(const ClosedGaps& gaps, Vec2 x, Vec2 closed) {
  const Vec2 is = gaps.place(x);
  EXPECT_NEAR(is.x, closed.x, 1e-6) << x.x << ' ' << x.y;
  EXPECT_NEAR(is.y, closed.y, 1e-6) << x.x << ' ' << x.y;
}

constexpr double aside = 0.01;  // cells, to either side of a point solids are seen, too
const Rectangle block{{-20, -10}, {20, 0}};
constexpr double radius = 30, nothing = std::numeric_limits<double>::infinity();

// A disk on a block, the crack along the block: radius - sqrt(radius^2 - x^2), and no block beyond its edges, where
// particles see what there is at these.
TEST(FirstGaps, UnderARoundPunch) {
  const Scene s = scene_of({block, Disk{{0, radius}, radius}}, {{{-22, 0}, {22, 0}}});
  EXPECT_TRUE(starts_apart(s));
  const Cracks c = with_gaps(s);
  ASSERT_EQ(c.gap.size(), c.points());
  for (int k = 0; k < c.points(); ++k) {
    const double x = std::max(std::abs(c.plane0[k].x) - aside, 0.), up = radius - std::sqrt(radius * radius - x * x);
    const bool on_block = x < 20;
    if (on_block) {
      EXPECT_NEAR(c.gap[k].x, up, 1e-6) << x;
      EXPECT_EQ(c.gap[k].y, 0) << x;
    } else {
      EXPECT_EQ(c.gap[k], (Vec2{nothing, nothing})) << x;
    }
  }
  const ClosedGaps closed(c, s.cell);
  const double near = 10 - aside;
  expect_place(closed, {10, 2.5}, {10, 2.5 - (radius - std::sqrt(radius * radius - near * near))});
  expect_place(closed, {10, -0.5}, {10, -0.5});
  expect_place(closed, {0, 40}, {0, 40});
}

// The crack along the disk, as chords of two cells: radius / cos - radius below it, to what a chord leaves of that.
TEST(FirstGaps, UnderARoundPunchWithTheCrackAlongIt) {
  std::vector<Vec2> arc;
  for (int k = -9; k <= 9; ++k)
    arc.push_back({radius * std::sin(2. * k / radius), radius - radius * std::cos(2. * k / radius)});
  const Scene s = scene_of({block, Disk{{0, radius}, radius}}, {arc});
  const Cracks c = with_gaps(s);
  ASSERT_EQ(c.gap.size(), c.points());
  const double sagitta = 1 / (2 * radius);
  for (int k = 0; k < c.points(); ++k) {
    const Vec2 r = c.plane0[k] - Vec2{0, radius};
    const double gap = radius * (norm(r) / -r.y) - radius;
    if (std::isinf(c.gap[k].y))  // over no block, along its normal
      continue;
    EXPECT_NEAR(c.gap[k].x + c.gap[k].y, gap, sagitta + 0.1 * gap) << r.x;
    EXPECT_LE(c.gap[k].x, sagitta) << r.x;
  }
}

// Solids that touch the crack, end at it or have it within; one that goes out of a slanted edge; one along a free edge.
TEST(FirstGaps, AreNoneWhereSolidsTouch) {
  const Polygon slanted{{{-20, -10}, {20, -10}, {10, 10}, {-10, 10}}};
  const double r = std::sqrt(0.5);
  const auto at = [&](double along, double up) { return Vec2{r * (along - up), r * (along + up)}; };
  const Polygon slope{{at(-20, -6), at(30, -6), at(30, 0), at(-20, 0)}},
      on_slope{{at(0, 0), at(16, 0), at(16, 8), at(0, 8)}};
  for (const Scene& s :
       {scene_of({block, Rectangle{{-20, 0}, {20, 10}}}, {{{-22, 0}, {22, 0}}}),
        scene_of({slope, on_slope}, {{at(-21, 0), at(31, 0)}}), scene_of({slope, on_slope}, {{at(31, 0), at(-21, 0)}}),
        scene_of({Rectangle{{-20, -10}, {20, 10}}}, {{{-22, 3}, {5, 1}}}), scene_of({slanted}, {{{5, 0}, {20, 0}}}),
        scene_of({block}, {{{-22, 0}, {22, 0}}})}) {
    EXPECT_EQ(with_gaps(s).gap.empty(), s.bodies.size() == 1);
    EXPECT_FALSE(starts_apart(s));
  }
  Scene s = scene_of({block, Rectangle{{-20, 0.5}, {20, 10}}}, {{{-22, 0}, {22, 0}}});
  EXPECT_TRUE(starts_apart(s));
  s.contact_rules.detection = ContactDetection::velocity;
  EXPECT_FALSE(starts_apart(s)) << "velocities know of no gap";
  s.contact_rules.detection = ContactDetection::displacement;
  s.contact.law = ContactLaw::bonded;
  EXPECT_FALSE(starts_apart(s)) << "bonded faces do not meet";
}

// Across a hole faces are as far apart as it is wide.
TEST(FirstGaps, AcrossAHole) {
  Scene s = scene_of({Rectangle{{-20, -20}, {20, 20}}}, {{{-10, 0}, {10, 0}}});
  s.bodies[0].holes = {Disk{{0, 0}, 3}};
  const Cracks c = with_gaps(s);
  ASSERT_EQ(c.gap.size(), c.points());
  for (int k = 0; k < c.points(); ++k) {
    const double x = c.plane0[k].x, out = std::abs(x) + aside, half = out < 3 ? std::sqrt(9 - out * out) : 0;
    if (half > 2) {
      EXPECT_EQ(c.gap[k], (Vec2{nothing, nothing})) << x << ": in the middle of it";
    } else {
      EXPECT_NEAR(c.gap[k].x, half, 1e-6) << x;
      EXPECT_NEAR(c.gap[k].y, half, 1e-6) << x;
    }
  }
}

// The mouth of a notch, from which rollers are seen on both sides, and a crack that goes on under a body beside its
// own.
TEST(FirstGaps, AreNoneToWhatIsSeenByTheWay) {
  const Rectangle beam{{-20, 0}, {20, 10}};
  const Scene notch = scene_of({beam, Disk{{-10, -4}, 4}, Disk{{10, -4}, 4}}, {{{0, -2}, {0, 4}}});
  EXPECT_FALSE(starts_apart(notch));
  const Cracks c = with_gaps(notch);
  for (int k = 0; k < c.points(); ++k)
    EXPECT_EQ(c.gap[k], c.plane0[k].y < -0.01 ? (Vec2{nothing, nothing}) : Vec2{}) << c.plane0[k].y;
  const Scene beside = scene_of({block, Rectangle{{21, 0.5}, {30, 10}}}, {{{-22, 0}, {23, 0}}});
  EXPECT_FALSE(starts_apart(beside));
  const Cracks d = with_gaps(beside);
  for (int k = 0; k < d.points(); ++k)
    EXPECT_EQ(d.gap[k], std::abs(d.plane0[k].x) <= 20 ? (Vec2{nothing, 0}) : (Vec2{nothing, nothing})) << d.plane0[k].x;
}

TEST(FirstGaps, OfACornerCloseBothWays) {
  const Scene s = scene_of({block, Rectangle{{-20, 0}, {-5, 20}}, Rectangle{{-4.7, 0.5}, {5, 20}}},
                           {{{-22, 0}, {22, 0}}, {{-5, 22}, {-5, -1}}});
  const Cracks c = with_gaps(s);
  const ClosedGaps closed(c, s.cell);
  expect_place(closed, {-4.25, 1.25}, {-4.55, 0.75});
  expect_place(closed, {2.25, 0.75}, {2.25, 0.25});
  expect_place(closed, {-4.25, 10}, {-4.55, 10});
  expect_place(closed, {-5.25, 0.25}, {-5.25, 0.25});
}

// A base under the block, wider than it: beyond the block the upper crack sees the base, but the lower crack is nearer.
TEST(FirstGaps, AreNoneAtANearerFaceWithout) {
  const Scene s = scene_of({block, Rectangle{{-30, 1}, {30, 5}}, Rectangle{{-30, -20}, {30, -10}}},
                           {{{-22, 0}, {22, 0}}, {{-22, -10}, {22, -10}}});
  const Cracks c = with_gaps(s);
  const ClosedGaps closed(c, s.cell);
  expect_place(closed, {10, 1.25}, {10, 0.25});
  expect_place(closed, {21, 1.25}, {21, 0.25});
  expect_place(closed, {10, -10.25}, {10, -10.25});
  expect_place(closed, {21, -10.25}, {21, -10.25});
}

}  // namespace
}  // namespace riven
