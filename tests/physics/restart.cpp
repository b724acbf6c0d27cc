// A run that is taken up again goes on to the last bit as it would have without: at any step, in double and in float,
// on other numbers of threads. Writing a checkpoint changes nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "io/checkpoint.hpp"
#include "kernels/dispatch.hpp"
#include "tests/io/results_sample.hpp"
#include "tests/physics/restarts.hpp"
#include "tests/physics/scene_gates.hpp"
#include "tests/physics/scenes.hpp"

namespace riven {
namespace {

using gates::shipped;
using namespace restarts;

void expect_same(const Bytes& a, const Bytes& b, const std::string& when) {
  ASSERT_EQ(a.size(), b.size());
  for (const auto& [name, bytes] : a)
    EXPECT_TRUE(bytes == b.at(name)) << name << " " << when;
}

struct Threads {
  int before, after;
};

/// Freezes a run of so many steps at some of them, and takes it up again from each.
template <class Real>
void expect_exact(Scene s, long steps, int restarts, const std::vector<Threads>& threads, unsigned seed) {
  const sample::Folder folder;
  s.deterministic = true;
  s.precision = precision_of<Real>;
  std::mt19937 random(seed);
  std::vector<long> at(static_cast<size_t>(restarts));
  for (long& step : at)
    step = 1 + static_cast<long>(random() % static_cast<unsigned long>(steps - 1));
  const auto file = [&](long step) { return folder / ("at_" + std::to_string(step) + ".h5"); };

  const exec::Space one(exec::Kind::openmp, 1);
  SimulationOf<Real> undisturbed(s, one);
  run(undisturbed, steps, [] {});
  const Bytes whole = all_of(undisturbed);
  if (undisturbed.plan.growth) {
    EXPECT_FALSE(undisturbed.state.events.empty()) << "cracks must grow for this to prove anything";
  }
  if (undisturbed.plan.contact) {
    EXPECT_GT(undisturbed.contact_after.touching, 0) << "and touch";
  }
  if (undisturbed.plan.tractions) {
    EXPECT_GT(undisturbed.state.ledger.energy.debonding, 0) << "and be damaged";
  }

  for (const Threads& t : threads) {
    const exec::Space first(exec::Kind::openmp, t.before), then(exec::Kind::openmp, t.after);
    const std::string how = std::to_string(t.before) + " to " + std::to_string(t.after) + " threads";
    SimulationOf<Real> written(s, first);
    run(written, steps, [&] {
      if (std::find(at.begin(), at.end(), written.state.clock.step) != at.end())
        write_checkpoint(file(written.state.clock.step), written, {});
    });
    expect_same(whole, all_of(written), "of a run that writes checkpoints, " + how);
    for (const long step : at) {
      SimulationOf<Real> resumed(s, then);
      CheckpointFile(file(step)).restore(resumed);
      ASSERT_EQ(resumed.state.clock.step, step);
      run(resumed, steps, [] {});
      expect_same(whole, all_of(resumed), "from step " + std::to_string(step) + ", " + how);
    }
  }
}

/// Pulled so fast that the zone is damaged at once.
Scene pulled_apart() {
  return shipped("cohesive_dcb",
                 {"solver.cfl=0.7", "grip.up.velocity_y=20 m/s", "grip.down.velocity_y=-20 m/s", "solver.time=0.1 ms",
                  "grid.upper=[\"76 mm\", \"20.5 mm\"]", "grid.lower=[\"-4 mm\", \"-20.5 mm\"]"});
}

const std::vector<Threads> both{{1, 1}, {1, 2}, {2, 1}};

TEST(Restart, IsExactWithGrowingCracksInContact) {
  expect_exact<double>(growing(), 240, 7, both, 1);
}

TEST(Restart, IsExactInFloat) {
  expect_exact<float>(growing(), 240, 6, {{1, 2}}, 2);
}

TEST(Restart, IsExactWithGradientsOfVelocity) {
  Scene s = growing();
  s.affine = true;
  expect_exact<double>(s, 120, 5, both, 8);
}

TEST(Restart, IsExactWithACohesiveZone) {
  expect_exact<double>(pulled_apart(), 300, 7, both, 3);
}

TEST(Restart, IsExactWithLargeDeformationAndContact) {
  expect_exact<double>(shipped("two_disks"), 600, 7, both, 4);
}

TEST(Restart, IsExactWhereContactWaitsForFacesToClose) {
  expect_exact<double>(shipped("two_disks", {"contact.when=auto"}), 600, 4, both, 5);
}

/// A block flies over cells to another one, spins and hits it.
TEST(Restart, IsExactWithSolidsThatStartApart) {
  Scene s = test::empty_scene(1, {{-4, -4}, {20, 20}});
  s.bodies = {test::body("rests", Rectangle{{0, 0}, {14, 6}}), test::body("falls", Rectangle{{4, 7.3}, {10, 11.3}})};
  s.bodies[1].velocity = {2, -5};
  s.bodies[1].spin = 0.3;
  s.cracks = {test::crack("border", {{-2, 6}, {16, 6}})};
  s.contact = {ContactLaw::coulomb, 0.3, 0, 0};
  expect_exact<double>(s, 60, 5, both, 7);
}

/// Loads over places go by where particles began.
TEST(Restart, IsExactWithLoadsThatVaryOverPlaces) {
  expect_exact<double>(shipped("vibration"), 100, 3, both, 6);
}

}  // namespace
}  // namespace riven
