#include "perf/machine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>

#include "core/exec/array.hpp"
#include "core/exec/atomic.hpp"
#include "core/exec/space.hpp"
#include "core/exec/timers.hpp"

namespace riven::perf {

namespace {

#if defined(__AVX512F__)
constexpr int vector_bytes = 64;
#elif defined(__AVX__)
constexpr int vector_bytes = 32;
#else
constexpr int vector_bytes = 16;
#endif
typedef double Vector __attribute__((vector_size(vector_bytes)));
constexpr int width = vector_bytes / static_cast<int>(sizeof(double));
/// Two units with a latency of four or five cycles need ten chains; with the two factors they fit into the sixteen
/// registers of AVX2.
constexpr int chains = 10;

constexpr int repetitions = 5;
constexpr long out_of_cache = 128L << 20;  ///< bytes of each array; several times a last-level cache's share
constexpr long in_cache = 256L << 10;      ///< bytes of the table of atomics

/// Shortest time of several repetitions of body(), in seconds; the first, which warms up, does not count.
template <class Body>
double best_time(const Body& body) {
  double best = 0;
  for (int r = 0; r <= repetitions; ++r) {
    const double start = exec::Stopwatch::now();
    body();
    const double time = exec::Stopwatch::now() - start;
    best = r <= 1 ? time : std::min(best, time);
  }
  return best;
}

/// Memory whose pages are first touched by the threads that will use them.
class Touched {
 public:
  Touched(int threads, long n) : size_(n), data_(static_cast<double*>(std::aligned_alloc(64, bytes(n)))) {
    if (!data_)
      throw std::bad_alloc();
#pragma omp parallel for schedule(static) num_threads(threads)
    for (long i = 0; i < n; ++i)
      data_[i] = 1;
  }
  ~Touched() {
    std::free(data_);
  }
  Touched(const Touched&) = delete;
  Touched& operator=(const Touched&) = delete;
  double* data() {
    return data_;
  }
  long size() const {
    return size_;
  }

 private:
  static size_t bytes(long n) {
    return (static_cast<size_t>(n) * sizeof(double) + 63) / 64 * 64;
  }
  long size_;
  double* data_;
};

/// A value that the optimiser must take as used.
void keep(double value) {
  asm volatile("" : : "x"(value));
}

}  // namespace

double triad_bandwidth(int threads, long bytes) {
  const long n = bytes / static_cast<long>(sizeof(double));
  Touched a(threads, n), b(threads, n), c(threads, n);
  const double time = best_time([&, x = a.data(), y = b.data(), z = c.data()] {
#pragma omp parallel for simd schedule(static) num_threads(threads)
    for (long i = 0; i < n; ++i)
      x[i] = y[i] + 3.0 * z[i];
  });
  return 24.0 * static_cast<double>(n) / time;
}

double update_bandwidth(int threads, long bytes) {
  const long n = bytes / static_cast<long>(sizeof(double));
  Touched a(threads, n);
  const double time = best_time([&, x = a.data()] {
#pragma omp parallel for simd schedule(static) num_threads(threads)
    for (long i = 0; i < n; ++i)
      x[i] = 0.5 * x[i] + 1.0;
  });
  return 16.0 * static_cast<double>(n) / time;
}

double multiply_add_chains(long trips) {
  const Vector factor = Vector{} + 0.999999, term = Vector{} + 1e-6;
  Vector x[chains];
  for (int k = 0; k < chains; ++k)
    x[k] = Vector{} + k;
  for (long t = 0; t < trips; ++t)
#pragma GCC unroll 16
    for (int k = 0; k < chains; ++k)
      x[k] = x[k] * factor + term;
  Vector sum = x[0];
  for (int k = 1; k < chains; ++k)
    sum += x[k];
  double total = 0;
  for (int w = 0; w < width; ++w)
    total += sum[w];
  return total;
}

double fma_rate(int threads) {
  constexpr long trips = 4'000'000;
  const double time = best_time([&] {
#pragma omp parallel num_threads(threads)
    keep(multiply_add_chains(trips));
  });
  return 2.0 * chains * width * static_cast<double>(trips) * threads / time;
}

double atomic_add_rate(int threads, long bytes) {
  const long n = bytes / static_cast<long>(sizeof(double));
  constexpr long adds = 2'000'000;
  exec::Array<double> table(n);
  const double time = best_time([&, x = table.data()] {
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int t = 0; t < threads; ++t) {
      long i = t * n / threads;
      for (long k = 0; k < adds; ++k) {
        exec::atomic_add(x[i], 1.0);
        if (++i == n)
          i = 0;
      }
    }
  });
  return static_cast<double>(adds) * threads / time;
}

MachineRates measure_machine(int threads) {
  return {threads, triad_bandwidth(threads, out_of_cache), update_bandwidth(threads, out_of_cache), fma_rate(threads),
          atomic_add_rate(threads, in_cache)};
}

std::vector<int> core_counts() {
  const int all = exec::available_threads();
  std::vector<int> counts;
  for (int n = 1; n < all; n *= 2)
    counts.push_back(n);
  counts.push_back(all);
  return counts;
}

std::string machine_name() {
  std::ifstream in("/proc/cpuinfo");
  std::map<std::string, std::string> first;  // of each key, that of the first processor
  for (std::string line; std::getline(in, line);)
    if (const size_t colon = line.find(':'); colon != std::string::npos && colon + 2 < line.size())
      first.emplace(line.substr(0, line.find_last_not_of(" \t", colon - 1) + 1), line.substr(colon + 2));
  std::string model = first.count("model name") ? first["model name"] : "unknown processor";
  if (first.count("cpu family") && first.count("model"))
    model += fmt::format(" (family {}, model {})", first["cpu family"], first["model"]);
  return fmt::format("{}, {} cores, vectors of {} bits", model, exec::available_threads(), 8 * vector_bytes);
}

std::string table(const std::vector<MachineRates>& rates) {
  std::string text = fmt::format("{:>7} {:>13} {:>13} {:>13} {:>15}\n", "threads", "triad GB/s", "update GB/s",
                                 "FMA Gflop/s", "atomic M add/s");
  for (const MachineRates& r : rates)
    text += fmt::format("{:>7} {:>13.1f} {:>13.1f} {:>13.1f} {:>15.0f}\n", r.threads, r.triad / 1e9, r.update / 1e9,
                        r.fma / 1e9, r.atomic / 1e6);
  return text;
}

}  // namespace riven::perf
