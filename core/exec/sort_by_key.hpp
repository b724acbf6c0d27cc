// A stable counting sort of items by whole numbers: sums of counts tell where the items of each key begin.
#pragma once
#include <utility>

#include "core/exec/atomic.hpp"
#include "core/exec/parallel.hpp"
#include "core/exec/scan.hpp"
#include "core/exec/sort_few.hpp"

namespace riven::exec {

inline namespace RIVEN_SIDE {

#if defined(RIVEN_ON_DEVICE)

inline void sort_by_key(const Space& space, const char* label, const Array<int>& keys, long count, Array<int>& start,
                        Array<int>& order) {
  const Stopwatch timed(space.timers(), label);
  const long n = keys.size();
  start.resize(count + 1);
  order.resize(n);
  device::zero(data_to_fill(start), static_cast<size_t>(count + 1) * sizeof(int));
  const int* key = data(keys);
  int *begin = data(start), *place = data_to_fill(order);
  launch(space, n, [=] RIVEN_KERNEL(long i) { atomic_add(begin[key[i]], 1); });
  const auto counts = begin_scan<int>(space, count + 1, [=] RIVEN_KERNEL(long k) { return begin[k]; });
  end_scan(counts, [=] RIVEN_KERNEL(long k, int before) {
    const int own = begin[k];
    begin[k] = before;
    return own;
  });
  // threads fill the places of a key in any order, from its begin on; then they are put in theirs
  launch(space, n, [=] RIVEN_KERNEL(long i) { place[atomic_add(begin[key[i]], 1)] = static_cast<int>(i); });
  launch(space, count, [=] RIVEN_KERNEL(long k) {
    sort_few(place + (k > 0 ? begin[k - 1] : 0), place + begin[k]);  // each has come to where the next one begins
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
