// The gate's baseline as JSON, laid out so that a change of one task is a change of one line.
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "perf/gate.hpp"

namespace riven::perf {

namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Costs& costs) {
  Json scenes = Json::object();
  for (const SceneCost& s : costs)
    for (const TaskCost& t : s.tasks)
      scenes[s.scene][t.label] = std::round(1e3 * t.cost) / 1e3;  // what is beyond is noise
  return scenes;
}

Costs costs_from(const Json& scenes) {
  Costs costs;
  for (const auto& [scene, tasks] : scenes.items()) {
    costs.push_back({scene, {}});
    for (const auto& [label, cost] : tasks.items())
      costs.back().tasks.push_back({label, cost.get<double>()});
  }
  return costs;
}

}  // namespace

Baseline read_baseline(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in)
    fail({Exit::file, "the baseline cannot be read", file.string(), "", "",
          "riven-perf gate --update REASON makes one"});
  try {
    const Json json = Json::parse(in);
    Baseline b{json.at("compiler").get<std::string>(), costs_from(json.at("instructions")), {}};
    for (const auto& [machine, scenes] : json.at("times").items())
      b.times[machine] = costs_from(scenes);
    return b;
  } catch (const Json::exception& e) {
    fail({Exit::bad_input, "this is no baseline", file.string(), e.what()});
  }
}

void write_baseline(const Baseline& baseline, const std::filesystem::path& file) {
  Json times = Json::object();
  for (const auto& [machine, costs] : baseline.times)
    times[machine] = to_json(costs);
  const Json json = {
      {"compiler", baseline.compiler}, {"instructions", to_json(baseline.instructions)}, {"times", times}};
  write_file(file, json.dump(2) + "\n");
}

}  // namespace riven::perf
