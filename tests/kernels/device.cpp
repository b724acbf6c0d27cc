// What is special to a device: that a step leaves particles and grid there, also where J is found and cracks grow, and
// that its sort keeps the order of the host's. Everything else is proved by the tests of all spaces
// (tests/spaces.hpp). Skipped where there is no device.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/exec/mirror.hpp"
#include "core/exec/timers.hpp"
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

TEST(Device, TimesItsTasksAndKernelsByItsOwnClock) {
  if (std::string why; !exec::available(exec::Kind::cuda, &why))
    GTEST_SKIP() << why;
  const Scene scene = flying_block();
  const exec::Space space(exec::Kind::cuda);
  Simulation m(scene, space);
  const auto launched = [&] {
    double sum = 0;
    for (const exec::Timer& t : space.timers().rows())
      sum += t.seconds;
    return sum;
  };
  const double before = launched(), start = exec::Stopwatch::now();
  for (int n = 0; n < 20; ++n)
    m.step();
  const double whole = exec::Stopwatch::now() - start, kernels = launched() - before;
  double tasks = 0;
  for (const Simulation::Task& t : m.tasks)
    tasks += t.seconds;
  EXPECT_GT(kernels, 0);
  EXPECT_LT(kernels, tasks);
  EXPECT_LT(tasks, whole);
  EXPECT_GT(tasks, 0.5 * whole) << "a step does little else";
}

template <class T>
std::vector<T> items(const exec::Array<T>& a) {
  return {a.begin(), a.end()};
}

/// Two cracks that cross and two more next to them, so that nodes see one, two and more.
TEST(Device, ListsTheSegmentsThatTheHostLists) {
  if (std::string why; !exec::available(exec::Kind::cuda, &why))
    GTEST_SKIP() << why;
  Scene scene = empty_scene(1. / 40, {{-0.5, -0.5}, {2.5, 2.5}});
  scene.bodies = {body("plate", Rectangle{{0, 0}, {2, 2}})};
  scene.cracks = {crack("a", {{0.3, 1.01}, {1.7, 1.02}}), crack("b", {{1.01, 0.2}, {1.03, 1.8}}),
                  crack("c", {{0.4, 0.45}, {1.6, 1.62}}), crack("d", {{0.1, 0.1}, {0.2, 0.3}})};
  const exec::Space host(exec::Kind::serial), there(exec::Kind::cuda);
  Simulation one(scene, host), other(scene, there);
  one.step();
  other.step();
  const CrackFields &a = one.state.fields, &b = other.state.fields;
  for (const auto list :
       {&CrackLists::cell_index, &CrackLists::cells, &CrackLists::cell_start, &CrackLists::cell_segment,
        &CrackLists::tile_marked, &CrackLists::marked_tiles, &CrackLists::tile_crack_start, &CrackLists::tile_crack,
        &CrackLists::node_index, &CrackLists::candidate_start, &CrackLists::candidate, &CrackLists::segment_start,
        &CrackLists::node_segment}) {
    EXPECT_FALSE((a.*list).empty());
    EXPECT_EQ(items(a.*list), items(b.*list));
  }
  EXPECT_EQ(items(a.extra), items(b.extra));
  EXPECT_EQ(a.extra_slots, b.extra_slots);
  EXPECT_EQ(a.third_normals.size(), b.third_normals.size());
  EXPECT_FALSE(a.third_normals.empty());
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
