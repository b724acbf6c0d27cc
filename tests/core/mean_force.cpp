// Reactions as results report them: the impulse since the row before over its time.
#include <gtest/gtest.h>

#include "core/state/constraints.hpp"

namespace riven {
namespace {

TEST(MeanForce, IsTheImpulseSinceTheRowBeforeOverItsTime) {
  MeanForce mean;
  mean.add({3, 0}, 1);
  mean.add({0, 9}, 2);
  mean.take(1);
  EXPECT_EQ(mean.value.x, 1);
  EXPECT_EQ(mean.value.y, 3);
  mean.add({8, 8}, 2);
  mean.take(1);
  EXPECT_EQ(mean.value.x, 4);
  EXPECT_EQ(mean.value.y, 4);
}

/// The last step of a run may be a millionth of the others, and its force anything.
TEST(MeanForce, TakesTheTimeBeforeInWhereARowIsShort) {
  MeanForce mean;
  mean.add({10, 0}, 10);
  mean.take(1);
  mean.add({-1, 0}, 0.001);
  mean.take(1);
  EXPECT_NEAR(mean.value.x, 9 / 10.001, 1e-12);
}

}  // namespace
}  // namespace riven
