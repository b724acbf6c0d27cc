#include "perf/count.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <valgrind/callgrind.h>

#include <algorithm>
#include <fstream>

#include "core/error.hpp"
#include "perf/gate_scenes.hpp"
#include "perf/runner.hpp"

namespace riven::perf {

namespace fs = std::filesystem;

namespace {

constexpr int counted_steps = 4;
constexpr char separator = '|';  // between the parts of a dump's name

/// A folder that goes when this object does.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string pattern = (fs::temp_directory_path() / "riven-perf-XXXXXX").string();
    if (!mkdtemp(pattern.data()))
      fail({Exit::file, "cannot make a folder for callgrind's output", fs::temp_directory_path().string()});
    path_ = pattern;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// Runs a command to its end. Throws Error (file) if it cannot be started, (internal) if it fails.
void run_command(std::vector<std::string> words) {
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& w : words)
    arguments.push_back(w.data());
  arguments.push_back(nullptr);
  pid_t child = 0;
  if (const int error = posix_spawnp(&child, arguments[0], nullptr, nullptr, arguments.data(), environ); error != 0)
    fail({Exit::file, "cannot be started: " + std::string(std::strerror(error)), words[0], "", "",
          "install Debian's package of that name"});
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    fail({Exit::internal, "ended badly", fmt::format("{}", fmt::join(words, " ")), fmt::format("{}", status)});
}

/// Adds what a dump holds to the costs: its name is scene|particle-steps|task.
void read_dump(const fs::path& file, Costs& costs) {
  static const std::string trigger = "desc: Trigger: Client Request: ", totals = "totals: ";
  std::ifstream in(file);
  std::string line, name;
  double instructions = -1;
  while (std::getline(in, line))
    if (line.rfind(trigger, 0) == 0)
      name = line.substr(trigger.size());
    else if (line.rfind(totals, 0) == 0)
      instructions = std::stod(line.substr(totals.size()));
  if (name.empty())  // the rest, when the program ends
    return;
  const size_t first = name.find(separator), second = name.find(separator, first + 1);
  if (second == std::string::npos || instructions < 0)
    fail({Exit::internal, "callgrind's output is not as expected", file.string(), name});
  const std::string scene = name.substr(0, first), task = name.substr(second + 1);
  const double particle_steps = std::stod(name.substr(first + 1));
  auto s = std::find_if(costs.begin(), costs.end(), [&](const SceneCost& c) { return c.scene == scene; });
  if (s == costs.end())
    s = costs.insert(costs.end(), {scene, {}});
  auto t = std::find_if(s->tasks.begin(), s->tasks.end(), [&](const TaskCost& c) { return c.label == task; });
  if (t == s->tasks.end())
    t = s->tasks.insert(s->tasks.end(), {task, 0});
  t->cost += instructions / particle_steps;
}

}  // namespace

fs::path counted_program() {
  return RIVEN_COUNTED_PROGRAM;
}

Costs count_instructions(const fs::path& program, const std::string& slowed) {
  if (!fs::exists(program))
    fail({Exit::file, "the program whose instructions are counted is missing", program.string(), "", "",
          "cmake --preset v3 && cmake --build --preset v3 --target riven-perf"});
  const ScratchFolder scratch;
  const std::string prefix = "dump";
  std::vector<std::string> words{"valgrind",
                                 "--tool=callgrind",
                                 "--quiet",
                                 "--instr-atstart=no",
                                 "--callgrind-out-file=" + (scratch.path() / prefix).string(),
                                 program.string(),
                                 "step-for-callgrind"};
  if (!slowed.empty())
    words.insert(words.end(), {"--slow-down", slowed});
  run_command(words);
  Costs costs;
  for (int n = 1; fs::exists(scratch.path() / fmt::format("{}.{}", prefix, n)); ++n)  // numbered in order of time
    read_dump(scratch.path() / fmt::format("{}.{}", prefix, n), costs);
  if (costs.empty())
    fail({Exit::internal, "callgrind wrote nothing", scratch.path().string()});
  return costs;
}

void step_for_callgrind(const std::string& slowed) {
  for (const GateScene& scene : gate_scenes()) {
    Runner runner(scene.counted, exec::Kind::serial, 1);
    runner.run(scene.warm_up);
    if (!slowed.empty())
      runner.slow_down(slowed);
    const long particle_steps = counted_steps * runner.particles();
    runner.measure_tasks([&](const Task& task, size_t, const std::function<void()>& work) {
      const std::string name =
          fmt::format("{}{}{}{}{}", scene.counted.name, separator, particle_steps, separator, task.label);
      CALLGRIND_ZERO_STATS;
      work();
      CALLGRIND_DUMP_STATS_AT(name.c_str());
    });
    CALLGRIND_START_INSTRUMENTATION;
    runner.run(counted_steps);
    CALLGRIND_STOP_INSTRUMENTATION;
  }
}

}  // namespace riven::perf
