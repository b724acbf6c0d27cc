// The opening of a crack as probes read it.
#include "io/crack_opening.hpp"

#include <gtest/gtest.h>

#include "core/state/bodies_at_cracks.hpp"
#include "tests/io/small_run.hpp"

namespace riven {
namespace {

// From outside of the block through it: points beyond its edge, which move with what is near, are not read.
TEST(CrackOpening, IsThatOfPointsInSolid) {
  const Scene scene = test::small({}, "x0_mm,y0_mm,x1_mm,y1_mm\n-1.5,4,9.5,4\n");
  const test::ChosenSpace space;
  Simulation m(scene, space);
  Cracks& c = m.state.cracks;
  int inside = 0;
  for (int k = 0; k < c.points(); ++k) {
    const bool within = c.plane0[k].x > -1e-9 && c.plane0[k].x < 8e-3 + 1e-9;
    EXPECT_EQ(has_solid_beside(scene, c, k), within) << c.plane0[k].x;
    c.upper[k].y += within ? 2e-5 : 1e-3;
    inside += within;
  }
  ASSERT_GT(inside, 10);
  ASSERT_LT(inside, c.points() - 3);
  EXPECT_NEAR(extreme_opening(scene, c, 0), 2e-5, 1e-12);
}

// Along the border of a body there is solid on one side.
TEST(CrackOpening, CountsPointsAlongABorder) {
  const Scene scene = test::small({}, "x0_mm,y0_mm,x1_mm,y1_mm\n0,8,8,8\n");
  const test::ChosenSpace space;
  Simulation m(scene, space);
  Cracks& c = m.state.cracks;
  for (int k = 0; k < c.points(); ++k)
    c.upper[k].y += 1e-5;
  EXPECT_NEAR(extreme_opening(scene, c, 0), 1e-5, 1e-12);
}

}  // namespace
}  // namespace riven
