// The gate's verdict on given costs: what it lets pass, what not, and what it says.
#include "perf/gate.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "core/error.hpp"

namespace riven::perf {
namespace {

const Costs before{{"block", {{"sort", 10}, {"move", 90}}}, {"plate", {{"move", 50}}}};

Costs with(double sort, double move) {
  return {{"block", {{"sort", sort}, {"move", move}}}, {"plate", {{"move", 50}}}};
}

TEST(Gate, IsOpenUpToTheLimitAndShutBeyondIt) {
  EXPECT_TRUE(passes(compare(before, before), 0.03));
  EXPECT_TRUE(passes(compare(before, with(10, 92.9)), 0.03));
  EXPECT_FALSE(passes(compare(before, with(10, 93.1)), 0.03));
  EXPECT_TRUE(passes(compare(before, with(10, 50)), 0.03));  // faster is no failure
}

TEST(Gate, NamesTheTaskThatLostMostFirst) {
  const auto changes = compare(before, with(25, 91));
  EXPECT_EQ(changes[0].tasks[0].label, "sort");
  const std::string text = report(changes, 0.03, "instructions");
  const size_t lost = text.find("LOST"), sort = text.find("  sort"), plate = text.find("plate");
  ASSERT_NE(lost, std::string::npos);
  EXPECT_LT(lost, sort);
  EXPECT_LT(sort, plate);
  EXPECT_EQ(text.find("LOST", lost + 1), std::string::npos);
}

TEST(Gate, SeesNewTasksAndTasksThatAreGone) {
  const Costs now{{"block", {{"move", 90}, {"stray", 40}}}, {"plate", {{"move", 50}}}};
  const auto tasks = compare(before, now)[0].tasks;
  ASSERT_EQ(tasks.size(), 3U);
  EXPECT_EQ(tasks.front().label, "stray");
  EXPECT_EQ(tasks.back().label, "sort");
  EXPECT_EQ(tasks.back().now, 0);
}

TEST(Gate, RefusesABaselineOfOtherScenes) {
  EXPECT_THROW(compare({before[0]}, before), Error);
  EXPECT_THROW(compare(before, {before[0]}), Error);
}

class BaselineFile : public testing::Test {
 protected:
  // of this process alone, as tests run beside each other
  std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / ("riven_baseline_" + std::to_string(::getpid()) + ".json");
  void TearDown() override { std::filesystem::remove(file); }
};

TEST_F(BaselineFile, KeepsScenesTasksAndProcessorsInTheirOrder) {
  write_baseline({"some compiler", before, {{"one", before}, {"other", with(1, 2.125)}}}, file);
  const Baseline b = read_baseline(file);
  EXPECT_EQ(b.compiler, "some compiler");
  ASSERT_EQ(b.instructions.size(), 2U);
  EXPECT_EQ(b.instructions[0].scene, "block");
  EXPECT_EQ(b.instructions[0].tasks[0].label, "sort");
  EXPECT_EQ(b.times.at("other")[0].tasks[1].cost, 2.125);
}

TEST_F(BaselineFile, ThatIsNoneIsRefused) {
  EXPECT_THROW(read_baseline(file), Error);
  std::ofstream(file) << R"({"compiler": "x"})";
  try {
    read_baseline(file);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), Exit::bad_input);
    EXPECT_EQ(e.trouble().where, file.string());
  }
}

}  // namespace
}  // namespace riven::perf
