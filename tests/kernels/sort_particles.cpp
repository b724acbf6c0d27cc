// When particles are sorted again.
#include "kernels/sort_particles.hpp"

#include <gtest/gtest.h>

namespace riven {
namespace {

/// Whether particles that have drifted by so many cells in so many steps, moving by a thousandth of a cell a step, are
/// to be sorted.
bool due(double cells, long steps, StressUpdate update = StressUpdate::usl, bool cracks = false) {
  Plan plan{};
  plan.update = update;
  plan.cracks = cracks;
  State<double, 2> s;
  s.grid.lattice.h = 0.5;
  s.particles.tiles.start.resize(2);
  s.watch.largest_move = 1e-3 * s.grid.lattice.h;
  s.watch.drift = cells * s.grid.lattice.h;
  s.watch.sorted_at = 100;
  s.clock.step = 100 + steps;
  return sort_due(plan, s);
}

TEST(SortParticles, IsDueBeforeAnyLeavesTheReachOfItsTile) {
  EXPECT_TRUE(due(0.95, 1));
  EXPECT_FALSE(due(0.94, 1));
}

TEST(SortParticles, PaysEarlierWhereParticlesAreSlow) {
  EXPECT_FALSE(due(0.3, 10));
  EXPECT_TRUE(due(0.3, 100));
  EXPECT_FALSE(due(0.2, 100000));  // little to gain yet
}

TEST(SortParticles, PaysSoonWhereManyPassesGain) {
  EXPECT_TRUE(due(0.3, 10, StressUpdate::usavg));
  EXPECT_FALSE(due(0.3, 7, StressUpdate::usavg));
  EXPECT_FALSE(due(0.2, 10, StressUpdate::usavg));
  EXPECT_FALSE(due(0.3, 10, StressUpdate::usavg, true));  // crossings would be found anew
  EXPECT_FALSE(due(0.3, 10, StressUpdate::musl));
}

}  // namespace
}  // namespace riven
