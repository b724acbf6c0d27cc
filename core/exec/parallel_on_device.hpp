// The launches of parallel.hpp on the device, and teams: threads that share fast memory and wait for each other.
//
// Where no nvcc compiles this the device is emulated (core/exec/device/emulated.cpp): its threads are taken one after
// the other, the last first; those of a team in turn or, with RIVEN_TEAM=n, by n threads at once.
#pragma once
#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/exec/array.hpp"
#include "core/exec/config.hpp"
#include "core/exec/device.hpp"
#include "core/exec/space.hpp"
#if defined(__CUDACC__)
#include "core/exec/device/launch_cuda.hpp"
#else
#include "core/exec/device/launch_emulated.hpp"
#endif

namespace riven::exec {

inline namespace RIVEN_SIDE {

/// f(i) for i in [0, n), one thread each, untimed.
template <class F>
void launch(const Space&, long n, const F& f) {
  if (n > 0)
    detail::launch_each(n, f);
}

/// The same for small items.
template <class F>
void launch_some(const Space& space, long n, long, const F& f) {
  launch(space, n, f);
}

/// Whether what is launched runs on several threads.
inline bool concurrent(const Space&) {
  return true;
}

/// f(team, t) for t in [0, n), by teams of so many threads with so many bytes of memory that they share.
template <class F>
void launch_teams(const Space&, long n, int threads, size_t shared, const F& f) {
  if (n > 0)
    detail::launch_teams(n, threads, shared, f);
}

template <class F>
void parallel_for(const Space& space, const char* label, long n, const F& f, long = 0) {
  const Stopwatch timed(space.timers(), label);
  launch(space, n, f);
}

template <class F>
void parallel_tasks(const Space& space, const char* label, long n, const F& f) {
  parallel_for(space, label, n, f);
}

template <class F>
void scatter_for(const Space& space, const char* label, bool in_order, long n, const F& f) {
  const Stopwatch timed(space.timers(), label);
  if (!in_order)
    return launch(space, n, f);
  launch(space, 1, [=] RIVEN_KERNEL(long) {
    for (long i = 0; i < n; ++i)
      f(i);
  });
}

template <class F>
void parallel_teams(const Space& space, const char* label, long n, int threads, size_t shared, const F& f) {
  const Stopwatch timed(space.timers(), label);
  launch_teams(space, n, threads, shared, f);
}

template <class Own, class F>
void parallel_teams(const Space& space, const char* label, long n, const F& f) {
  constexpr int threads = 64;
  parallel_teams(space, label, n, threads, sizeof(Own),
                 [=] RIVEN_KERNEL(const Team& team, long t) { f(team, *team.shared<Own>(), t); });
}

namespace detail {

template <class T>
void zero(Array<T>& array) {
  device::zero(data_to_fill(array), static_cast<size_t>(array.size()) * sizeof(T));
}

}  // namespace detail

template <class... Arrays>
void parallel_zero(const Space& space, const char* label, Arrays&... arrays) {
  const Stopwatch timed(space.timers(), label);
  (detail::zero(arrays), ...);
}

/// Items of which a team makes one sum, if they are small, and if one takes as long as a score of such.
inline constexpr long chunk = 2048, few = 128;

/// Sum over i in [0, n) of what f(i, sum) adds to its argument, T being default-constructible to zero and having +=.
/// In an order that depends on n alone.
template <class T, class F>
T parallel_sum(const Space& space, const char* label, long n, const F& f, long some = chunk) {
  constexpr int threads = 128;
  const long chunks = (n + some - 1) / some;
  Array<T> parts(chunks);
  parallel_teams(space, label, chunks, threads, threads * sizeof(T),
                 [=, part = data_to_fill(parts)] RIVEN_KERNEL(const Team& team, long c) {
                   T* own = team.shared<T>();
                   const long end = n < (c + 1) * some ? n : (c + 1) * some;
                   team.each_thread([&](int t) {
                     T sum{};
                     for (long i = c * some + t; i < end; i += threads)
                       f(i, sum);
                     own[t] = sum;
                   });
                   for (int half = threads / 2; half > 0; half /= 2)
                     team.each(half, [&](long t) { own[t] += own[t + half]; });
                   team.each(1, [&](long) { part[c] = own[0]; });
                 });
  T total{};
  for (const T& part : std::as_const(parts))
    total += part;
  return total;
}

/// Sum of f(i) over i in [0, n), like parallel_sum.
template <class T, class F>
T parallel_reduce(const Space& space, const char* label, long n, const F& f) {
  return parallel_sum<T>(space, label, n, [=] RIVEN_KERNEL(long i, T& sum) { sum += f(i); });
}

}  // namespace RIVEN_SIDE

}  // namespace riven::exec
