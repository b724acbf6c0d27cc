#include "io/stop_request.hpp"

#include <atomic>

#include "core/exec/timers.hpp"

namespace riven {

namespace {

constexpr int signals[] = {SIGINT, SIGTERM};

std::atomic<int> noted{0};
static_assert(std::atomic<int>::is_always_lock_free);

void note(int signal) {
  noted.store(signal, std::memory_order_relaxed);
}

}  // namespace

StopRequest::StopRequest(double wall_limit) : end_(exec::Stopwatch::now() + wall_limit) {
  noted = 0;
  for (int i = 0; i < 2; ++i) {
    struct sigaction action {};
    action.sa_handler = note;
    action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
    sigaction(signals[i], nullptr, &before_[i]);
    if (before_[i].sa_handler != SIG_IGN)
      sigaction(signals[i], &action, nullptr);
  }
}

StopRequest::~StopRequest() {
  for (int i = 0; i < 2; ++i)
    sigaction(signals[i], &before_[i], nullptr);
}

bool StopRequest::asked() const {
  return noted.load(std::memory_order_relaxed) != 0 || exec::Stopwatch::now() >= end_;
}

std::string StopRequest::by() const {
  const int signal = noted;
  return signal == SIGINT ? "SIGINT" : signal == SIGTERM ? "SIGTERM" : "the wall limit";
}

}  // namespace riven
