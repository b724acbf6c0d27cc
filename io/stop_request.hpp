// Asked to stop: by SIGINT (Ctrl-C), SIGTERM, or because the time is up.
#pragma once
#include <csignal>
#include <string>

namespace riven {

/// While it lives, the first SIGINT and the first SIGTERM are noted, and a second one ends the program as ever. Signals
/// that the program was started to ignore stay ignored. One at a time.
class StopRequest {
 public:
  /// `wall_limit`: s from now.
  explicit StopRequest(double wall_limit);
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

  bool asked() const;
  /// "SIGINT", "SIGTERM" or "the wall limit".
  std::string by() const;

 private:
  double end_;  ///< s, on the clock of stop watches
  struct sigaction before_[2];
};

}  // namespace riven
