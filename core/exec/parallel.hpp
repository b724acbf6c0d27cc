// parallel_for and parallel_reduce over a runtime-chosen space, Kokkos-style. Code of the host's side runs on its
// threads, whatever the space; code of the device's side there (parallel_on_device.hpp).
#pragma once
#if defined(RIVEN_ON_DEVICE)
#include "core/exec/parallel_on_device.hpp"
#else
#include <omp.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <execution>
#include <vector>

#include "core/exec/array.hpp"
#include "core/exec/config.hpp"
#include "core/exec/counting.hpp"
#include "core/exec/space.hpp"

namespace riven::exec {

inline namespace RIVEN_SIDE {

/// Every space calls the same machine code: inlined into each space's loop, a sum of products may be fused to
/// multiply-adds in one and not in another, and the last bits differ.
template <class F>
RIVEN_ONCE void run_task(const F& f, long i) {
  const F task = f;  // a copy of its own: what a kernel writes cannot change what it captured
  task(i);
}

namespace detail {

/// A range of tasks that begins with one thread, and that others help with when they are done with their own.
struct alignas(64) Share {
  std::atomic<long> next;
  long end;
};

/// Thread t begins with the t-th part of [0, n): in all launches of a step with the same part of the grid and of the
/// particles, whose lines stay in its cache.
template <class F>
void launch_openmp(int threads, long n, const F& f) {
  std::vector<Share> shares(static_cast<size_t>(threads));
  for (int t = 0; t < threads; ++t) {
    shares[static_cast<size_t>(t)].next = n * t / threads;
    shares[static_cast<size_t>(t)].end = n * (t + 1) / threads;
  }
#pragma omp parallel num_threads(threads)
  for (int k = 0, own = omp_get_thread_num(); k < threads; ++k) {
    Share& share = shares[static_cast<size_t>((own + k) % threads)];
    for (long i; (i = share.next.fetch_add(1, std::memory_order_relaxed)) < share.end;)
      run_task(f, i);
  }
}

}  // namespace detail

/// f(i) for i in [0, n), untimed: for the parts of a launch that is timed as a whole.
template <class F>
void launch(const Space& space, long n, const F& f) {
  // waking threads for a single task costs more than the task
  switch (n <= 1 ? Kind::serial : space.kind()) {
    case Kind::serial:
      for (long i = 0; i < n; ++i)
        run_task(f, i);
      break;
    case Kind::openmp:
    case Kind::cuda: detail::launch_openmp(space.threads(), n, f); break;
    case Kind::stdpar:
      // par, not par_unseq: kernels may use atomics
      space.arena().execute(
          [&] { std::for_each(std::execution::par, Counting{0}, Counting{n}, [&](long i) { run_task(f, i); }); });
      break;
  }
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
