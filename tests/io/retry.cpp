// Runs that go wrong and go back: on from the last good checkpoint with smaller steps, as often as the scene allows,
// and all of it on record. The scene: a block whose stresses are updated last gains energy at large CFL numbers, and
// none at small ones.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "core/error.hpp"
#include "io/checkpoint_store.hpp"
#include "io/run_scene.hpp"
#include "io/vtkhdf.hpp"
#include "tests/io/results_sample.hpp"
#include "tests/physics/restarts.hpp"
#include "tests/program.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

namespace fs = std::filesystem;

/// It goes wrong soon after step 20, where it has a checkpoint.
const std::vector<std::string> too_fast{
    "solver.cfl=0.68",    "solver.stress_update=usl",   "limits.energy_growth=0.5",
    "solver.time=0.06 s", "output.checkpoint_steps=20", "output.history_every=1 ms",
    "output.frames=8",    "output.checkpoint=0 s",      "solver.deterministic=true"};

Scene block(const std::vector<std::string>& more = {}) {
  std::vector<std::string> settings = too_fast;
  settings.insert(settings.end(), more.begin(), more.end());
  return gates::shipped("flying_block", settings);
}

/// A run of a scene into a folder, and how it ended.
struct Ran {
  Ran(Scene s, const fs::path& folder, const fs::path& from = {}) : scene(std::move(s)), m(scene, space) {
    try {
      std::optional<CheckpointFile> file;
      if (!from.empty())
        file.emplace(from);
      run_scene(m, {.folder = folder, .quiet = true, .restart = file ? &*file : nullptr});
    } catch (const Error& e) {
      code = e.code();
    }
    summary = nlohmann::json::parse(sample::text_of(folder / "summary.json"));
    history = sample::text_of(folder / "history.csv");
    events = sample::text_of(folder / "events.csv");
  }

  const Scene scene;
  const test::ChosenSpace space;
  Simulation m;
  Exit code = Exit::done;
  nlohmann::json summary;
  std::string history, events;
};

/// Members that differ, but for the record of what went wrong and for what the CFL number is a part of.
long differences(Simulation& a, Simulation& b) {
  restarts::Bytes x = restarts::all_of(a), y = restarts::all_of(b);
  for (const char* record : {"events", "clock"}) {
    x.erase(record);
    y.erase(record);
  }
  return restarts::differences(x, y);
}

void expect_same_frames(const fs::path& a, const fs::path& b) {
  const auto frames = [](const fs::path& folder) { return list_frames(folder / "frames", "particles"); };
  const std::vector<fs::path> one = frames(a), other = frames(b);
  ASSERT_EQ(one.size(), other.size());
  EXPECT_GT(one.size(), 8u);
  for (std::size_t k = 0; k < one.size(); ++k)
    EXPECT_EQ(sample::text_of(one[k]), sample::text_of(other[k])) << one[k];
}

/// Column of a table, as numbers.
std::vector<double> column(const std::string& table, int wanted) {
  std::istringstream lines(table);
  std::string line, field;
  std::getline(lines, line);
  std::vector<double> values;
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    for (int k = 0; k <= wanted; ++k)
      std::getline(fields, field, ',');
    values.push_back(std::stod(field));
  }
  return values;
}

TEST(Retry, IsWhatARestartByHandWithSmallerStepsGives) {
  const sample::Folder folder;
  const Ran failed(block(), folder / "failed");
  ASSERT_EQ(failed.code, Exit::unstable);
  EXPECT_TRUE(failed.summary["retries"].empty());
  EXPECT_TRUE(failed.events.empty()) << "nothing is asked for that could happen";
  Ran by_hand(block({"solver.cfl=0.34"}), folder / "by_hand", folder / "failed/checkpoint.h5");
  ASSERT_EQ(by_hand.code, Exit::done);

  Ran back(block({"limits.retries=1"}), folder / "back");
  ASSERT_EQ(back.code, Exit::done);
  EXPECT_EQ(back.summary["status"], "done");
  EXPECT_EQ(differences(back.m, by_hand.m), 0);
  EXPECT_EQ(back.m.state.clock.step, by_hand.m.state.clock.step);
  EXPECT_EQ(back.history, by_hand.history);
  expect_same_frames(folder / "back", folder / "by_hand");

  const auto times = column(back.history, 0);
  EXPECT_GT(times.size(), 50u);
  for (std::size_t k = 1; k < times.size(); ++k) {
    EXPECT_GT(times[k], times[k - 1]) << "row " << k;
    EXPECT_LT(times[k], times[k - 1] + 2.5e-3) << "row " << k;
  }
}

TEST(Retry, IsOnRecord) {
  const sample::Folder folder;
  const Ran failed(block(), folder / "failed");
  const Ran back(block({"limits.retries=3", "limits.retry_cfl=0.4"}), folder / "back");
  ASSERT_EQ(back.code, Exit::done);
  ASSERT_EQ(back.summary["retries"].size(), 1u);
  const nlohmann::json& retry = back.summary["retries"][0];
  EXPECT_EQ(retry["step"], failed.summary["steps"]);
  EXPECT_EQ(retry["time"], failed.summary["time"]);
  EXPECT_EQ(retry["back_to_step"], 20);
  EXPECT_DOUBLE_EQ(retry["cfl"], 0.68 * 0.4);
  EXPECT_EQ(retry["message"], failed.summary["message"]);
  ASSERT_EQ(back.m.state.events.size(), 1u);
  EXPECT_NE(back.events.find(fmt::format(",{},,,retry,", long(failed.summary["steps"]))), std::string::npos)
      << back.events;
  const Vec2 place = back.m.state.events[0].place;
  EXPECT_NE(std::string(failed.summary["message"]).find(fmt::format("at ({:.6g}, {:.6g}) m", place.x, place.y)),
            std::string::npos);
  const std::vector<double> x = column(back.events, 5), y = column(back.events, 6);
  EXPECT_EQ(x, std::vector{place.x});
  EXPECT_EQ(y, std::vector{place.y});
}

