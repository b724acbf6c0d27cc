#include "io/stop_request.hpp"

#include <atomic>
#include <cstring>
#include <ctime>
#include <iterator>

#include "core/exec/timers.hpp"

namespace riven {

namespace {

constexpr long patience = 500;  ///< ms

std::atomic<int> noted{0};
std::atomic<long> noted_at{0};  ///< ms
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<long>::is_always_lock_free);

/// Calls nothing but what a signal may.
void note(int signal) {
  timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  const long now = 1000 * time.tv_sec + time.tv_nsec / 1000000;
  if (noted == 0) {
    noted_at = now;
    noted = signal;
  } else if (now - noted_at > patience) {
    std::signal(signal, SIG_DFL);
    raise(signal);  // which ends the program once this returns
  }
}

}  // namespace

StopRequest::StopRequest(double wall_limit, Waits waits) : end_(exec::Stopwatch::now() + wall_limit) {
  noted = 0;
  for (size_t i = 0; i < std::size(signals); ++i) {
    struct sigaction action {};
    action.sa_handler = note;
    action.sa_flags = waits == Waits::resume ? SA_RESTART : 0;
    sigaction(signals[i], nullptr, &before_[i]);
    if (before_[i].sa_handler != SIG_IGN)
      sigaction(signals[i], &action, nullptr);
  }
}

StopRequest::~StopRequest() {
  for (size_t i = 0; i < std::size(signals); ++i)
    sigaction(signals[i], &before_[i], nullptr);
}

bool StopRequest::asked() const {
  return noted.load(std::memory_order_relaxed) != 0 || exec::Stopwatch::now() >= end_;
}

std::string StopRequest::by() const {
  return noted == 0 ? "the wall limit" : std::string("SIG") + sigabbrev_np(noted);
}

}  // namespace riven
