#include "perf/pace.hpp"

#include <algorithm>
#include <numeric>

#include "perf/runner.hpp"

namespace riven::perf {

namespace {

constexpr int steps_of_turn = 48;

/// Of all turns, the ratio below which a quarter lies: disturbances mostly add, to the scene more than to the
/// calibration.
double lower_quarter(std::vector<double> values) {
  const auto place = values.begin() + static_cast<long>(values.size() / 4);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace

SceneCost measure_pace(const GateScene& scene, Calibration& calibration, const std::string& slowed) {
  const std::unique_ptr<Runner> runner = make_runner(scene.timed, exec::Kind::serial, 1);
  runner->run(scene.warm_up);
  if (!slowed.empty())
    runner->slow_down(slowed);
  const std::vector<TaskRecord> tasks = runner->tasks();
  std::vector<double> seconds(tasks.size());
  runner->measure_tasks([&](size_t index, const std::function<void()>& work) {
    const double start = cpu_seconds();
    work();
    seconds[index] += cpu_seconds() - start;
  });

  std::vector<std::vector<double>> ratios(tasks.size());
  for (int turn = 0; turn < steps_of_turn / scene.steps; ++turn) {
    std::fill(seconds.begin(), seconds.end(), 0);
    runner->run(scene.steps);
    const double round = calibration.round_over(std::accumulate(seconds.begin(), seconds.end(), 0.0));
    for (size_t t = 0; t < tasks.size(); ++t)
      ratios[t].push_back(seconds[t] / round);
  }
  const double millionth = 1e6 / (static_cast<double>(runner->particles()) * scene.steps);
  SceneCost cost{scene.timed.name, {}};
  for (size_t t = 0; t < tasks.size(); ++t)
    cost.tasks.push_back({tasks[t].label, millionth * lower_quarter(ratios[t])});
  return cost;
}

}  // namespace riven::perf