TEST(Retry, WithoutACheckpointItBeginsAnew) {
  const sample::Folder folder;
  Ran small(block({"solver.cfl=0.34", "output.checkpoint_steps=0"}), folder / "small");
  Ran back(block({"limits.retries=1", "output.checkpoint_steps=0"}), folder / "back");
  ASSERT_EQ(back.code, Exit::done);
  EXPECT_EQ(back.summary["retries"][0]["back_to_step"], 0);
  EXPECT_EQ(back.history, small.history);
  EXPECT_EQ(differences(back.m, small.m), 0);
  expect_same_frames(folder / "back", folder / "small");
}

TEST(Retry, WhatBeginsAnewIsAsItWasMade) {
  const Scene scene = restarts::growing({"solver.deterministic=true"});
  const test::ChosenSpace space;
  Simulation fresh(scene, space), again(scene, space);
  restarts::run(again, 150, [] {});
  EXPECT_FALSE(again.state.events.empty());
  again.begin();
  EXPECT_EQ(restarts::differences(restarts::all_of(fresh), restarts::all_of(again)), 0);
  for (Simulation* m : {&fresh, &again})
    restarts::run(*m, 150, [] {});
  EXPECT_EQ(restarts::differences(restarts::all_of(fresh), restarts::all_of(again)), 0);
}

TEST(Retry, ADtMaxIsReducedToo) {
  const sample::Folder folder;
  const Ran small(block({"solver.cfl=2", "output.checkpoint_steps=0", "solver.dt_max=0.45 ms"}), folder / "small"),
      back(block({"solver.cfl=2", "output.checkpoint_steps=0", "solver.dt_max=0.9 ms", "limits.retries=1"}),
           folder / "back");
  ASSERT_EQ(back.code, Exit::done);
  EXPECT_EQ(back.summary["retries"].size(), 1u);
  EXPECT_EQ(back.history, small.history);
}

TEST(Retry, TheFailureAfterTheLastOneEndsTheRunAlsoWhenItIsTakenUpAgain) {
  const sample::Folder folder;
  const fs::path results = folder / "results";
  const std::vector<std::string> hopeless{"limits.retries=2", "limits.retry_cfl=0.999"};
  const Ran first(block(hopeless), results);
  EXPECT_EQ(first.code, Exit::unstable);
  EXPECT_EQ(first.summary["status"], "unstable");
  ASSERT_EQ(first.summary["retries"].size(), 2u);
  EXPECT_DOUBLE_EQ(first.summary["retries"][1]["cfl"], 0.68 * 0.999 * 0.999);
  EXPECT_EQ(first.m.state.events.size(), 2u);
  const std::string space = exec::name(test::ChosenSpace().kind());
  const Outcome again = riven("run --quiet --exec " + space + " --restart " + results.string(), folder);
  EXPECT_EQ(again.code, 3) << again.errors;
  EXPECT_EQ(again.errors.find("retry"), std::string::npos) << again.errors;
  const auto summary = nlohmann::json::parse(sample::text_of(results / "summary.json"));
  EXPECT_EQ(summary["retries"], first.summary["retries"]);
  EXPECT_EQ(sample::text_of(results / "history.csv"), first.history);
  EXPECT_EQ(sample::text_of(results / "events.csv"), first.events);
}

TEST(Retry, SmallerStepsOutliveAnInterruption) {
  const sample::Folder folder;
  const fs::path results = folder / "results";
  const std::vector<std::string> once{"limits.retries=1"};
  Ran whole(block(once), folder / "whole"), first(block(once), results);
  ASSERT_EQ(first.code, Exit::done);
  fs::remove(results / "summary.json");
  Ran resumed(block(once), results, results / "checkpoint.previous.h5");
  ASSERT_EQ(resumed.code, Exit::done);
  EXPECT_GT(resumed.m.state.clock.step, 60);
  EXPECT_EQ(restarts::differences(restarts::all_of(resumed.m), restarts::all_of(whole.m)), 0);
  EXPECT_EQ(resumed.summary["retries"], whole.summary["retries"]);
  EXPECT_EQ(resumed.history, whole.history);
  EXPECT_EQ(resumed.events, whole.events);
}

TEST(Retry, OnlyGoodStatesAreGoneBackTo) {
  const sample::Folder folder;
  // rows, at which energies are looked at, are far apart; checkpoints are not
  const Ran back(block({"limits.retries=1", "output.history_every=0.05 s", "output.checkpoint_steps=1",
                        "limits.energy_growth=0.2"}),
                 folder / "back");
  ASSERT_EQ(back.summary["retries"].size(), 1u);
  const nlohmann::json& retry = back.summary["retries"][0];
  EXPECT_EQ(retry["back_to_step"], long(retry["step"]) - 1) << "the first that is not good is none";
}

}  // namespace
}  // namespace riven
