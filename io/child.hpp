// Programs run beside this one.
#pragma once
#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace riven {

/// How a child ended and what it took.
struct ChildEnd {
  pid_t child = 0;
  int code = 0;     ///< of exit
  int signal = 0;   ///< that killed it, or 0
  double wall = 0;  ///< s, from start to end
  double cpu = 0;   ///< s, of all its threads
  long memory = 0;  ///< bytes, the most that it held
};

/// Children that run side by side. They die with this program, however it ends.
class Children {
 public:
  /// Starts `command`, a file and its arguments, without input; what it prints goes to `log`. Throws Error (file).
  pid_t start(const std::vector<std::string>& command, const std::filesystem::path& log);
  /// Waits for one to end; there must be one. `at_signal` is called when a signal ends the waiting, which goes on then.
  ChildEnd wait(const std::function<void()>& at_signal = {});
  /// Sends a signal to all that run.
  void signal(int number) const;
  size_t running() const { return started_.size(); }

 private:
  std::vector<std::pair<pid_t, double>> started_;  ///< with the time, s
};

/// This program's own file.
std::filesystem::path own_program();

}  // namespace riven
