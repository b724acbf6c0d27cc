// Labelled wall times: one row for each kernel label, in order of first use.
#pragma once
#include <chrono>
#include <cstring>
#include <string>
#include <vector>

namespace riven::exec {

struct Timer {
  std::string label;
  long calls = 0;
  double seconds = 0;
};

class Timers {
 public:
  Timer& row(const char* label) {
    for (Timer& t : rows_)
      if (t.label == label)
        return t;
    rows_.push_back({label});
    return rows_.back();
  }
  const std::vector<Timer>& rows() const { return rows_; }
  void clear() { rows_.clear(); }

 private:
  std::vector<Timer> rows_;
};

/// Adds the time from construction to destruction to one row.
class Stopwatch {
 public:
  Stopwatch(Timers& timers, const char* label) : timers_(timers), label_(label), start_(now()) {}
  ~Stopwatch() {
    Timer& t = timers_.row(label_);
    ++t.calls;
    t.seconds += now() - start_;
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

  static double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

 private:
  Timers& timers_;
  const char* label_;
  double start_;
};

}  // namespace riven::exec
