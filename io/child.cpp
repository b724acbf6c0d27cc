#include "io/child.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "core/exec/timers.hpp"
#include "io/atomic_file.hpp"

namespace riven {

namespace {

double seconds(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

/// In the child: never returns. Only calls that are safe after fork.
[[noreturn]] void become(char* const* arguments, int output, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent)  // it died before that was asked for
    _exit(125);
  const int input = open("/dev/null", O_RDONLY);
  if (input < 0 || dup2(input, 0) < 0 || dup2(output, 1) < 0 || dup2(output, 2) < 0)
    _exit(126);
  execvp(arguments[0], arguments);
  _exit(127);
}

}  // namespace

pid_t Children::start(const std::vector<std::string>& command, const std::filesystem::path& log) {
  const int output = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (output < 0)
    fail_file(log, "open the file", errno);
  std::vector<std::string> words = command;
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& w : words)
    arguments.push_back(w.data());
  arguments.push_back(nullptr);
  const double now = exec::Stopwatch::now();
  const pid_t parent = getpid(), child = fork();
  if (child == 0)
    become(arguments.data(), output, parent);
  const int cause = errno;
  close(output);
  if (child < 0)
    fail_file(command.front(), "start the program", cause);
  started_.emplace_back(child, now);
  return child;
}

ChildEnd Children::wait(const std::function<void()>& at_signal) {
  ChildEnd end;
  int status = 0;
  rusage used{};
  for (;;) {
    end.child = wait4(-1, &status, 0, &used);
    if (end.child < 0 && errno == EINTR) {
      if (at_signal)
        at_signal();
      continue;
    }
    const auto which =
        std::find_if(started_.begin(), started_.end(), [&](const auto& s) { return s.first == end.child; });
    if (end.child < 0)
      fail_file(own_program(), "wait for a child", errno);
    if (which == started_.end())
      continue;
    end.wall = exec::Stopwatch::now() - which->second;
    started_.erase(which);
    break;
  }
  end.code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
  end.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  end.cpu = seconds(used.ru_utime) + seconds(used.ru_stime);
  end.memory = used.ru_maxrss * 1024;
  return end;
}

void Children::signal(int number) const {
  for (const auto& [child, since] : started_)
    kill(child, number);
}

std::filesystem::path own_program() {
  return std::filesystem::read_symlink("/proc/self/exe");
}

}  // namespace riven
