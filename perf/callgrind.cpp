#include "perf/callgrind.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <valgrind/callgrind.h>

#include <fstream>

#include "core/error.hpp"
#include "perf/runner.hpp"

namespace riven::perf {

namespace fs = std::filesystem;

namespace {

constexpr char separator = '|';  // between the parts of a dump's name

/// What the name of a dump, scene|particle-steps|task, says; no task for the rest, when the program ends.
Dump header(const fs::path& file) {
  static const std::string trigger = "desc: Trigger: Client Request: ";
  std::ifstream in(file);
  std::string line, name;
  while (name.empty() && std::getline(in, line))
    if (line.rfind(trigger, 0) == 0)
      name = line.substr(trigger.size());
  if (name.empty())
    return {};
  const size_t first = name.find(separator), second = name.find(separator, first + 1);
  if (second == std::string::npos)
    fail({Exit::internal, "callgrind's output is not as expected", file.string(), name});
  return {file, name.substr(0, first), name.substr(second + 1), std::stod(name.substr(first + 1))};
}

}  // namespace

ScratchFolder::ScratchFolder() {
  std::string pattern = (fs::temp_directory_path() / "riven-perf-XXXXXX").string();
  if (!mkdtemp(pattern.data()))
    fail({Exit::file, "cannot make a folder for callgrind's output", fs::temp_directory_path().string()});
  path_ = pattern;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void run_command(std::vector<std::string> words, const fs::path& output) {
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& w : words)
    arguments.push_back(w.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (!output.empty())
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  pid_t child = 0;
  const int error = posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0)
    fail({Exit::file, "cannot be started: " + std::string(std::strerror(error)), words[0], "", "",
          "install what packages.txt lists"});
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    fail({Exit::internal, "ended badly", fmt::format("{}", fmt::join(words, " ")), fmt::format("{}", status)});
}

void run_callgrind(const std::vector<std::string>& options, const std::vector<std::string>& command,
                   const std::function<void(const Dump&)>& read) {
  if (!fs::exists(command[0]))
    fail({Exit::file, "the program whose instructions are counted is missing", command[0], "", "",
          "cmake --preset v3 && cmake --build --preset v3 --target riven-perf"});
  const ScratchFolder scratch;
  const std::string prefix = "dump";
  std::vector<std::string> words{"valgrind", "--tool=callgrind", "--quiet", "--instr-atstart=no",
                                 "--callgrind-out-file=" + (scratch.path() / prefix).string()};
  words.insert(words.end(), options.begin(), options.end());
  words.insert(words.end(), command.begin(), command.end());
  run_command(words);
  int named = 0;
  for (int n = 1;; ++n) {  // numbered in order of time
    const fs::path file = scratch.path() / fmt::format("{}.{}", prefix, n);
    if (!fs::exists(file))
      break;
    if (const Dump dump = header(file); !dump.task.empty()) {
      read(dump);
      ++named;
    }
  }
  if (named == 0)
    fail({Exit::internal, "callgrind wrote nothing", command[0]});
}

void dump_tasks(Runner& runner, int steps) {
  const long particle_steps = steps * runner.particles();
  const std::vector<TaskRecord> tasks = runner.tasks();
  runner.measure_tasks([=, &runner](size_t index, const std::function<void()>& work) {
    const std::string name =
        fmt::format("{}{}{}{}{}", runner.entrant().name, separator, particle_steps, separator, tasks[index].label);
    CALLGRIND_ZERO_STATS;
    work();
    CALLGRIND_DUMP_STATS_AT(name.c_str());
  });
}

}  // namespace riven::perf
