// What a step of a scene costs, task by task, in one unit: instructions, or time in terms of a calibration.
#pragma once
#include <string>
#include <vector>

namespace riven::perf {

struct TaskCost {
  std::string label;
  double cost = 0;  ///< per particle and step
};

struct SceneCost {
  std::string scene;
  std::vector<TaskCost> tasks;  ///< in the order of the step

  double total() const {
    double sum = 0;
    for (const TaskCost& t : tasks)
      sum += t.cost;
    return sum;
  }
};

using Costs = std::vector<SceneCost>;

}  // namespace riven::perf
