// Times of single tasks. They come from whole steps, since a task cannot be repeated by itself: one run of a scene
// serves the benchmarks of all its tasks, each of which hands the times of its task to Google Benchmark.
#pragma once
#include <benchmark/benchmark.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "perf/gate_scenes.hpp"
#include "perf/machine.hpp"
#include "perf/operations.hpp"
#include "perf/runner.hpp"

namespace riven::perf {

struct KernelOptions {
  std::string filter;
  int threads = 1, repetitions = 5;
  bool json = false, quick = false, count = true;
  std::filesystem::path program;  ///< that is counted
};

/// The gate's scenes, and, unless in a hurry, the block at a size beyond the caches.
std::vector<GateScene> kernel_scenes(bool quick);

/// A scene, the times of its tasks so far, and what they do. Nothing is run or counted before it is asked for.
class SceneKernels {
 public:
  /// The rates must outlive it, and may be measured later.
  SceneKernels(GateScene scene, KernelOptions options, const MachineRates& rates);
  /// Of the tasks in the order of the step; the last is the step itself.
  const std::vector<std::string>& labels() const { return labels_; }
  std::string name(size_t task) const { return scene_.timed.name + "/" + labels_[task]; }
  /// Turns of steps in a repetition.
  int turns() const;
  /// Seconds per particle and step that a task took in a turn; takes the turn if it has not been taken, and before the
  /// first one counts what the tasks do. Throws Error as count_operations().
  double seconds(size_t task, size_t turn);
  /// What a task does, and what share of the roofline it reaches in so many seconds per particle; empty if that has not
  /// been counted.
  benchmark::UserCounters counters(size_t task, double seconds) const;

 private:
  void take_turn();
  void count();

  GateScene scene_;
  KernelOptions options_;
  const MachineRates& rates_;
  std::vector<std::string> labels_;
  std::unique_ptr<Runner> runner_;
  std::vector<std::vector<double>> taken_;  ///< [turns][tasks]
  std::vector<TaskOperations> operations_;
};

/// What riven-perf does under callgrind to have operations counted: a turn of steps of the scene of that name, after a
/// step that fills the cache.
void step_for_operations(const std::string& scene, bool quick);

/// A table for each scene, a row for each task: the median of the repetitions, and how far they scatter.
std::unique_ptr<benchmark::BenchmarkReporter> table_of_kernels();
/// Google Benchmark's own JSON.
std::unique_ptr<benchmark::BenchmarkReporter> json_of_kernels();

}  // namespace riven::perf
