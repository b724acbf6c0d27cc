// Runs that become suspect: said once, kept as they are then, and stopped where the scene says so.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "io/checkpoint.hpp"
#include "io/run_scene.hpp"
#include "tests/io/results_sample.hpp"
#include "tests/io/small_run.hpp"

namespace riven {
namespace {

namespace fs = std::filesystem;

struct Ran {
  Ran(const std::vector<std::string>& settings, const fs::path& folder) : run(settings) {
    testing::internal::CaptureStderr();
    try {
      run_scene(run.m, {.folder = folder, .quiet = true});
    } catch (const Error& e) {
      code = e.code();
      message = e.what();
    }
    said = testing::internal::GetCapturedStderr();
    summary = nlohmann::json::parse(sample::text_of(folder / "summary.json"));
  }
  test::SmallRun run;
  Exit code = Exit::done;
  std::string message, said;
  nlohmann::json summary;
};

size_t count(const std::string& text, const std::string& what) {
  size_t n = 0;
  for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
    ++n;
  return n;
}

// the small block spins: its corners are stretched by more from step to step
const std::vector<std::string> spinning{"body.0.spin=20000 rad/s", "output.history_every=0.1 us"};

std::vector<std::string> with(std::vector<std::string> settings, const std::vector<std::string>& more) {
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}

TEST(WatchedRun, SaysNothingWhereAllIsWell) {
  const sample::Folder folder;
  const Ran r({}, folder / "out");
  EXPECT_EQ(r.code, Exit::done);
  EXPECT_EQ(r.said, "");
  EXPECT_FALSE(fs::exists(folder / "out" / "checkpoint.h5"));
  for (const char* figure : {"energy", "momentum", "compression", "expansion", "penetration", "velocity_difference"})
    EXPECT_TRUE(r.summary["watched"][figure]["worst"].is_number()) << figure;
  EXPECT_LT(r.summary["watched"]["momentum"]["worst"], 1e-12);
  EXPECT_GE(r.summary["watched"]["expansion"]["worst"], 1);
}

TEST(WatchedRun, WarnsOnceAndKeepsTheStateToGoOnFrom) {
  const sample::Folder folder;
  const Ran r(with(spinning, {"limits.warn.expansion=1.0005"}), folder / "out");
  EXPECT_EQ(r.code, Exit::done) << r.message;
  EXPECT_EQ(count(r.said, "riven: warning: step "), 1u) << r.said;
  EXPECT_EQ(count(r.said, "(limits.warn.expansion)"), 1u) << r.said;
  const auto& warning = r.summary["warnings"]["a particle is stretched far (det F)"];
  EXPECT_GT(warning["count"], 1);
  ASSERT_TRUE(fs::exists(folder / "out" / "checkpoint.h5"));

  // what was kept ends as the run did that went on
  test::SmallRun again(with(spinning, {"limits.warn.expansion=1.0005"}));
  const CheckpointFile kept(folder / "out" / "checkpoint.h5");
  run_scene(again.m, {.folder = folder / "again", .quiet = true, .restart = &kept});
  EXPECT_GT(again.m.state.clock.step, 0);
  for (long i = 0; i < again.m.state.particles.count(); ++i)
    ASSERT_EQ(again.m.state.particles.x[0][i], r.run.m.state.particles.x[0][i]);
  const auto j = nlohmann::json::parse(sample::text_of(folder / "again" / "summary.json"));
  EXPECT_EQ(j["warnings"], r.summary["warnings"]);
  EXPECT_EQ(j["watched"], r.summary["watched"]);
}

/// Beyond a CFL number of 1 stock is taken in every step: what is first seen between two rows is said with the next.
TEST(WatchedRun, SaysWhatWasSeenBetweenRows) {
  const sample::Folder folder;
  const Ran r({"body.0.spin=20000 rad/s", "output.history_every=5 us", "limits.warn.expansion=1.00001",
               "solver.cfl=1.01", "limits.energy_growth=1e9"},
              folder / "out");
  EXPECT_EQ(r.code, Exit::done) << r.message;
  EXPECT_EQ(count(r.said, "(limits.warn.expansion)"), 1u) << r.said;
}

TEST(WatchedRun, StopsWithTheStateBeforeKept) {
  const sample::Folder folder;
  const Ran r(with(spinning, {"limits.warn.expansion=1.0005", "limits.stop.expansion=1.002"}), folder / "out");
  EXPECT_EQ(r.code, Exit::unstable);
  EXPECT_NE(r.message.find("(limits.stop.expansion)"), std::string::npos) << r.message;
  EXPECT_EQ(r.summary["status"], "unstable");
  EXPECT_TRUE(fs::exists(folder / "out" / "checkpoint.h5"));
}

TEST(WatchedRun, KeepsNoStateWhereNoneIsWanted) {
  const sample::Folder folder;
  const Ran r(with(spinning, {"limits.warn.expansion=1.0005", "output.checkpoint=0 s"}), folder / "out");
  EXPECT_EQ(count(r.said, "riven: warning: step "), 1u) << r.said;
  EXPECT_FALSE(fs::exists(folder / "out" / "checkpoint.h5"));
}

}  // namespace
}  // namespace riven
