#include "perf/kernels.hpp"

#include <fmt/format.h>
#include <valgrind/callgrind.h>

#include <algorithm>
#include <cstdio>
#include <numeric>

#include "core/error.hpp"
#include "kernels/simulation.hpp"
#include "perf/callgrind.hpp"
#include "perf/roofline.hpp"

namespace riven::perf {

namespace {

constexpr int timed_steps = 48, hurried_steps = 3;  ///< of one repetition

const Entrant& entrant_of(const GateScene& scene, bool quick) {
  return quick ? scene.counted : scene.timed;
}

}  // namespace

std::vector<GateScene> kernel_scenes(bool quick) {
  std::vector<GateScene> list = gate_scenes();
  if (quick)
    return list;
  GateScene large = list.front();  // the block
  large.counted.name = "large block";
  large.timed = swirling(large.counted.name, 600, [](Scene& s) { s.deterministic = true; });
  list.insert(list.begin() + 1, large);
  return list;
}

SceneKernels::SceneKernels(GateScene scene, KernelOptions options, const MachineRates& rates)
    : scene_(std::move(scene)), options_(std::move(options)), rates_(rates) {
  const Scene& s = entrant_of(scene_, options_.quick).scene;
  for (const auto& t : assemble_step<double>(s, make_plan(s)))
    labels_.push_back(t.label);
  labels_.emplace_back("whole step");
}

int SceneKernels::turns() const {
  return std::max(1, (options_.quick ? hurried_steps : timed_steps) / scene_.steps);
}

double SceneKernels::seconds(size_t task, size_t turn) {
  if (!runner_) {
    if (options_.count)
      count();
    runner_ = make_runner(entrant_of(scene_, options_.quick), exec::Kind::openmp, options_.threads);
    runner_->run(scene_.warm_up);
  }
  while (taken_.size() <= turn)
    take_turn();
  return taken_[turn][task];
}

void SceneKernels::take_turn() {
  const std::vector<TaskRecord> before = runner_->tasks();
  runner_->run(scene_.steps);
  const std::vector<TaskRecord> after = runner_->tasks();
  std::vector<double> spent;
  spent.reserve(after.size() + 1);
  for (size_t t = 0; t < after.size(); ++t)
    spent.push_back((after[t].seconds - before[t].seconds) /
                    (static_cast<double>(runner_->particles()) * scene_.steps));
  spent.push_back(std::accumulate(spent.begin(), spent.end(), 0.0));
  taken_.push_back(std::move(spent));
}

void SceneKernels::count() {
  fmt::print(stderr, "Counting what {} does\n", scene_.timed.name);
  std::vector<std::string> command{options_.program.string(), "step-for-operations", "--scene", scene_.timed.name};
  if (options_.quick)
    command.emplace_back("--quick");
  operations_ = count_operations(command, last_level_cache());
  Operations sum;
  for (const TaskOperations& t : operations_)
    sum += t.operations;
  operations_.push_back({labels_.back(), sum});
}

benchmark::UserCounters SceneKernels::counters(size_t task, double seconds) const {
  const auto t = std::find_if(operations_.begin(), operations_.end(),
                              [&](const TaskOperations& x) { return x.label == labels_[task]; });
  if (t == operations_.end())
    return {};
  const Operations& each = t->operations;
  const Bounds bounds = bounds_of(each.flops, each.traffic, rates_);
  benchmark::UserCounters counters{{"instructions", each.instructions},
                                   {"flops", each.flops},
                                   {"moved_bytes", each.moved},
                                   {"memory_bytes", each.traffic},
                                   {"arithmetic_bound_ns", 1e9 * bounds.arithmetic},
                                   {"memory_bound_ns", 1e9 * bounds.memory},
                                   {"roofline_share", bounds.least_time() / seconds}};
  if (each.traffic > 0)
    counters["flops_per_byte"] = each.flops / each.traffic;
  return counters;
}

void step_for_operations(const std::string& scene, bool quick) {
  const std::vector<GateScene> all = kernel_scenes(quick);
  const auto g = std::find_if(all.begin(), all.end(), [&](const GateScene& x) { return x.timed.name == scene; });
  if (g == all.end())
    fail({Exit::bad_input, "no such scene", "--scene", scene});
  const std::unique_ptr<Runner> runner = make_runner(entrant_of(*g, quick), exec::Kind::serial, 1);
  runner->run(g->warm_up);
  CALLGRIND_START_INSTRUMENTATION;
  runner->run(1);
  dump_tasks(*runner, g->steps);
  runner->run(g->steps);
  CALLGRIND_STOP_INSTRUMENTATION;
}

}  // namespace riven::perf
