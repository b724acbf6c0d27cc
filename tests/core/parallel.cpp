// Launches: every task runs once, whatever the space, its threads and their number.
#include "core/exec/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

namespace riven::exec {
namespace {

constexpr Kind kinds[] = {Kind::serial, Kind::openmp, Kind::stdpar};

TEST(Launch, RunsEveryTaskOnce) {
  for (const Kind kind : kinds)
    for (const int threads : {1, 2, 3, 5}) {
      const Space space(kind, threads);
      for (const long n : {0L, 1L, 2L, 4L, 7L, 1000L}) {
        std::vector<std::atomic<int>> runs(static_cast<size_t>(n) + 2);
        launch(space, n, [&](long i) { ++runs[static_cast<size_t>(i) + 1]; });
        EXPECT_EQ(runs.front(), 0);
        EXPECT_EQ(runs.back(), 0);
        for (long i = 0; i < n; ++i)
          ASSERT_EQ(runs[static_cast<size_t>(i) + 1], 1) << name(kind) << ", " << threads << " threads, " << n;
      }
    }
}

/// Whether `count` reaches `least` while another thread works on it.
bool reaches(const std::atomic<int>& count, int least) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (count < least)
    if (std::chrono::steady_clock::now() > end)
      return false;
    else
      std::this_thread::yield();
  return true;
}

/// The first task ends when all others have: the rest of its thread's share must be done by the other one.
TEST(Launch, LetsFreeThreadsHelpABusyOne) {
  const Space space(Kind::openmp, 2);
  std::atomic<int> others = 0;
  std::atomic<bool> helped = false;
  launch(space, 64, [&](long i) {
    if (i == 0)
      helped = reaches(others, 63);
    else
      ++others;
  });
  EXPECT_TRUE(helped);
}

TEST(Launch, HasTheThreadsOfItsSpaceBesideASmallerOne) {
  const Space one(Kind::stdpar, 1), two(Kind::stdpar, 2);
  std::atomic<int> met = 0;
  std::atomic<bool> both = true;
  launch(two, 2, [&](long) {
    ++met;
    if (!reaches(met, 2))
      both = false;
  });
  EXPECT_TRUE(both);
}

}  // namespace
}  // namespace riven::exec
