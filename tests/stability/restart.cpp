// A run that is taken up again goes on as it would have; tests/physics/restart.cpp holds that in more cases.
#include "io/checkpoint.hpp"
#include "tests/io/results_sample.hpp"
#include "tests/physics/restarts.hpp"
#include "tests/stability/gates.hpp"

namespace riven {
namespace {

using namespace hard_cases;

/// Ten cracks that grow into each other, and touch.
TEST(TakenUpAgain, IsTheSameToTheLastBit) {
  constexpr long steps = 200;
  const sample::Folder folder;
  Scene s = restarts::growing();
  s.deterministic = true;
  const exec::Space space(exec::Kind::openmp, 1);
  Simulation whole(s, space);
  restarts::run(whole, steps, [&] {
    const long step = whole.state.clock.step;
    if (step == 61 || step == 140)
      write_checkpoint(folder / std::to_string(step), whole, {});
  });
  EXPECT_FALSE(whole.state.events.empty());
  EXPECT_GT(whole.contact_after.touching, 0);
  double differ = 0;
  for (const char* step : {"61", "140"}) {
    Simulation resumed(s, space);
    CheckpointFile(folder / step).restore(resumed);
    restarts::run(resumed, steps, [] {});
    differ += static_cast<double>(restarts::differences(restarts::all_of(whole), restarts::all_of(resumed)));
  }
  below("taken up amid growth and contact: arrays that differ in a bit", differ, 1);
}

}  // namespace
}  // namespace riven
