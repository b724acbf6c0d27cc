// Where the paths between particles and nodes see a crack end, and which nodes lie ahead of it.
#include "core/fracture/crack_path.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace riven {
namespace {

/// A crack and what is seen of it, with cells of 1 m.
struct Line {
  Cracks cracks;
  std::vector<Vec2> seen;
  PathEnds ends;

  Line(const std::vector<Vec2>& points, bool open_first, bool open_last) {
    cracks.names = {"line"};
    cracks.draw_back = own_length;
    const int count = static_cast<int>(points.size());
    cracks.start = {0, count};
    cracks.plane.resize(count);
    std::copy(points.begin(), points.end(), cracks.plane.begin());
    cracks.open.resize(2);
    cracks.set_open(0, false, open_first);
    cracks.set_open(0, true, open_last);
    seen.resize(points.size());
    ends = see_crack(cracks, 0, 1, seen.data());
  }
  Side cross(Vec2 p, Vec2 n) const {
    const CrackPath path{seen.data(), ends, 1};
    CrossingSum sum;
    for (int k = 0; k + 1 < cracks.points(); ++k)
      sum.add(path.crossed(p, n, k));
    return sum.side();
  }
};

void expect_at(Vec2 a, Vec2 b) {
  EXPECT_NEAR(a.x, b.x, 1e-15);
  EXPECT_NEAR(a.y, b.y, 1e-15);
}

TEST(CrackPath, IsDrawnBackFromOpenTips) {
  const Line one({{-2, 0}, {-.5, 0}, {0, 0}}, false, true);
  expect_at(one.seen[0], {-2, 0});
  expect_at(one.seen[1], {-.5, 0});
  expect_at(one.seen[2], {-own_length, 0});
  EXPECT_EQ(one.ends.point[0], 0);
  EXPECT_EQ(one.ends.point[1], 2);
  // around a corner and past several points, which are then seen in one place
  const Line bent({{0, 3}, {0, .2}, {0, 0}, {.1, 0}, {.2, 0}, {.3, 0}}, true, true);
  expect_at(bent.seen[0], {0, 3 - own_length});
  expect_at(bent.seen[1], {0, .2});
  for (int k : {2, 3, 4, 5})
    expect_at(bent.seen[static_cast<size_t>(k)], {0, own_length - .3});
  EXPECT_EQ(bent.ends.point[0], 0);
  EXPECT_EQ(bent.ends.point[1], 2);
  // a short crack keeps half of its length
  const Line small({{0, 0}, {.2, 0}, {.4, 0}}, true, true);
  expect_at(small.seen[0], {.1, 0});
  expect_at(small.seen[2], {.3, 0});
}

TEST(CrackPath, CrossesUpToItsEnd) {
  const Line line({{-2, 0}, {-.5, 0}, {0, 0}}, false, true);
  const double x = own_length;
  EXPECT_EQ(line.cross({-x - .01, 1}, {-x - .01, -1}), Side::above);
  EXPECT_EQ(line.cross({-x - .01, -1}, {-x - .01, 1}), Side::below);
  EXPECT_EQ(line.cross({-x + .01, 1}, {-x + .01, -1}), Side::none);
  EXPECT_EQ(line.cross({-2, 1}, {-2, 0}), Side::above);  // the other end is not open
}

TEST(CrackPath, LeavesNodesAheadThatAreNextToItsEnd) {
  // joints in the zone and out of it
  for (const double joint : {.5, .01, .09}) {
    const Line line({{-2, 0}, {-own_length - joint, 0}, {0, 0}}, false, true);
    const double edge = own_length + end_zone;
    for (const double p : {-1., 1.}) {
      EXPECT_EQ(line.cross({-.6, p}, {-edge + .01, 0}), Side::none);
      EXPECT_EQ(line.cross({-.6, p}, {-own_length - .05, -.03 * p}), Side::none);
      EXPECT_EQ(line.cross({-.6, p}, {-edge - .01, 0}), p > 0 ? Side::above : Side::below);
    }
  }
  // what lies beyond the zone is crossed all the same
  const Line line({{-2, 0}, {-own_length - .15, 0}, {0, 0}}, false, true);
  EXPECT_EQ(line.cross({-1.6, .02}, {-own_length - .09, -.01}), Side::above);
}

/// Pairs that mirror each other in the crack's line go across it, or not, alike, on the whole and each: with the tip at
/// places where, for particles at quarters of cells, paths to nodes meet, when particles and tip move a little, as they
/// do in mode II, and the nodes stay where they are.
TEST(CrackPath, IsTheSameOnBothSidesOfACrackOnAGridLineOrInMidCell) {
  int crossing = 0;
  for (const double row : {0., .5})  // of the crack's line above a row of nodes
    for (const double place : {0., 1. / 6, .2, .25, 1. / 3, .4, .5, .6, .75, .8, 5. / 6})
      for (const double off : {0., 1e-16, -1e-16, 1e-12, -1e-12, 1e-6, -1e-6})
        for (const Vec2 u : {Vec2{}, Vec2{1e-15, 1e-15}, Vec2{-1e-9, 2e-9}, Vec2{1e-4, -1e-4}}) {
          const double x0 = place + off;
          const Line line({{x0 - 4, row + u.y}, {x0 - .5, row + u.y}, {x0, row + u.y}}, false, true);
          for (double x = -1.25; x < 2; x += .5)
            for (double y = .25; y < 1.4; y += .5)
              for (double i = std::floor(x + .5) - 1; i <= std::floor(x + .5) + 1; ++i)
                for (double j = -1 - row; j <= row + 1; ++j) {
                  // the faces move past each other, by antisymmetry
                  const Side above = line.cross({x + u.x, row + y + u.y}, {i, row + j});
                  const Side below = line.cross({x - u.x, row - y + u.y}, {i, row - j});
                  crossing += above != Side::none;
                  if (j != 0) {  // else the node is on one side of a crack that has moved
                    ASSERT_EQ(above == Side::none, below == Side::none)
                        << row << ' ' << place << ' ' << off << ' ' << u.y << ": " << x << ' ' << y << ' ' << i << ' '
                        << j;
                  }
                }
          // of a node on the crack's line, all paths from one side cross, or none from either
          if (row == 0)
            for (double i = -1; i <= 2; ++i) {
              int count[2] = {0, 0};
              for (const double side : {1., -1.})
                for (double x = i - .75; x < i + 1; x += .5)
                  count[side < 0] += line.cross({x + side * u.x, side * .25 + u.y}, {i, 0}) != Side::none;
              ASSERT_TRUE((count[0] == 0 || count[0] == 4) && (count[1] == 0 || count[1] == 4))
                  << place << ' ' << off << ' ' << u.y << " node " << i;
            }
        }
  EXPECT_GT(crossing, 1000);
}

}  // namespace
}  // namespace riven
