#include "perf/count.hpp"

#include <valgrind/callgrind.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <future>

#include "core/error.hpp"
#include "perf/callgrind.hpp"
#include "perf/gate_scenes.hpp"
#include "perf/runner.hpp"

namespace riven::perf {

namespace fs = std::filesystem;

namespace {

constexpr int counted_steps = 4;

double instructions_of(const Dump& dump) {
  static const std::string totals = "totals: ";
  std::ifstream in(dump.file);
  std::string line;
  while (std::getline(in, line))
    if (line.rfind(totals, 0) == 0)
      return std::stod(line.substr(totals.size()));
  fail({Exit::internal, "callgrind's output is not as expected", dump.file.string(), dump.task});
}

void add(const Dump& dump, Costs& costs) {
  auto s = std::find_if(costs.begin(), costs.end(), [&](const SceneCost& c) { return c.scene == dump.scene; });
  if (s == costs.end())
    s = costs.insert(costs.end(), {dump.scene, {}});
  auto t = std::find_if(s->tasks.begin(), s->tasks.end(), [&](const TaskCost& c) { return c.label == dump.task; });
  if (t == s->tasks.end())
    t = s->tasks.insert(s->tasks.end(), {dump.task, 0});
  t->cost += instructions_of(dump) / dump.particle_steps;
}

}  // namespace

fs::path counted_program() {
  return RIVEN_COUNTED_PROGRAM;
}

Costs count_instructions(const fs::path& program, size_t scenes, const std::string& slowed) {
  std::vector<Costs> of_scene(std::min(scenes, gate_scenes().size()));
  std::atomic<size_t> left = of_scene.size();  // the last ones take longest
  const auto count_scenes = [&] {
    for (size_t k; (k = --left) < of_scene.size();) {
      std::vector<std::string> command{program.string(), "step-for-callgrind", std::to_string(k)};
      if (!slowed.empty())
        command.insert(command.end(), {"--slow-down", slowed});
      run_callgrind({}, command, [&](const Dump& dump) { add(dump, of_scene[k]); });
    }
  };
  std::vector<std::future<void>> workers;
  workers.reserve(static_cast<size_t>(exec::available_threads()));
  for (int t = 0; t < exec::available_threads(); ++t)
    workers.push_back(std::async(std::launch::async, count_scenes));
  for (std::future<void>& w : workers)
    w.get();
  Costs costs;
  for (const Costs& one : of_scene)
    costs.insert(costs.end(), one.begin(), one.end());
  return costs;
}

void step_for_callgrind(size_t number, const std::string& slowed) {
  const GateScene scene = gate_scenes().at(number);
  const std::unique_ptr<Runner> runner = make_runner(scene.counted, exec::Kind::serial, 1);
  runner->run(scene.warm_up);
  if (!slowed.empty())
    runner->slow_down(slowed);
  dump_tasks(*runner, counted_steps);
  CALLGRIND_START_INSTRUMENTATION;
  runner->run(counted_steps);
  CALLGRIND_STOP_INSTRUMENTATION;
}

}  // namespace riven::perf
