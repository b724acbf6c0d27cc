// A program under valgrind's callgrind, which says what it did between two marks: the same on an idle and on a busy
// machine.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace riven::perf {

class Runner;

/// What callgrind wrote about one task in one step.
struct Dump {
  std::filesystem::path file;
  std::string scene, task;
  double particle_steps = 0;  ///< of all steps that are counted
};

/// Runs `command` under callgrind with further options, counting nothing until it asks for it, and hands over its named
/// dumps in order of time. Throws Error (file) where valgrind or the program is missing.
void run_callgrind(const std::vector<std::string>& options, const std::vector<std::string>& command,
                   const std::function<void(const Dump&)>& read);

/// Runs a command to its end, its output into a file if there is one. Throws Error (file) if it cannot be started,
/// (internal) if it fails.
void run_command(std::vector<std::string> words, const std::filesystem::path& output = {});

/// A folder that goes when this object does.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// For the program itself: lets each task of the next `steps` steps end with a dump that bears its name.
void dump_tasks(Runner& runner, int steps);

}  // namespace riven::perf
