// Asked to stop: by SIGINT (Ctrl-C), SIGTERM, SIGHUP (the terminal is closed), SIGUSR1, SIGUSR2 or SIGXCPU (batch
// systems, before the time of a job is up), or because the time is up.
#pragma once
#include <csignal>
#include <iterator>
#include <string>

namespace riven {

/// While it lives, the first of these signals is noted, and one that comes more than half a second later ends the
/// program as ever: what asks a program to stop often asks it and its group, one after the other. Signals that the
/// program was started to ignore stay ignored. One at a time.
class StopRequest {
 public:
  enum class Waits { resume, end };
  /// `wall_limit`: s from now. `waits`: whether system calls that wait go on after a signal, or end with EINTR.
  explicit StopRequest(double wall_limit, Waits waits = Waits::resume);
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

  bool asked() const;
  /// "SIGINT" or another, or "the wall limit".
  std::string by() const;

 private:
  static constexpr int signals[] = {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2, SIGXCPU};
  double end_;  ///< s, on the clock of stop watches
  struct sigaction before_[std::size(signals)];
};

}  // namespace riven
