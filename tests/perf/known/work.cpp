// A program whose arithmetic and traffic are known by heart, for the test that they are counted right. Each task passes
// over arrays of 1 MiB, which a cache of 128 KiB cannot hold from one pass to the next; the instructions that matter
// are written out, so that no compiler has a say. The name of each dump is scene|particle-steps|task.
#include <immintrin.h>
#include <valgrind/callgrind.h>

namespace {

constexpr long items = 1L << 17;
alignas(64) double a[items], b[items], c[items];

/// a = b + s c, 4 items at once: 2 flops, 16 bytes loaded and 8 stored an item; a is only written over.
__attribute__((noinline)) void triad() {
  const __m256d s = _mm256_set1_pd(3.0);
  for (long i = 0; i < items; i += 4) {
    __m256d x = _mm256_load_pd(b + i);
    asm volatile("vfmadd231pd (%2), %1, %0" : "+x"(x) : "x"(s), "r"(c + i) : "memory");
    _mm256_store_pd(a + i, x);
  }
}

/// a = sqrt(a) / s, one at a time: 2 flops, 8 bytes loaded and 8 stored.
__attribute__((noinline)) void update() {
  const double s = 1.0;
  for (long i = 0; i < items; ++i) {
    double x = 0;
    asm volatile(
        "vsqrtsd (%1), %0, %0\n\t"
        "vdivsd %2, %0, %0\n\t"
        "vmovsd %0, (%1)"
        : "+x"(x)
        : "r"(a + i), "x"(s)
        : "memory");
  }
}

/// The largest of pairs in single precision, 64 times over the first 16 KiB: no flops, 16 bytes loaded for each four
/// numbers, all from the cache.
__attribute__((noinline)) void compare() {
  const float* numbers = reinterpret_cast<const float*>(b);
  __m128 x = _mm_setzero_ps();
  for (int pass = 0; pass < 64; ++pass)
    for (long i = 0; i < 4096; i += 4)
      asm volatile("vmaxps (%1), %0, %0" : "+x"(x) : "r"(numbers + i) : "memory");
}

}  // namespace

int main() {
  CALLGRIND_START_INSTRUMENTATION;
  for (int pass = 0; pass < 2; ++pass) {  // the first one fills the cache
    CALLGRIND_ZERO_STATS;
    triad();
    if (pass == 1)
      CALLGRIND_DUMP_STATS_AT("known|131072|triad");
  }
  for (int pass = 0; pass < 2; ++pass) {
    CALLGRIND_ZERO_STATS;
    update();
    if (pass == 1)
      CALLGRIND_DUMP_STATS_AT("known|131072|update");
  }
  for (int pass = 0; pass < 2; ++pass) {
    CALLGRIND_ZERO_STATS;
    compare();
    if (pass == 1)
      CALLGRIND_DUMP_STATS_AT("known|65536|compare");  // groups of four
  }
  return a[0] > 0 && b[0] > 0 ? 1 : 0;
}
