// A line that says how far a run has come: on a terminal one that is written over, elsewhere a new one now and then.
#pragma once
#include <string>
#include <string_view>

namespace riven {

/// "1.24 ms": three digits and an SI prefix, from attoseconds to seconds.
std::string format_time(double seconds);
/// "1 h 5 min", "2 min 3 s", "7 s": how long something takes.
std::string format_duration(double seconds);
/// "2.17 GB": three digits and an SI prefix, up to terabytes.
std::string format_bytes(long bytes);

struct ProgressState {
  long step = 0;
  double time = 0, end_time = 0, dt = 0;  ///< s
  std::string_view limiter;               ///< what keeps dt small: "wave speed", "particle speed", ...
  double particle_steps_per_second = 0;
  double seconds_left = 0;  ///< not finite while unknown
};
std::string progress_line(const ProgressState& state);

class Progress {
 public:
  /// Writes to a descriptor, by default standard error, unless quiet. `between`: s between two lines where that is no
  /// terminal.
  Progress(double start_time, double end_time, long particles, bool quiet, int descriptor = 2, double between = 60);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Called after every step. On a terminal it writes once a second, and at the end.
  void update(long step, double time, double dt, std::string_view limiter);
  /// Ends the line, so that what follows begins a new one. Called by the destructor too.
  void finish();

 private:
  void write(const std::string& text) const;

  double start_time_, end_time_;
  long particles_;
  bool active_;
  int descriptor_;
  bool terminal_;
  double interval_;  ///< s
  bool line_open_ = false;
  long last_step_ = -1, first_step_ = 0;
  double began_, last_written_;  ///< wall clock, s
};

}  // namespace riven
