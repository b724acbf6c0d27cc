// Launches on the emulated device.
#pragma once
#include <omp.h>

#include <cstddef>
#include <cstdlib>
#include <vector>

#include "core/exec/config.hpp"

namespace riven::exec {

inline namespace RIVEN_SIDE {

/// The threads of one team as one of them sees it.
class Team {
 public:
  Team(int thread, int taken, int threads, void* shared)
      : thread_(thread), taken_(taken), threads_(threads), shared_(shared) {}

  /// f(i) for i in [0, n), shared out to the threads; then all wait for each other.
  template <class F>
  void each(long n, const F& f) const {
    for (long i = thread_; i < n; i += taken_)
      f(i);
    wait();
  }
  /// f(t) by each thread, with its number; then all wait for each other.
  template <class F>
  void each_thread(const F& f) const {
    each(threads_, [&](long t) { f(static_cast<int>(t)); });
  }
  int threads() const { return threads_; }
  /// The memory that they share, of any value at first.
  template <class T>
  T* shared() const {
    return static_cast<T*>(shared_);
  }

 private:
  void wait() const {
    if (taken_ > 1) {
#pragma omp barrier
    }
  }
  int thread_, taken_, threads_;  ///< `taken_` of the host's threads play the parts of `threads_`
  void* shared_;
};

namespace detail {

template <class F>
RIVEN_ONCE void launch_each(long n, const F& f) {
  const F own = f;
  for (long i = n; i-- > 0;)  // backwards: what needs an order that no device keeps goes wrong here
    own(i);
}

template <class F>
RIVEN_ONCE void launch_teams(long n, int threads, size_t shared, const F& f) {
  static const int taken = [] {
    const char* text = std::getenv("RIVEN_TEAM");
    return text ? std::atoi(text) : 1;
  }();
  const F own = f;
  std::vector<double> memory((shared + sizeof(double) - 1) / sizeof(double) + 8);
  void* const at = reinterpret_cast<void*>((reinterpret_cast<size_t>(memory.data()) + 63) / 64 * 64);
  if (taken <= 1) {
    for (long t = 0; t < n; ++t)
      own(Team(0, 1, threads, at), t);
    return;
  }
#pragma omp parallel num_threads(taken)
  for (long t = 0; t < n; ++t)
    own(Team(omp_get_thread_num(), omp_get_num_threads(), threads, at), t);
}

}  // namespace detail

}  // namespace RIVEN_SIDE

}  // namespace riven::exec
