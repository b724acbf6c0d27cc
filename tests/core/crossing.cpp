// Exact signs of areas, the table of signs of Nairn, CMES 4 (2003) 649-663, appendix, and its reading at joints.
#include "core/fracture/crossing.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace riven {
namespace {

__extension__ using Wide = __int128;

/// Sign of the area for corners whose coordinates are whole numbers of at most 53 bits.
int integer_orientation(Vec2 a, Vec2 b, Vec2 c) {
  const auto whole = [](double x) { return static_cast<Wide>(static_cast<long long>(x)); };
  const Wide area =
      (whole(a.x) - whole(c.x)) * (whole(b.y) - whole(c.y)) - (whole(a.y) - whole(c.y)) * (whole(b.x) - whole(c.x));
  return (area > 0) - (area < 0);
}

TEST(Orientation, IsExactWhereRoundingDecidesOtherwise) {
  std::mt19937_64 random(1);
  std::uniform_int_distribution<long long> wide(-(1ll << 52), 1ll << 52), near(-2, 2);
  std::uniform_real_distribution<double> along(-1, 2);
  const auto quarter = [&] { return wide(random) / 4; };
  int rounded_wrongly = 0, zeros = 0;
  for (int i = 0; i < 200000; ++i) {
    const Vec2 a{double(quarter()), double(quarter())};
    const Vec2 b{double(quarter()), double(quarter())};
    const double t = along(random);
    // a point within a few units of the line, or, every fourth time, on it
    Vec2 c{std::round(a.x + t * (b.x - a.x)) + double(near(random)), std::round(a.y + t * (b.y - a.y))};
    if (i % 4 == 0)
      c = {2 * b.x - a.x, 2 * b.y - a.y};
    const int exact = integer_orientation(a, b, c);
    ASSERT_EQ(orientation(a, b, c), exact) << i;
    ASSERT_EQ(orientation(b, c, a), exact) << i;
    ASSERT_EQ(orientation(b, a, c), -exact) << i;
    const double plain = a.x * (b.y - c.y) + b.x * (c.y - a.y) + c.x * (a.y - b.y);
    rounded_wrongly += (plain > 0) - (plain < 0) != exact;
    zeros += exact == 0;
  }
  EXPECT_GT(rounded_wrongly, 1000);  // the test reaches what it is about
  EXPECT_GT(zeros, 40000);
}

TEST(Crossing, FollowsTheTableOfSignsForOneSegment) {
  const std::array<Vec2, 2> s{Vec2{0, 0}, Vec2{2, 0}};  // above is y > 0
  const auto cross_it = [&](Vec2 p, Vec2 n) { return crossing(p, n, s.data(), true, true); };
  EXPECT_EQ(cross_it({1, 1}, {1, -1}), +1);   // (-++-)
  EXPECT_EQ(cross_it({1, 1}, {1.5, 0}), +1);  // (-++0) node on the segment
  EXPECT_EQ(cross_it({1, 1}, {0, 0}), +1);    // (0++0) node on the start
  EXPECT_EQ(cross_it({1, 1}, {2, 0}), +1);    // (-0+0) node on the end
  EXPECT_EQ(cross_it({1, -1}, {1, 1}), -1);
  // what lies on the crack is on one side of it: nodes below, particles above
  EXPECT_EQ(cross_it({1, -1}, {1.5, 0}), 0);
  EXPECT_EQ(cross_it({1, -1}, {0, 0}), 0);
  EXPECT_EQ(cross_it({1, -1}, {2, 0}), 0);
  EXPECT_EQ(cross_it({1, 0}, {1, -1}), +1);
  EXPECT_EQ(cross_it({1, 0}, {-1, -1}), +1);
  EXPECT_EQ(cross_it({1, 0}, {1, 1}), 0);
  EXPECT_EQ(crossing({1, 0}, {1, -1}, s.data(), true, true, 0), 0);
  // all else does not cross
  EXPECT_EQ(cross_it({1, 1}, {1, .5}), 0);
  EXPECT_EQ(cross_it({3, 1}, {3, -1}), 0);
  EXPECT_EQ(cross_it({1, 1}, {3, 0}), 0);   // node in line with the segment, outside
  EXPECT_EQ(cross_it({0, 1}, {0, -1}), 0);  // path through the start
  EXPECT_EQ(cross_it({1, 1}, {3, -1}), 0);  // path through the end
  EXPECT_EQ(cross_it({3, 0}, {1, -1}), 0);  // particle in line with the segment, outside
  EXPECT_EQ(cross_it({0, 0}, {1, -1}), 0);  // particle on a tip
  EXPECT_EQ(cross_it({-1, 0}, {3, 0}), 0);  // path along the segment
  EXPECT_EQ(cross_it({-1, 0}, {1, 0}), 0);
}

Side cross_line(const std::vector<Vec2>& line, Vec2 p, Vec2 n) {
  CrossingSum sum;
  for (size_t k = 0; k + 1 < line.size(); ++k)
    sum.add(crossing(p, n, line.data() + k, k == 0, k + 2 == line.size()));
  return sum.side();
}

TEST(Crossing, OfALineIsTheSameWhereverItIsCut) {
  const std::vector<Vec2> whole{{0, 0}, {4, 0}}, cut{{0, 0}, {1, 0}, {2, 0}, {2.5, 0}, {4, 0}};
  for (double px = -1; px <= 5; px += .25)
    for (double py : {-1., -.25, 0., .25, 1.})
      for (double nx = -1; nx <= 5; nx += .25)
        for (double ny : {-1., -.5, 0., .5, 1.})
          ASSERT_EQ(cross_line(cut, {px, py}, {nx, ny}), cross_line(whole, {px, py}, {nx, ny}))
              << px << ' ' << py << ' ' << nx << ' ' << ny;
}

TEST(Crossing, AtAKinkCountsOnceOrEvenly) {
  const std::vector<Vec2> roof{{-1, -1}, {0, 0}, {1, -1}};
  EXPECT_EQ(cross_line(roof, {0, 1}, {0, -1}), Side::above);  // through the joint, to the other side
  EXPECT_EQ(cross_line(roof, {0, -1}, {0, 1}), Side::below);
  EXPECT_EQ(cross_line(roof, {-1, 0}, {1, 0}), Side::none);  // touches the joint from outside
  EXPECT_EQ(cross_line(roof, {1, 0}, {-1, 0}), Side::none);
  EXPECT_EQ(cross_line(roof, {0, 1}, {0, 0}), Side::above);  // node on the joint
  EXPECT_EQ(cross_line(roof, {0, -1}, {0, 0}), Side::none);
  EXPECT_EQ(cross_line(roof, {1, 1}, {0, 0}), Side::above);   // in line with the first segment
  EXPECT_EQ(cross_line(roof, {-1, 1}, {0, 0}), Side::above);  // in line with the second
  EXPECT_EQ(cross_line(roof, {0, 0}, {0, -1}), Side::above);  // particle on the joint
  EXPECT_EQ(cross_line(roof, {0, 0}, {0, 1}), Side::none);
  const std::vector<Vec2> step{{0, -1}, {0, 0}, {1, 0}, {1, 1}};  // a path along the middle segment
  EXPECT_EQ(cross_line(step, {-1, 0}, {2, 0}), Side::above);
  EXPECT_EQ(cross_line(step, {2, 0}, {-1, 0}), Side::below);
}

TEST(Crossing, ReportsTheSideThatPrevailsInAFold) {
  // entered from above, left from below, entered again
  const std::vector<Vec2> fold{{-1, 2}, {1, 2}, {1, 1}, {-1, 1}, {-1, 0}, {1, 0}};
  EXPECT_EQ(cross_line(fold, {0, 3}, {0, -1}), Side::above);
  EXPECT_EQ(cross_line(fold, {0, -1}, {0, 3}), Side::below);
  EXPECT_EQ(cross_line(fold, {0, 3}, {0, .5}), Side::none);
}

}  // namespace
}  // namespace riven
