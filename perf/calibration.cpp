#include "perf/calibration.hpp"

#include <cmath>
#include <ctime>

#include "perf/machine.hpp"

namespace riven::perf {

namespace {

constexpr long trips = 40'000;    ///< of the multiply-adds
constexpr long near_size = 1024;  ///< doubles of each of three arrays, 24 KiB together
constexpr int near_passes = 500;
constexpr long middle_size = 80'000;  ///< doubles, 640 kB
constexpr int middle_passes = 4;
constexpr long cached_size = 3L << 17;   ///< doubles, 3 MiB
constexpr long distant_size = 1L << 23;  ///< doubles, 64 MiB
constexpr long distant_part = 1L << 17;  ///< doubles, 1 MiB
constexpr int edge = 32;                 ///< cells of the small grid
constexpr int particles = 4 * edge * edge;
constexpr int branches = 30'000;

/// What the compiler must take for having changed any memory.
void forget() {
  asm volatile("" : : : "memory");
}

void halve_and_add(double* a, long size) {
  for (long i = 0; i < size; ++i)
    a[i] = 0.5 * a[i] + 1.0;
}

/// Weights of the three nodes around a place s in [0, 1) cells past the middle node's cell edge.
void weights(double s, double w[3]) {
  w[0] = 0.5 * (1 - s) * (1 - s);
  w[1] = 0.75 - (s - 0.5) * (s - 0.5);
  w[2] = 0.5 * s * s;
}

}  // namespace

double cpu_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

Calibration::Calibration()
    : near_(3 * near_size),
      middle_(middle_size),
      cached_(cached_size, 1.0),
      distant_(distant_size, 1.0),
      x_(particles),
      y_(particles),
      v_(particles),
      nodes_((edge + 2) * (edge + 2) * 2) {
  for (int p = 0; p < particles; ++p) {
    const int cell = p / 4, row = cell / edge;
    x_[p] = cell % edge + 0.25 + 0.5 * (p % 2) + 0.01 * std::sin(p);
    y_[p] = row + 0.25 + 0.5 * (p / 2 % 2) + 0.01 * std::cos(p);
  }
}

double Calibration::round_over(double seconds) {
  const double start = cpu_seconds();
  int rounds = 0;
  double spent = 0;
  do {
    round();
    ++rounds;
    spent = cpu_seconds() - start;
  } while (spent < seconds);
  return spent / rounds;
}

void Calibration::round() {
  sum_ += multiply_add_chains(trips);
  sum_in_cache();
  stream();
  transfer();
  branch();
}

void Calibration::sum_in_cache() {
  double *a = near_.data(), *b = a + near_size, *c = b + near_size;
  for (int pass = 0; pass < near_passes; ++pass) {
    for (long i = 0; i < near_size; ++i)
      a[i] = 0.25 * a[i] + 0.5 * b[i] + c[i];
    forget();
  }
  for (int pass = 0; pass < middle_passes; ++pass) {
    halve_and_add(middle_.data(), middle_size);
    forget();
  }
}

void Calibration::stream() {
  halve_and_add(cached_.data(), cached_size);
  halve_and_add(distant_.data() + next_, distant_part);
  next_ = (next_ + distant_part) % distant_size;
}

void Calibration::branch() {
  unsigned x = integer_, sum = 0;
  for (int i = 0; i < branches; ++i) {
    x = 1664525 * x + 1013904223;
    if (x & 0x10000)
      sum += x >> 20;
    else
      sum ^= x >> 3;
  }
  integer_ = x;
  sum_ += sum;
}

void Calibration::transfer() {
  for (double& a : nodes_)
    a = 0;
  double wx[3], wy[3];
  for (int p = 0; p < particles; ++p) {
    const double column = std::floor(x_[p]), row = std::floor(y_[p]);
    weights(x_[p] - column, wx);
    weights(y_[p] - row, wy);
    double* node = nodes_.data() + 2 * (static_cast<int>(row) * (edge + 2) + static_cast<int>(column));
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        const double w = wx[i] * wy[j];
        node[2 * (j * (edge + 2) + i)] += w;
        node[2 * (j * (edge + 2) + i) + 1] += w * (v_[p] + 1);
      }
  }
  for (int p = 0; p < particles; ++p) {
    const double column = std::floor(x_[p]), row = std::floor(y_[p]);
    weights(x_[p] - column, wx);
    weights(y_[p] - row, wy);
    const double* node = nodes_.data() + 2 * (static_cast<int>(row) * (edge + 2) + static_cast<int>(column));
    double v = 0;
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i)
        v += wx[i] * wy[j] * node[2 * (j * (edge + 2) + i) + 1] / node[2 * (j * (edge + 2) + i)];
    v_[p] = 0.5 * (v - 1);
  }
}

}  // namespace riven::perf
