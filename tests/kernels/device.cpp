// What is special to a device: that a step leaves particles and grid there, and that its sort keeps the order of the
// host's. Everything else is proved by the tests of all spaces (tests/spaces.hpp). Skipped where there is no device.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/exec/mirror.hpp"
#include "kernels/simulation.hpp"
#include "tests/physics/scenes.hpp"

namespace riven {
namespace {

using namespace test;

/// A block of 14,400 particles that flies, pulled at its right edge and pushed from within.
Scene flying_block() {
  Scene s = empty_scene(1. / 40, {{-0.5, -0.5}, {3, 2}});
  s.bodies = {body("block", Rectangle{{0, 0}, {1.5, 1.5}})};
  s.bodies[0].velocity = {2, 1};
  Load pull;
  pull.name = "pull";
  pull.kind = Load::Kind::force;
  pull.region = Rectangle{{1.4, 0}, {1.6, 2}};
  pull.value[0] = pull.value[1] = Field(TimeFunction{1.0, {}, {}});
  s.loads.push_back(pull);
  s.body_force[1] = TimeFunction{-1.0, {}, {}};
  return s;
}

TEST(Device, KeepsWhatAStepNeedsWhereItRuns) {
  if (std::string why; !exec::available(exec::Kind::cuda, &why))
    GTEST_SKIP() << why;
  const Scene scene = flying_block();
  const exec::Space space(exec::Kind::cuda);
  Simulation m(scene, space);
  for (int n = 0; n < 3; ++n)
    m.step();
  const exec::Traffic before = exec::traffic();
  const int steps = 20;
  for (int n = 0; n < steps; ++n)
    m.step();
  const exec::Traffic after = exec::traffic();
  const double particles = m.state.particles.count();
  // a number for each tile and for each loaded particle, in some of the steps a sort, but no number of each particle
  EXPECT_LT(static_cast<double>(after.to_host - before.to_host) / steps / particles, sizeof(double));
  EXPECT_LT(static_cast<double>(after.to_device - before.to_device) / steps / particles, sizeof(double));
  EXPECT_GT(after.to_host, before.to_host) << "the watch of the step is read on the host";
}

TEST(Device, SortsAsTheHostDoes) {
  if (std::string why; !exec::available(exec::Kind::cuda, &why))
    GTEST_SKIP() << why;
  const Scene scene = flying_block();
  const exec::Space host(exec::Kind::serial), there(exec::Kind::cuda);
  Simulation a(scene, host), b(scene, there);
  for (int n = 0; n < 200; ++n) {
    a.step();
    b.step();
  }
  const auto &p = a.state.particles, &q = b.state.particles;
  EXPECT_GT(p.tiles.order, 2) << "the block must have been sorted on its way for this to prove anything";
  EXPECT_EQ(p.tiles.order, q.tiles.order);
  EXPECT_TRUE(std::equal(p.id.begin(), p.id.end(), q.id.begin(), q.id.end()));
  EXPECT_TRUE(std::equal(p.tiles.start.begin(), p.tiles.start.end(), q.tiles.start.begin(), q.tiles.start.end()));
}

}  // namespace
}  // namespace riven
