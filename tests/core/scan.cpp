// Sums before each item, against those of a loop; also of items that are written over meanwhile.
#include "core/exec/scan.hpp"

#include <gtest/gtest.h>

namespace riven::exec {
namespace {

struct Two {
  int a = 0;
  long b = 0;
  Two& operator+=(const Two& o) { return a += o.a, b += o.b, *this; }
};

TEST(Scan, SumsWhatIsBeforeEachItem) {
  for (const Kind kind : {Kind::serial, Kind::openmp, Kind::stdpar})
    for (const int threads : {1, 3})
      for (const long n : {0L, 1L, chunk - 1, chunk, chunk + 1, 5 * chunk + 7}) {
        const Space space(kind, threads);
        Array<int> numbers(n), first(n);
        Array<long> second(n);
        for (long i = 0; i < n; ++i)
          numbers[i] = static_cast<int>(i % 7 - 2);
        const auto of = [number = numbers.data()](long i) { return Two{number[i], i}; };
        const auto scan = begin_scan<Two>(space, n, of);
        end_scan(scan, [=, number = numbers.data(), a = first.data(), b = second.data()](long i, const Two& before) {
          const Two own = of(i);
          number[i] = -1;
          a[i] = before.a;
          b[i] = before.b;
          return own;
        });
        int sum = 0;
        for (long i = 0; i < n; ++i) {
          ASSERT_EQ(first[i], sum) << i << " of " << n << " on " << threads;
          ASSERT_EQ(second[i], i * (i - 1) / 2);
          ASSERT_EQ(numbers[i], -1);
          sum += static_cast<int>(i % 7 - 2);
        }
        EXPECT_EQ(scan.total.a, sum);
        EXPECT_EQ(scan.total.b, n * (n - 1) / 2);
      }
}

}  // namespace
}  // namespace riven::exec
