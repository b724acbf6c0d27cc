// On which side of a bent crack a place lies, as the fields around its tip see it.
#include "core/fracture/branch_cut.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/fracture/opening.hpp"
#include "core/fracture/place_domain.hpp"
#include "core/scene/scene.hpp"

namespace riven {
namespace {

Cracks one_crack(std::vector<Vec2> points) {
  Scene scene;
  CrackLine line;
  line.points = std::move(points);
  scene.cracks = {line};
  return make_cracks(scene, 0.5);
}

/// A square domain, of which no part is farther than so from the tip.
JDomain domain_of(const Cracks& cracks, const Tip& tip, double far) {
  const double reach = far / std::sqrt(2) - 0.5;
  const double edges[4] = {reach, reach, reach, reach};
  return plain_domain(cracks.plane[cracks.end_point(tip.crack, tip.last)], edges, 0.5);
}

std::optional<BranchCut> cut_of(const Cracks& cracks, bool last, double far = 6) {
  Tip tip;
  tip.last = last;
  return BranchCut::along(cracks, tip, heading_of(cracks, tip),
                          WayFromTip::of(cracks, tip, domain_of(cracks, tip, far)));
}

TEST(BranchCut, IsThatOfTheFieldsThemselvesBehindAStraightTip) {
  EXPECT_FALSE(cut_of(one_crack({{-10, 0}, {0, 0.1}}), true));
  EXPECT_FALSE(cut_of(one_crack({{-10, 5}, {-7, 0}, {0, 0}}), true)) << "what is farther than it is asked for";
  EXPECT_TRUE(cut_of(one_crack({{-10, 5}, {-3, 0}, {0, 0}}), true));
}

TEST(BranchCut, FollowsTheCrackUpToWhereItComesBack) {
  const std::vector<Vec2> hook{{-2, 3}, {-3, 2}, {-4, 0}, {0, 0}};
  const Cracks cracks = one_crack(hook);
  for (const bool last : {true, false}) {
    Tip tip;
    tip.last = last;
    const double far = last ? 10 : 1.5;  // the first tip's crack has run far enough before it turns
    const Vec2 until = cracks.plane[WayFromTip::of(cracks, tip, domain_of(cracks, tip, far)).until];
    EXPECT_NEAR(norm(until - (last ? Vec2{-4, 0} : Vec2{-3, 2})), 0, 0.5) << last;
  }
  const auto cut = cut_of(cracks, true, 10);
  EXPECT_FALSE(cut) << "straight up to there";
  const auto bent = cut_of(one_crack({{-1, 4}, {-5, 4}, {-4, 1}, {-3, 0}, {0, 0}}), true, 10);
  ASSERT_TRUE(bent);
  const double far = norm(Vec2{-5, 4});
  EXPECT_EQ(bent->sign(1.5 * Vec2{-5, 4} + Vec2{0.1, 0.2}), 1) << "straight on from where it comes back, at " << far;
  EXPECT_EQ(bent->sign(1.5 * Vec2{-5, 4} - Vec2{0.1, 0.2}), -1);
}

// The crack ends on another one, on either end of which, or on one alone, there is a way out of the domain.
TEST(BranchCut, GoesOnAlongTheCrackOnWhichItsOwnEnds) {
  for (const bool up : {false, true}) {
    Scene scene;
    CrackLine own, host;
    own.points = {{0, 0}, {3, 0}};
    host.points = {{0, up ? -1.0 : -9.0}, {0, 9}};
    scene.cracks = {own, host};
    Cracks cracks = make_cracks(scene, 0.5);
    Junction j;
    j.other = 1;
    j.segment = up ? 2 : 18;
    cracks.junctions.push_back(j);
    Tip tip;
    tip.last = true;
    const WayFromTip way = WayFromTip::of(cracks, tip, domain_of(cracks, tip, 8));
    EXPECT_EQ(way.host, 1);
    EXPECT_EQ(way.host_step, up ? 1 : -1);
    const auto cut = BranchCut::along(cracks, tip, heading_of(cracks, tip), way);
    ASSERT_TRUE(cut);
    // between the line behind the tip and the other crack, on the side to which the cut goes
    for (const double y : {-1.0, 1.0}) {
      EXPECT_EQ(cut->sign(Vec2{-2, y} - Vec2{3, 0}), (y > 0) == up ? -1 : 1) << up << y;
      EXPECT_EQ(cut->sign(Vec2{1, 2 * y} - Vec2{3, 0}), 1) << up << y;
      EXPECT_EQ(cut->sign(Vec2{4, 2 * y} - Vec2{3, 0}), 1) << up << y;
    }
  }
}

// Going round the tip from straight ahead to a place, without a step over the crack, the half angle goes on; the fields
// as written have it jump where it passes the line behind the tip.
TEST(BranchCut, HasTheSignThatGoesOnRoundTheTip) {
  constexpr double pi = std::numbers::pi;
  for (const double turn : {0.4, -0.4, 1.2, -1.2, 1.5, -1.5})  // of the heading against the crack behind the bend
    for (const bool last : {true, false}) {
      const Vec2 bend{1, 2}, t{std::cos(turn), std::sin(turn)}, end = bend + 2 * t;
      std::vector<Vec2> points{bend - Vec2{9, 0}, bend, end};
      if (!last)
        std::reverse(points.begin(), points.end());
      const auto cut = cut_of(one_crack(points), last);
      ASSERT_TRUE(cut) << turn;
      for (const double R : {0.5, 2.5, 4.0, 5.5}) {
        // the crack at this distance: on the arm, or behind the bend where |end - (bend - s)| = R
        double of_crack = pi;
        if (R > 2) {
          const double s = -2 * std::cos(turn) + std::sqrt(R * R - 4 * std::sin(turn) * std::sin(turn));
          const Vec2 r = bend - Vec2{s, 0} - end;
          of_crack = std::atan2(cross(t, r), dot(t, r));
          if (of_crack < 0 && turn > 0)
            of_crack += 2 * pi;
          if (of_crack > 0 && turn < 0)
            of_crack -= 2 * pi;
        }
        // angles from the right face round to the left one
        const double left = of_crack > 0 ? of_crack : of_crack + 2 * pi, right = left - 2 * pi;
        for (double a = right + 0.05; a < left; a += 0.1) {
          const bool passed = a > pi || a < -pi;
          EXPECT_EQ(cut->sign({R * std::cos(a), R * std::sin(a)}), passed ? -1 : 1)
              << "turn " << turn << " last " << last << " R " << R << " angle " << a;
        }
      }
    }
}

}  // namespace
}  // namespace riven
