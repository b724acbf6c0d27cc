#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/suggest.hpp"
#include "kernels/simulation.hpp"
#include "perf/commands.hpp"
#include "perf/count.hpp"
#include "perf/gate.hpp"
#include "perf/machine.hpp"
#include "perf/pace.hpp"

namespace riven::perf {

namespace {

namespace fs = std::filesystem;

/// A disturbance can only make a scene slower: one that seems to have lost is measured again this often.
constexpr int more_tries = 5;
/// Of so many measurements a baseline keeps the middle one: a lucky one would call what is usual a loss.
constexpr int baseline_tries = 5;

struct Options {
  fs::path baseline = RIVEN_BASELINE, program = counted_program();
  std::string update, slowed;
  bool instructions = true, times = true;
  size_t first = std::numeric_limits<size_t>::max();  ///< so many of the scenes at most
};

std::vector<GateScene> scenes_of(const Options& o) {
  std::vector<GateScene> scenes = gate_scenes();
  scenes.resize(std::min(o.first, scenes.size()));
  return scenes;
}

Costs first_of(Costs costs, size_t count) {
  costs.resize(std::min(count, costs.size()));
  return costs;
}

std::string compiler() {
#if defined(__clang__)
  return "clang " __VERSION__;
#else
  return "g++ " __VERSION__;
#endif
}

Costs measure_times(const Options& o) {
  Calibration calibration;
  Costs costs;
  for (const GateScene& scene : scenes_of(o))
    costs.push_back(measure_pace(scene, calibration, o.slowed));
  return costs;
}

Costs measure_baseline_times(const Options& o) {
  std::vector<Costs> tries;
  tries.reserve(baseline_tries);
  for (int n = 0; n < baseline_tries; ++n)
    tries.push_back(measure_times(o));
  Costs middle;
  for (size_t s = 0; s < tries[0].size(); ++s) {
    std::sort(tries.begin(), tries.end(), [s](const Costs& a, const Costs& b) { return a[s].total() < b[s].total(); });
    middle.push_back(tries[baseline_tries / 2][s]);
  }
  return middle;
}

/// Scenes that are beyond the limit once more, keeping the quicker of both.
void measure_again(const Options& o, const Costs& before, Costs& now) {
  Calibration calibration;
  const std::vector<SceneChange> changes = compare(before, now);
  const std::vector<GateScene> scenes = scenes_of(o);
  for (size_t s = 0; s < scenes.size(); ++s)
    if (changes[s].change() > time_limit)
      if (SceneCost again = measure_pace(scenes[s], calibration, o.slowed); again.total() < now[s].total())
        now[s] = std::move(again);
}

bool check_instructions(const Options& o, const Baseline& baseline) {
  if (baseline.instructions.empty()) {
    fmt::print("Instructions are not compared: the baseline has none\n");
    return true;
  }
  if (baseline.compiler != compiler()) {
    fmt::print("Instructions are not compared: the baseline was made with {}, this is {}\n", baseline.compiler,
               compiler());
    return true;
  }
  const auto changes =
      compare(first_of(baseline.instructions, o.first), count_instructions(o.program, o.first, o.slowed));
  fmt::print("{}\n", report(changes, instruction_limit, "instructions/particle-step"));
  return passes(changes, instruction_limit);
}

bool check_times(const Options& o, const Baseline& baseline) {
  const auto known = baseline.times.find(machine_name());
  if (known == baseline.times.end()) {
    fmt::print("Times are not compared: the baseline has none for this processor, {}\n", machine_name());
    return true;
  }
  const Costs before = first_of(known->second, o.first);
  Costs now = measure_times(o);
  for (int n = 0; n < more_tries && !passes(compare(before, now), time_limit); ++n)
    measure_again(o, before, now);
  const auto changes = compare(before, now);
  fmt::print("{}\n", report(changes, time_limit, "time/particle-step, calibrated"));
  return passes(changes, time_limit);
}

nlohmann::ordered_json totals(const Costs& costs) {
  nlohmann::ordered_json json;
  for (const SceneCost& s : costs)
    json[s.scene] = s.total();
  return json;
}

/// Makes the baseline anew, keeping the times of other processors and what is not measured, and adds a line to the
/// history beside it. Throws Error (bad input) if scenes of the baseline would be lost.
void update(const Options& o) {
  Baseline b;
  if (fs::exists(o.baseline))
    b = read_baseline(o.baseline);
  if (b.instructions.size() > o.first)
    fail({Exit::bad_input, "the baseline has more scenes, which would be lost", "--first", fmt::format("{}", o.first),
          fmt::format("{} or more", b.instructions.size())});
  if (o.instructions) {
    b.compiler = compiler();
    b.instructions = count_instructions(o.program, o.first);
  }
  if (o.times)
    b.times[machine_name()] = measure_baseline_times(o);
  write_baseline(b, o.baseline);
  const nlohmann::ordered_json line = {{"date", fmt::format("{:%F}", fmt::gmtime(std::time(nullptr)))},
                                       {"reason", o.update},
                                       {"compiler", b.compiler},
                                       {"machine", machine_name()},
                                       {"instructions", totals(b.instructions)},
                                       {"times", totals(b.times[machine_name()])}};
  const fs::path history = fs::path(o.baseline).replace_extension(".history.jsonl");
  const int file = open(history.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
  if (file < 0)
    fail_file(history, "open", errno);
  append(file, history, line.dump() + "\n");
  close(file);
  fmt::print("{} and a line of {} are written\n", o.baseline.string(), history.string());
}

/// Throws Error (bad input) if no scene has a task of that label.
void check_label(const std::string& slowed) {
  std::vector<std::string> labels;
  for (const GateScene& scene : gate_scenes())
    for (const Task& task : assemble_step<double>(scene.counted.scene, make_plan(scene.counted.scene)))
      labels.push_back(task.label);
  if (std::find(labels.begin(), labels.end(), slowed) == labels.end())
    fail({Exit::bad_input, "no scene has a task of that label", "--slow-down", slowed, "the labels of `riven plan`",
          "did you mean '" + nearest(slowed, labels) + "'?"});
}

void gate(const Options& o) {
  if (!o.update.empty())
    return update(o);
  if (!o.slowed.empty())
    check_label(o.slowed);
  const Baseline baseline = read_baseline(o.baseline);
  const bool fewer = !o.instructions || check_instructions(o, baseline);
  const bool sooner = !o.times || check_times(o, baseline);
  fmt::print("{}\n", fewer && sooner ? "The gate is open" : "The gate is shut: a scene lost more than its limit");
  if (!fewer || !sooner)
    throw CLI::RuntimeError(lost);
}

}  // namespace

void add_gate(CLI::App& app) {
  auto o = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "gate", fmt::format("Fails (exit code {}) when a scene takes over {:.0f} % more instructions, or {:.0f} % more "
                          "time in terms of a calibration, than its baseline says; prints which task lost",
                          lost, 100 * instruction_limit, 100 * time_limit));
  command->add_option("--baseline", o->baseline, "The file to compare with, or to write")->capture_default_str();
  command->add_option("--update", o->update, "Make the baseline anew; say why, for the history");
  command->add_option("--program", o->program, "riven-perf built for valgrind, whose instructions are counted")
      ->capture_default_str();
  command->add_flag("!--no-instructions", o->instructions,
                    "Times only: of a processor that is new to the baseline, say");
  command->add_flag("!--no-times", o->times, "Instructions only");
  command
      ->add_option("--slow-down", o->slowed,
                   "Passes over the particles once more in this task: shows that it is caught")
      ->excludes("--update");
  command->add_option("--first", o->first, "Only so many of the scenes: the first three, without cracks, take least")
      ->check(CLI::Range(1, 100));
  command->callback([o] { gate(*o); });

  auto slowed = std::make_shared<std::string>();
  auto number = std::make_shared<size_t>(0);
  CLI::App* stepping = app.add_subcommand("step-for-callgrind", "What gate runs under callgrind")->group("");
  stepping->add_option("--slow-down", *slowed);
  stepping->add_option("scene", *number)->required();
  stepping->callback([slowed, number] { step_for_callgrind(*number, *slowed); });
}

}  // namespace riven::perf
