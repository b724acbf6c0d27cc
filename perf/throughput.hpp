// Rates of whole steps: entrants take turns, so that what else the machine does meets all of them alike.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "perf/roofline.hpp"
#include "perf/scenes.hpp"

namespace riven::perf {

/// What `riven-perf kernels --filter '^large block/whole step'` counts for one step of one particle in the block
/// without cracks (FLIP, USL, 1,440,000 particles): 266.3 flops in particle to grid, 311.8 in grid to particle, 3.6 a
/// particle in advance grid. Shape functions that both passes compute, lanes without a particle, and branches of which
/// each lane keeps one are among them.
constexpr double flops_per_particle_step = 582;
/// And bytes of the arrays that this step reads from and writes to memory, with a last-level cache of 32 MiB: 105 in
/// particle to grid and 151 in grid to particle, which pass over the particles one after the other, and 16 of the grid.
constexpr double bytes_per_particle_step = 272;

/// The same with Real in float, for the places and deformation gradients of particles stay in double: of the 256 bytes
/// of particles 52 are halves of what is not, and of those of the grid all 8.
constexpr double bytes_per_particle_step_in_float = 212;

/// Entrants that take turns, and how long a turn is.
struct Group {
  std::string name, title;
  int warm_up;  ///< steps before the first turn
  int steps;    ///< of a turn
  int turns;
  std::function<std::vector<Entrant>()> entrants;  ///< makes the scenes; throws Error
  bool asked_for = false;                          ///< runs only when it is named
  bool on_device = false;                          ///< on one number of threads
};

/// block, large, methods, sent, growing, many; thousand, device, device-large, device-cracks.
std::vector<Group> throughput_groups();

struct TaskTime {
  std::string label, effect;
  double nanoseconds = 0;  ///< per particle and step, median of the turns
};

/// One entrant on one number of threads.
struct Result {
  std::string name;
  std::string without_cracks;
  int threads = 0;
  long particles = 0;
  long steps = 0;               ///< in all turns
  std::vector<double> seconds;  ///< per step, one a turn
  std::vector<TaskTime> tasks;
  std::vector<TaskTime> kernels;  ///< of all turns, in the order of their first launch
  Precision precision = Precision::as_double;
  long particle_bytes = 0, other_bytes = 0;  ///< of the arrays at the end
  long contacts = 0;                         ///< pairs of fields that touched after the update, in all turns
  long grown = 0;                            ///< points by which cracks have grown, in all turns
  double momentum_error = 0;                 ///< see Momentum::error
  double energy_error = 0;                   ///< see Energy::relative_error

  double best_rate() const;    ///< particle-steps/s of the fastest turn
  double median_rate() const;  ///< of the median turn
};

/// Extra time of a result over the same scene without cracks.
struct Overhead {
  double median = 0;  ///< of the turns' ratios, less one
  double best = 0;    ///< ratio of the fastest turns, less one
};

/// B/s between memory and device that the block's step needs at the rate of the best turn, see bytes_per_particle_step.
double achieved_bandwidth(const Result& result);

/// Runs all entrants of a group on each number of threads, turn by turn. Throws Error (unstable) if a run goes wrong.
std::vector<Result> measure(const Group& group, const std::vector<int>& threads);

/// What cracks cost `result`, whose partner is among `all`. Throws Error (internal) if it is not.
Overhead crack_overhead(const Result& result, const std::vector<Result>& all);

/// What the machine would allow the block's step at the best, with the threads of the result, in seconds per particle.
/// Arrays that fit into the last-level cache ask nothing of the memory.
Bounds step_bounds(const Result& result, const std::vector<MachineRates>& rates);
/// Which share of those bounds, as rates, the best turn reaches.
struct Shares {
  double arithmetic = 0, memory = 0;
  double bound = 0;  ///< of the lower one
};
Shares bound_shares(const Result& result, const std::vector<MachineRates>& rates);

/// Bounds of the block's step on each number of threads, million particle-steps per second.
std::string bound_table(const std::vector<MachineRates>& rates);
/// Rates, shares of the bounds, speed-up over the first of `rates`, memory and overheads of one group.
std::string rate_table(const std::vector<Result>& results, const std::vector<MachineRates>& rates);
/// Rates on a device, and what share of the bandwidth of a copy there (B/s) the block's step reaches.
std::string device_table(const std::vector<Result>& results, double copy);
/// Nanoseconds per particle and step of each task, one column for each entrant on `threads`.
std::string task_table(const std::vector<Result>& results, int threads);
/// The same of each kernel.
std::string kernel_table(const std::vector<Result>& results);

}  // namespace riven::perf
