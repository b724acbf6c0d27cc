// What the machine can do: the bounds that a measured rate of riven is read against.
#pragma once
#include <string>
#include <vector>

namespace riven::perf {

/// Rates of one thread count, each the best of several repetitions.
struct MachineRates {
  int threads = 0;
  double triad = 0;   ///< B/s of a = b + s c out of cache, 24 B per item (the line fill of a store is not counted)
  double update = 0;  ///< B/s of a = s a + t out of cache, 16 B per item: read-modify-write
  double fma = 0;     ///< flop/s of independent fused multiply-adds, double, in the widest vectors of the build
  double atomic = 0;  ///< additions/s to doubles of one shared table that fits into a cache
};

/// B/s of the triad a = b + s c over three arrays of `bytes` each, with the given number of threads.
double triad_bandwidth(int threads, long bytes);
/// B/s of the update a = s a + t over one array of `bytes`.
double update_bandwidth(int threads, long bytes);
/// Ten independent chains of `trips` fused multiply-adds each on the widest vectors of the build. Returns their sum.
double multiply_add_chains(long trips);
/// flop/s of fused multiply-adds on registers, two flops each.
double fma_rate(int threads);
/// Relaxed atomic additions/s of doubles, every thread walking over one shared table of `bytes`.
double atomic_add_rate(int threads, long bytes);

/// All of the above, out of cache where it says so. Takes about two seconds.
MachineRates measure_machine(int threads);

/// 1, 2, 4, ... up to the number of cores that this process may use, that number included.
std::vector<int> core_counts();
/// The processor, by family and model too, since virtual machines give kinds of different speed one name; its cores;
/// and the vector width of this build in bits.
std::string machine_name();
/// The rates as a table, one row for each thread count.
std::string table(const std::vector<MachineRates>& rates);

}  // namespace riven::perf
