#include "perf/gate.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"

namespace riven::perf {

namespace {

/// Tasks of a failed scene that are printed: those that lost most, and each so much of the step.
constexpr size_t tasks_shown = 3;
constexpr double loss_shown = 0.005;

double cost_of(const SceneCost& scene, const std::string& label) {
  const auto t =
      std::find_if(scene.tasks.begin(), scene.tasks.end(), [&](const TaskCost& c) { return c.label == label; });
  return t == scene.tasks.end() ? 0 : t->cost;
}

std::vector<TaskChange> compare_tasks(const SceneCost& before, const SceneCost& now) {
  std::vector<TaskChange> changes;
  for (const TaskCost& t : now.tasks)
    changes.push_back({t.label, cost_of(before, t.label), t.cost});
  for (const TaskCost& t : before.tasks)
    if (std::none_of(now.tasks.begin(), now.tasks.end(), [&](const TaskCost& c) { return c.label == t.label; }))
      changes.push_back({t.label, t.cost, 0});
  std::stable_sort(changes.begin(), changes.end(),
                   [](const TaskChange& a, const TaskChange& b) { return a.now - a.before > b.now - b.before; });
  return changes;
}

[[noreturn]] void out_of_date(const std::string& scene, const char* what) {
  fail({Exit::bad_input, std::string("the baseline is out of date: ") + what, "baseline", scene, "",
        "riven-perf gate --update REASON makes it anew"});
}

}  // namespace

std::vector<SceneChange> compare(const Costs& before, const Costs& now) {
  const auto in = [](const Costs& costs, const std::string& scene) {
    return std::find_if(costs.begin(), costs.end(), [&](const SceneCost& c) { return c.scene == scene; });
  };
  for (const SceneCost& b : before)
    if (in(now, b.scene) == now.end())
      out_of_date(b.scene, "a scene of it is no longer run");
  std::vector<SceneChange> changes;
  for (const SceneCost& n : now) {
    const auto b = in(before, n.scene);
    if (b == before.end())
      out_of_date(n.scene, "a scene is not in it");
    changes.push_back({n.scene, b->total(), n.total(), compare_tasks(*b, n)});
  }
  return changes;
}

std::string report(const std::vector<SceneChange>& changes, double limit, const std::string& unit) {
  std::string text =
      fmt::format("{:<32} {:>12} {:>12} {:>9}   limit {:+.0f} %\n", unit, "baseline", "now", "change", 100 * limit);
  for (const SceneChange& s : changes) {
    const bool lost = s.change() > limit;
    text += fmt::format("{:<32} {:>12.2f} {:>12.2f} {:>+7.1f} %{}\n", s.scene, s.before, s.now, 100 * s.change(),
                        lost ? "   LOST, mostly in" : "");
    for (size_t t = 0; lost && t < std::min(tasks_shown, s.tasks.size()); ++t)
      if (const TaskChange& c = s.tasks[t]; c.now - c.before > loss_shown * s.before)
        text += fmt::format("  {:<30} {:>12.2f} {:>12.2f} {:>+7.1f} % of the step\n", c.label, c.before, c.now,
                            100 * (c.now - c.before) / s.before);
  }
  return text;
}

bool passes(const std::vector<SceneChange>& changes, double limit) {
  return std::none_of(changes.begin(), changes.end(), [&](const SceneChange& s) { return s.change() > limit; });
}

}  // namespace riven::perf
