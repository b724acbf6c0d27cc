#include "perf/throughput.hpp"

#include <algorithm>
#include <memory>

#include "core/error.hpp"
#include "core/exec/timers.hpp"
#include "core/math/median.hpp"
#include "perf/operations.hpp"
#include "perf/runner.hpp"

namespace riven::perf {

namespace {

/// An entrant, and its times so far.
class Turns {
 public:
  Turns(const Entrant& entrant, int threads)
      : runner_(make_runner(entrant, entrant.scene.exec, threads)), task_(runner_->tasks().size()) {}

  void warm_up(int steps) { runner_->run(steps); }
  void take_turn(int steps) {
    const std::vector<TaskRecord> before = runner_->tasks(), launched = runner_->kernels();
    const long touched = runner_->contacts(), points = runner_->crack_points();
    const double start = exec::Stopwatch::now();
    runner_->run(steps);
    seconds_.push_back((exec::Stopwatch::now() - start) / steps);
    const std::vector<TaskRecord> after = runner_->tasks();
    for (size_t t = 0; t < before.size(); ++t)
      task_[t].push_back((after[t].seconds - before[t].seconds) / steps);
    count_kernels(launched, runner_->kernels());
    contacts_ += runner_->contacts() - touched;
    grown_ += runner_->crack_points() - points;
    steps_ += steps;
  }

  Result result() {
    const Standing now = runner_->standing();
    Result r;
    r.name = runner_->entrant().name;
    r.without_cracks = runner_->entrant().without_cracks;
    r.threads = runner_->threads();
    r.particles = runner_->particles();
    r.steps = steps_;
    r.seconds = seconds_;
    const std::vector<TaskRecord> tasks = runner_->tasks();
    for (size_t t = 0; t < task_.size(); ++t)
      r.tasks.push_back({tasks[t].label, tasks[t].effect, 1e9 * median(task_[t]) / static_cast<double>(r.particles)});
    for (const TaskRecord& k : kernels_)
      r.kernels.push_back({k.label, k.effect, 1e9 * k.seconds / static_cast<double>(r.particles * r.steps)});
    r.precision = runner_->entrant().scene.precision;
    r.particle_bytes = now.particle_bytes;
    r.other_bytes = now.other_bytes;
    r.contacts = contacts_;
    r.grown = grown_;
    r.momentum_error = now.momentum_error;
    r.energy_error = now.energy_error;
    return r;
  }

 private:
  /// `before`: the first of `after`, as they were.
  void count_kernels(const std::vector<TaskRecord>& before, std::vector<TaskRecord> after) {
    for (size_t k = 0; k < before.size(); ++k)
      after[k].seconds -= before[k].seconds;
    for (size_t k = 0; k < kernels_.size(); ++k)
      after[k].seconds += kernels_[k].seconds;
    kernels_ = std::move(after);
  }

  std::unique_ptr<Runner> runner_;
  std::vector<TaskRecord> kernels_;  ///< in all turns
  std::vector<double> seconds_;
  std::vector<std::vector<double>> task_;  ///< [tasks][turns] seconds per step
  long contacts_ = 0, grown_ = 0, steps_ = 0;
};

}  // namespace

double Result::best_rate() const {
  return static_cast<double>(particles) / *std::min_element(seconds.begin(), seconds.end());
}
double Result::median_rate() const {
  return static_cast<double>(particles) / median(seconds);
}

std::vector<Result> measure(const Group& group, const std::vector<int>& threads) {
  std::vector<std::unique_ptr<Turns>> all;
  for (const Entrant& e : group.entrants())
    for (const int n : threads)
      all.push_back(std::make_unique<Turns>(e, n));
  for (const auto& one : all)
    one->warm_up(group.warm_up);
  for (int turn = 0; turn < group.turns; ++turn)
    for (const auto& one : all)
      one->take_turn(group.steps);
  std::vector<Result> results;
  results.reserve(all.size());
  for (const auto& one : all)
    results.push_back(one->result());
  return results;
}

Bounds step_bounds(const Result& result, const std::vector<MachineRates>& rates) {
  const auto r =
      std::find_if(rates.begin(), rates.end(), [&](const MachineRates& x) { return x.threads == result.threads; });
  if (r == rates.end())
    fail({Exit::internal, "no rates of the machine for this number of threads", result.name});
  const bool in_cache = result.particle_bytes + result.other_bytes < last_level_cache();
  return bounds_of(flops_per_particle_step, in_cache ? 0 : bytes_per_particle_step, *r);
}

Shares bound_shares(const Result& result, const std::vector<MachineRates>& rates) {
  const Bounds least = step_bounds(result, rates);
  const double rate = result.best_rate();
  return {rate * least.arithmetic, rate * least.memory, rate * least.least_time()};
}

double achieved_bandwidth(const Result& result) {
  return result.best_rate() *
         (result.precision == Precision::as_float ? bytes_per_particle_step_in_float : bytes_per_particle_step);
}

Overhead crack_overhead(const Result& result, const std::vector<Result>& all) {
  const auto plain = std::find_if(all.begin(), all.end(), [&](const Result& r) {
    return r.name == result.without_cracks && r.threads == result.threads;
  });
  if (plain == all.end())
    fail({Exit::internal, "no run without cracks to compare with", result.name});
  std::vector<double> ratios;
  for (size_t turn = 0; turn < result.seconds.size(); ++turn)
    ratios.push_back(result.seconds[turn] / plain->seconds[turn]);
  return {median(ratios) - 1, plain->best_rate() / result.best_rate() - 1};
}

}  // namespace riven::perf
