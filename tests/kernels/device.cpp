// What is special to a device: that a step leaves particles and grid there, also where J is found and cracks grow, and
// that its sort keeps the order of the host's. Everything else is proved by the tests of all spaces
// (tests/spaces.hpp). Skipped where there is no device.
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

/// A plate of 102,400 particles, torn apart so that the crack in its left edge runs.
Scene plate_with_a_running_crack() {
  Scene s = empty_scene(1. / 80, {{-0.5, -0.5}, {2.5, 2.5}});
  s.bodies = {body("plate", Rectangle{{0, 0}, {2, 2}})};
  s.cracks = {crack("edge", {{0, 1}, {0.5, 1}})};
  s.growth = GrowthRule{};
  s.growth->toughness = 1;
  return s;
}

TEST(Device, BringsOnlyWhatIsAroundTheTipsOfCracksThatGrow) {
  if (std::string why; !exec::available(exec::Kind::cuda, &why))
    GTEST_SKIP() << why;
  const Scene scene = plate_with_a_running_crack();
  const exec::Space space(exec::Kind::cuda);
  Simulation m(scene, space);
  auto& p = m.state.particles;
  for (long i = 0; i < p.count(); ++i)
    p.v[1][i] = p.x[1][i] - 1;
  for (int n = 0; n < 20; ++n)
    m.step();
  const int points = m.state.cracks.points(), steps = 100;
  const exec::Traffic before = exec::traffic();
  for (int n = 0; n < steps; ++n)
    m.step();
  const exec::Traffic after = exec::traffic();
  EXPECT_GT(m.state.cracks.points(), points + 5) << "the crack must grow for this to prove anything";
  const double particles = static_cast<double>(p.count());
  EXPECT_LT(static_cast<double>(after.to_host - before.to_host) / steps / particles, sizeof(double));
  EXPECT_LT(static_cast<double>(after.to_device - before.to_device) / steps / particles, sizeof(double));
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
