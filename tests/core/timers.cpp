// Times of every space there is: they lie between what is known to have been waited for and what the whole took.
#include "core/exec/timers.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "core/exec/space.hpp"

namespace riven::exec {
namespace {

std::vector<Kind> kinds_that_are_there() {
  std::vector<Kind> kinds;
  for (const Kind kind : {Kind::serial, Kind::openmp, Kind::stdpar, Kind::cuda})
    if (available(kind))
      kinds.push_back(kind);
  return kinds;
}

TEST(Timers, AddUpWhatHasOneLabel) {
  for (const Kind kind : kinds_that_are_there()) {
    const Space space(kind);
    const double start = Stopwatch::now();
    for (const char* label : {"long", "short", "long"}) {
      const Stopwatch timed(space.timers(), label);
      std::this_thread::sleep_for(std::chrono::milliseconds(label[0] == 'l' ? 20 : 1));
    }
    const std::deque<Timer>& rows = space.timers().rows();
    const double whole = Stopwatch::now() - start;
    ASSERT_EQ(rows.size(), 2u) << name(kind);
    EXPECT_EQ(rows[0].label, "long");
    EXPECT_EQ(rows[0].calls, 2);
    EXPECT_EQ(rows[1].calls, 1);
    EXPECT_GT(rows[0].seconds, 0.04);
    EXPECT_GT(rows[1].seconds, 0.001);
    EXPECT_LT(rows[0].seconds + rows[1].seconds, whole) << name(kind);
  }
}

TEST(Timers, KeepTheirRowsWhereManyAreMadeAndManyTimesAreToCome) {
  for (const Kind kind : kinds_that_are_there()) {
    const Space space(kind);
    const double start = Stopwatch::now();
    constexpr int labels = 100, calls = 100;
    for (int n = 0; n < calls; ++n)
      for (int l = 0; l < labels; ++l)
        const Stopwatch timed(space.timers(), std::to_string(l).c_str());
    double sum = 0;
    ASSERT_EQ(space.timers().rows().size(), size_t{labels}) << name(kind);
    for (const Timer& t : space.timers().rows()) {
      EXPECT_EQ(t.calls, calls);
      sum += t.seconds;
    }
    EXPECT_GT(sum, 0) << name(kind);
    EXPECT_LT(sum, Stopwatch::now() - start) << name(kind);
  }
}

}  // namespace
}  // namespace riven::exec
