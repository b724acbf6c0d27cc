// parallel_for and parallel_reduce over a runtime-chosen space, Kokkos-style. Code of the host's side runs on its
// threads, whatever the space; code of the device's side there (parallel_on_device.hpp).
#pragma once
#if defined(RIVEN_ON_DEVICE)
#include "core/exec/parallel_on_device.hpp"
#else
#include <algorithm>
#include <cstring>
#include <vector>

#include "core/exec/array.hpp"
#include "core/exec/config.hpp"
#include "core/exec/space.hpp"

namespace riven::exec {

inline namespace RIVEN_SIDE {

/// Every space calls the same machine code: inlined into each space's loop, a sum of products may be fused to
/// multiply-adds in one and not in another, and the last bits differ.
template <class F>
RIVEN_ONCE void run_task(const void* f, long i) {
  const F task = *static_cast<const F*>(f);  // a copy of its own: what a kernel writes cannot change what it captured
  task(i);
}

/// f(i) for i in [0, n), untimed: for the parts of a launch that is timed as a whole.
template <class F>
void launch(const Space& space, long n, const F& f) {
  space.run(n, run_task<F>, &f);
}

/// Items that one task takes when a range of small items is cut into chunks. Fixed, so that sums over
/// chunks do not depend on the number of threads.
inline constexpr long chunk = 2048;

/// Items of which one takes as long as a score of those (a node beside cracks), and of which there may be too few for
/// such chunks to keep all threads busy.
inline constexpr long few = 128;

/// The same for small items, of which one task takes some.
template <class F>
void launch_some(const Space& space, long n, long some, const F& f) {
  launch(space, (n + some - 1) / some, [&](long task) {
    const long end = std::min(n, (task + 1) * some);
    for (long i = task * some; i < end; ++i)
      f(i);
  });
}

/// Whether what is launched runs on several threads.
inline bool concurrent(const Space& space) {
  return space.threads() > 1;
}

/// f(i) for i in [0, n); every item is a task of its own (a tile, a body, a chunk).
template <class F>
void parallel_tasks(const Space& space, const char* label, long n, const F& f) {
  Stopwatch watch(space.timers(), label);
  launch(space, n, f);
}

/// f(i) for i in [0, n); items are small (a node, a particle) and one task takes some.
template <class F>
void parallel_for(const Space& space, const char* label, long n, const F& f, long some = chunk) {
  Stopwatch watch(space.timers(), label);
  launch_some(space, n, some, f);
}

/// The threads of a team as one of them sees it: on the host there is but one.
class Team {
 public:
  /// f(i) for i in [0, n), shared out to the threads; then all wait for each other.
  template <class F>
  void each(long n, const F& f) const {
    for (long i = 0; i < n; ++i)
      f(i);
  }
};

/// f(team, own, t) for t in [0, n), each by a team whose threads share `own`, which has any value at first.
template <class Own, class F>
void parallel_teams(const Space& space, const char* label, long n, const F& f) {
  parallel_tasks(space, label, n, [&](long t) {
    Own own;
    f(Team{}, own, t);
  });
}

/// f(i) for i in [0, n), where items add to the same numbers: one after the other here; on a device as `in_order` says,
/// where else f is to add by atomic_add.
template <class F>
void scatter_for(const Space& space, const char* label, bool, long n, const F& f) {
  Stopwatch watch(space.timers(), label);
  for (long i = 0; i < n; ++i)
    f(i);
}

namespace detail {

template <class T>
void zero(T* first, T* last) {
  if (first < last)
    std::memset(static_cast<void*>(first), 0, static_cast<size_t>(last - first) * sizeof(T));
}

}  // namespace detail

/// Zeros all bytes of some arrays, each cut into as many pieces: those over the same things into the same ones.
template <class... Arrays>
void parallel_zero(const Space& space, const char* label, Arrays&... arrays) {
  constexpr long piece = 1L << 19;  // bytes
  const long pieces = ((arrays.size() * long{sizeof(*arrays.data())}) + ...) / piece + 1;
  parallel_tasks(space, label, pieces, [=, ... all = arrays.data(), ... size = arrays.size()](long c) {
    (detail::zero(all + size * c / pieces, all + size * (c + 1) / pieces), ...);
  });
}

/// Sum over i in [0, n) of what f(i, sum) adds to its argument, T being default-constructible to zero and having +=.
/// One task takes some, and their sums are added in order: the result is the same on any number of threads.
template <class T, class F>
T parallel_sum(const Space& space, const char* label, long n, const F& f, long some = chunk) {
  const long chunks = (n + some - 1) / some;
  std::vector<T> part(static_cast<size_t>(chunks));
  parallel_tasks(space, label, chunks, [&, p = part.data()](long c) {
    T sum{};
    const long end = std::min(n, (c + 1) * some);
    for (long i = c * some; i < end; ++i)
      f(i, sum);
    p[c] = sum;
  });
  T total{};
  for (const T& t : part)
    total += t;
  return total;
}

/// Sum of f(i) over i in [0, n), like parallel_sum.
template <class T, class F>
T parallel_reduce(const Space& space, const char* label, long n, const F& f) {
  return parallel_sum<T>(space, label, n, [&](long i, T& sum) { sum += f(i); });
}

}  // namespace RIVEN_SIDE

}  // namespace riven::exec

#endif
