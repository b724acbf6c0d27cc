// Labelled times: one row for each kernel label, in order of first use.
#pragma once
#include <chrono>
#include <deque>
#include <string>
#include <vector>

namespace riven::exec {

/// A point in time, by the clock of the host or of the device.
struct Moment {
  double host = 0;         ///< s
  void* device = nullptr;  ///< see device::mark()
};

/// Adds up times, on the device those between marks in its work: so nothing waits for it until settle().
class Clock {
 public:
  explicit Clock(bool on_device = false) : on_device_(on_device) {}
  /// Settles, as far as the device is still well.
  ~Clock();
  Clock(const Clock&) = delete;
  Clock& operator=(const Clock&) = delete;

  /// Now. A device that fails here says so in settle().
  Moment mark() const noexcept;
  /// Adds the time between two moments to a sum, at the latest in settle().
  void add(const Moment& first, const Moment& last, double& seconds);
  /// Waits for the device, where there are times to come from it. Throws Error (internal) if it has failed.
  void settle();
  /// The same where there are many of them.
  void settle_many() {
    if (pending_.size() >= many)
      settle();
  }

 private:
  struct Pending {
    void *first, *last;
    double* seconds;
  };
  static constexpr size_t many = 4096;
  bool on_device_;
  std::vector<Pending> pending_;
};

/// Adds the time from construction to destruction to a sum that outlives it and the clock's settling.
class Lap {
 public:
  Lap(Clock& clock, double& seconds) : clock_(clock), seconds_(seconds) {
    clock_.settle_many();
    start_ = clock_.mark();
  }
  ~Lap() { clock_.add(start_, clock_.mark(), seconds_); }
  Lap(const Lap&) = delete;
  Lap& operator=(const Lap&) = delete;

 private:
  Clock& clock_;
  double& seconds_;
  Moment start_;
};

struct Timer {
  std::string label;
  long calls = 0;
  double seconds = 0;
};

class Timers {
 public:
  explicit Timers(bool on_device = false) : clock_(on_device) {}
  Timer& row(const char* label) {
    for (Timer& t : rows_)
      if (t.label == label)
        return t;
    rows_.push_back({label});
    return rows_.back();
  }
  /// Waits for what they are to count.
  const std::deque<Timer>& rows() {
    clock_.settle();
    return rows_;
  }
  Clock& clock() { return clock_; }

 private:
  std::deque<Timer> rows_;  // they stay where they are: the clock holds on to their sums
  Clock clock_;
};

/// Counts a call, and adds the time from construction to destruction, to one row.
class Stopwatch {
 public:
  Stopwatch(Timers& timers, const char* label) : Stopwatch(timers.clock(), timers.row(label)) {}

  static double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

 private:
  Stopwatch(Clock& clock, Timer& timer) : lap_(clock, timer.seconds) { ++timer.calls; }
  Lap lap_;
};

}  // namespace riven::exec
