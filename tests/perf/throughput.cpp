// The shares of the machine's bounds, for rates that are given.
#include "perf/throughput.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "perf/operations.hpp"

namespace riven::perf {
namespace {

/// 10 million particle-steps/s on two threads, arrays of so many bytes.
Result running(long bytes) {
  Result r;
  r.threads = 2;
  r.particles = 1'000'000;
  r.seconds = {0.2, 0.1, 0.3};
  r.particle_bytes = bytes / 2;
  r.other_bytes = bytes - bytes / 2;
  return r;
}

/// A machine that could do so many million of the block's steps/s on two threads.
std::vector<MachineRates> machine(double arithmetic, double memory) {
  MachineRates one, two;
  one.threads = 1;
  one.fma = one.triad = 1;
  two.threads = 2;
  two.fma = 1e6 * arithmetic * flops_per_particle_step;
  two.triad = 1e6 * memory * bytes_per_particle_step;
  return {one, two};
}

TEST(Throughput, IsReadAgainstTheLowerBound) {
  const Result large = running(2 * last_level_cache());
  const Shares by_memory = bound_shares(large, machine(100, 40)), by_flops = bound_shares(large, machine(20, 40));
  EXPECT_NEAR(by_memory.arithmetic, 0.1, 1e-12);
  EXPECT_NEAR(by_memory.memory, 0.25, 1e-12);
  EXPECT_NEAR(by_memory.bound, 0.25, 1e-12);
  EXPECT_NEAR(by_flops.bound, 0.5, 1e-12);
}

TEST(Throughput, AsksNothingOfTheMemoryWhereTheArraysFitIntoTheCaches) {
  const Shares s = bound_shares(running(last_level_cache() / 2), machine(100, 40));
  EXPECT_EQ(s.memory, 0);
  EXPECT_NEAR(s.bound, 0.1, 1e-12);
}

/// Ten million steps/s; what stays in double is the same whatever the precision.
TEST(Throughput, SaysWhatBandwidthARateNeeds) {
  Result r = running(1);
  EXPECT_NEAR(achieved_bandwidth(r), 1e7 * bytes_per_particle_step, 1);
  r.precision = Precision::as_float;
  EXPECT_NEAR(achieved_bandwidth(r), 1e7 * (bytes_per_particle_step - 52 - 8), 1);
}

TEST(Throughput, HasNoBoundForThreadsThatWereNotMeasured) {
  EXPECT_THROW(bound_shares(running(1), {}), Error);
}

}  // namespace
}  // namespace riven::perf
