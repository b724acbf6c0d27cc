// A stable counting sort of items by whole numbers: sums of counts tell where the items of each key begin.
#pragma once
#include <utility>

#include "core/exec/atomic.hpp"
#include "core/exec/parallel.hpp"

namespace riven::exec {

inline namespace RIVEN_SIDE {

#if defined(RIVEN_ON_DEVICE)

namespace detail {

/// number[k] becomes the sum of those before it, for all n of them.
inline void sum_before(const Space& space, Array<int>& numbers) {
  constexpr int threads = 256;
  const long n = numbers.size(), chunks = (n + chunk - 1) / chunk;
  int* const number = data(numbers);
  Array<int> totals(chunks);
  int* const total = data_to_fill(totals);
  launch_teams(space, chunks, threads, threads * sizeof(int), [=] RIVEN_KERNEL(const Team& team, long c) {
    int* share = team.shared<int>();
    const long first = c * chunk, end = n < first + chunk ? n : first + chunk, each = chunk / threads;
    team.each_thread([&](int t) {
      int sum = 0;
      for (long k = first + t * each; k < first + (t + 1) * each && k < end; ++k) {
        const int own = number[k];
        number[k] = sum;
        sum += own;
      }
      share[t] = sum;
    });
    team.each(1, [&](long) {
      int sum = 0;
      for (int t = 0; t < threads; ++t) {
        const int own = share[t];
        share[t] = sum;
        sum += own;
      }
      total[c] = sum;
    });
    team.each_thread([&](int t) {
      for (long k = first + t * each; k < first + (t + 1) * each && k < end; ++k)
        number[k] += share[t];
    });
  });
  int sum = 0;
  for (int& own : totals)
    sum += std::exchange(own, sum);
  const int* before = data(std::as_const(totals));
  launch(space, n, [=] RIVEN_KERNEL(long k) { number[k] += before[k / chunk]; });
}

}  // namespace detail

inline void sort_by_key(const Space& space, const char* label, const Array<int>& keys, long count, Array<int>& start,
                        Array<int>& order) {
  const DeviceStopwatch timed(space, label);
  const long n = keys.size();
  start.resize(count + 1);
  order.resize(n);
  device::zero(data_to_fill(start), static_cast<size_t>(count + 1) * sizeof(int));
  const int* key = data(keys);
  int *begin = data(start), *place = data_to_fill(order);
  launch(space, n, [=] RIVEN_KERNEL(long i) { atomic_add(begin[key[i]], 1); });
  detail::sum_before(space, start);
  // threads fill the places of a key in any order, from its begin on; then they are put in theirs
  launch(space, n, [=] RIVEN_KERNEL(long i) { place[atomic_add(begin[key[i]], 1)] = static_cast<int>(i); });
  launch(space, count, [=] RIVEN_KERNEL(long k) {
    const int first = k > 0 ? begin[k - 1] : 0, end = begin[k];  // each has come to where the next one begins
    for (int a = first + 1; a < end; ++a) {
      const int item = place[a];
      int b = a;
      for (; b > first && place[b - 1] > item; --b)
        place[b] = place[b - 1];
      place[b] = item;
    }
  });
  Array<int> ends;
  ends.swap(start);
  start.resize(count + 1);
  const int* end = data(std::as_const(ends));
  int* first = data_to_fill(start);
  launch(space, count + 1, [=] RIVEN_KERNEL(long k) { first[k] = k > 0 ? end[k - 1] : 0; });
}

#else

/// Fills `order` with the numbers of the items in ascending order of their keys, those of one key in their own order,
/// and start[k] with where key k begins there, k from 0 to `count`. Keys are from 0 to count - 1.
inline void sort_by_key(const Space& space, const char* label, const Array<int>& keys, long count, Array<int>& start,
                        Array<int>& order) {
  const Stopwatch timed(space.timers(), label);
  const long n = keys.size();
  const int* key = keys.data();
  start.clear();
  start.resize(count + 2);  // of key k at k + 1, until the items are placed
  order.resize(n);
  int *begin = start.data(), *place = order.data();
  for (long i = 0; i < n; ++i)
    ++begin[key[i] + 2];
  for (long k = 0; k < count; ++k)
    begin[k + 2] += begin[k + 1];
  for (long i = 0; i < n; ++i)
    place[begin[key[i] + 1]++] = static_cast<int>(i);
  start.resize(count + 1);
}

#endif

}  // namespace RIVEN_SIDE

}  // namespace riven::exec
