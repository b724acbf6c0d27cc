// Ends of cracks that lie on other cracks from the start are tied to them.
#include "core/state/junctions.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/fracture/crossing.hpp"

namespace riven {
namespace {

/// A plate of 20 x 20, cells of 1, two particles along each axis: ends within almost 0.25 of a crack are on it.
Scene plate(const std::vector<std::vector<Vec2>>& lines) {
  Scene s;
  s.cell = 1;
  s.materials.resize(1);
  s.bodies.resize(1);
  s.bodies[0].region = Rectangle{{0, 0}, {20, 20}};
  for (const auto& points : lines) {
    CrackLine c;
    c.points = points;
    s.cracks.push_back(c);
  }
  return s;
}

Cracks tied(const std::vector<std::vector<Vec2>>& lines) {
  const Scene s = plate(lines);
  Cracks c = make_cracks(s, 0.5);
  tie_from_start(s, c);
  return c;
}

struct Tie {
  int crack;
  bool last;
  int other;
  double at;  ///< segments from the first point of the other
  bool operator==(const Tie&) const = default;
};
void PrintTo(const Tie& t, std::ostream* out) {
  *out << "crack " << t.crack << (t.last ? " last" : " first") << " on " << t.other << " at " << t.at;
}

std::vector<Tie> ties(const std::vector<std::vector<Vec2>>& lines) {
  std::vector<Tie> all;
  const Cracks c = tied(lines);
  for (const Junction& j : c.junctions)
    all.push_back({j.crack, j.last, j.other, j.segment + j.along});
  return all;
}

using Ties = std::vector<Tie>;

TEST(Junctions, AreEndsNearAnotherCrack) {
  EXPECT_EQ(ties({{{2, 4}, {8, 4}}, {{5, 4}, {5, 2}}}), (Ties{{1, false, 0, 6}}));            // T
  EXPECT_EQ(ties({{{2, 4}, {8, 4}}, {{5.125, 4.2}, {5, 2}}}), (Ties{{1, false, 0, 6.25}}));   // just over it
  EXPECT_EQ(ties({{{2, 4}, {8, 4}}, {{5, 4.25}, {5, 6}}}), Ties{});                           // half a particle away
  EXPECT_EQ(ties({{{2, 4}, {8, 4}}, {{5, 2}, {5, 6}}}), Ties{});                              // crossing
  EXPECT_EQ(ties({{{2, 4}, {8, 4}}, {{5, 2}, {5, 4}, {7, 4.1}}}), (Ties{{1, true, 0, 10}}));  // along it
  EXPECT_EQ(ties({{{-2, 4}, {8, 4}}, {{-1, 4}, {5, 2}}}), Ties{});                            // outside of all bodies
}

TEST(Junctions, AreEndsThatMeet) {
  EXPECT_EQ(ties({{{2, 4}, {5, 4}}, {{5, 4}, {8, 4}}}), (Ties{{1, false, 0, 6}}));
  EXPECT_EQ(ties({{{5, 4}, {2, 4}}, {{8, 4}, {5.1, 4.1}}}), (Ties{{1, true, 0, 0}}));
  EXPECT_EQ(ties({{{5, 4}, {2, 4}}, {{5, 4}, {8, 4}}, {{5, 9}, {5, 4}}}), (Ties{{1, false, 0, 0}, {2, true, 0, 0}}));
  // a corner in whose reach both ends also lie beside the other crack
  EXPECT_EQ(ties({{{2, 4}, {5.1, 4}}, {{5, 3.9}, {5, 8}}}), (Ties{{1, false, 0, 7}}));
  // two that end one on the other are tied once, or each would follow the other
  EXPECT_EQ(ties({{{2, 4}, {5, 4.1}}, {{4.9, 4}, {8, 4.1}}}).size(), 1u);
}

TEST(Junctions, AreWhereACrackMeetsItself) {
  EXPECT_EQ(ties({{{4, 4}, {8, 4}, {8, 8}, {4, 4}}}), (Ties{{0, true, 0, 0}}));    // closed
  EXPECT_EQ(ties({{{4, 4}, {8, 4}, {8, 6}, {6, 4}}}), (Ties{{0, true, 0, 4}}));    // ends on its first part
  EXPECT_EQ(ties({{{6, 4}, {8, 6}, {8, 4}, {4, 4}}}), (Ties{{0, false, 0, 14}}));  // begins on its last
  EXPECT_EQ(ties({{{4, 4}, {8, 4}, {8, 8}, {4, 8}}}), Ties{});
  EXPECT_EQ(ties({{{4, 4}, {4.1, 4}, {4.1, 4.1}, {4, 8}}}), Ties{});  // turns sharply near its end
}

TEST(Junctions, AreNotTheEndsOfACrackForItsBeingShort) {
  EXPECT_EQ(ties({{{4, 4}, {4.01, 4}}}), Ties{});
  EXPECT_EQ(ties({{{4, 4}, {4.2, 4.2}, {4.01, 4}}}), Ties{});
}

/// The tied end reaches over what it meets, and its surfaces begin on its own side.
TEST(Junctions, BeginOnTheCrackThatTheyMeet) {
  const Cracks c = tied({{{2, 4}, {8, 4}}, {{5, 4.2}, {5, 2}}});
  const int end = c.end_point(1, false);
  EXPECT_NEAR(c.plane[end].y, 4 + overshoot, 1e-12);
  EXPECT_NEAR(c.upper[end].y, 4 - overshoot, 1e-12);
  EXPECT_EQ(c.lower[end], c.upper[end]);
  EXPECT_EQ(c.plane0[end], (Vec2{5, 4}));
}

bool passes(const Cracks& c, Vec2 from, Vec2 to) {
  for (int crack = 0; crack < c.count(); ++crack) {
    CrossingSum sum;
    for (int k = c.end_point(crack, false); k < c.end_point(crack, true); ++k)
      sum.add(crossing(from, to, &c.plane[k], k == c.end_point(crack, false), k + 1 == c.end_point(crack, true)));
    if (sum.side() != Side::none)
      return false;
  }
  return true;
}

/// Two cracks end to end, moved about by rounding, let no path through where they meet.
TEST(Junctions, LetNoPathThrough) {
  const auto leaks = [](bool tie) {
    Scene s = plate({{{2, 4}, {5, 4}}, {{5, 4}, {8, 4}}});
    Cracks c = make_cracks(s, 0.5);
    if (tie)
      tie_from_start(s, c);
    int count = 0;
    for (int k = 0; k < 200; ++k) {
      const double angle = 0.1 * k, nudge = 1e-13;
      c.plane[c.end_point(0, true)] = {5 + nudge * std::cos(angle), 4 + nudge * std::sin(angle)};
      c.plane[c.end_point(1, false)] = {5 - nudge * std::cos(3 * angle), 4 + nudge * std::sin(5 * angle)};
      if (tie)
        tie_junctions(c, s.cell);
      for (const double slope : {-1., -0.3, 0., 0.4, 2.})
        count += passes(c, {5 - slope, 5}, {5 + slope, 3});
    }
    return count;
  };
  EXPECT_GT(leaks(false), 0);
  EXPECT_EQ(leaks(true), 0);
}

}  // namespace
}  // namespace riven
