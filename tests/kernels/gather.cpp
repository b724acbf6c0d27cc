// What four particles of a cell gather together is what each gathers alone: sums S q, dS/dx q and dS/dy q over nodes
// with random values.
#include "kernels/gather.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace riven {
namespace {

template <class Real, class Shape>
class CellOfFour {
 public:
  CellOfFour() {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> in_quarter(0.05, 0.2), values(-1, 1);
    for (int k = 0; k < exec::lanes; ++k) {  // a quarter of a cell has the same nodes by any shape
      x_[k] = 3 + in_quarter(random);
      y_[k] = 2 + in_quarter(random);
    }
    for (Real& v : q_)
      v = Real(values(random));
    for (AxisSetting<Real>& a : domain_.axis)
      a.wall_upper = nx;
    block_.weigh({x_, y_, 0, 0, 2, {&domain_, nullptr, true}}, 0);
  }

  /// The largest difference between four lanes from `k` on and each of them.
  double apart(int k) const {
    EXPECT_TRUE(block_.four_together(k));
    const GatheredFour<Real> four = gather_from<true, 4>(block_, k, q_, nx, FourTogether{});
    double most = 0;
    for (int p = 0; p < 4; ++p) {
      const Gathered<Real> one = gather_from<true, 4>(block_, k + p, q_, nx, nullptr);
      const auto take = [&](Real a, Real b) { most = std::max<double>(most, std::abs(a - b)); };
      for (int c = 0; c < 4; ++c)
        take(four.value[c][p], one.value[c]);
      for (int c = 0; c < 2; ++c) {
        take(four.dx[c][p], one.dx[c]);
        take(four.dy[c][p], one.dy[c]);
      }
    }
    return most;
  }

 private:
  static constexpr int nx = 12;
  double x_[exec::lanes], y_[exec::lanes];
  alignas(64) Real q_[4 * nx * nx];
  DomainSetting<Real, 2> domain_;
  Block<Real, Shape> block_;
};

template <class Real>
void expect_no_difference(double rounding) {
  for (int k = 0; k + 4 <= exec::lanes; ++k) {  // from odd lanes on, too
    EXPECT_LT((CellOfFour<Real, Linear>().apart(k)), rounding) << "linear, lanes from " << k;
    EXPECT_LT((CellOfFour<Real, UGimp>().apart(k)), rounding) << "uGIMP, lanes from " << k;
    EXPECT_LT((CellOfFour<Real, BSpline>().apart(k)), rounding) << "B-spline, lanes from " << k;
  }
}

TEST(GatherByFour, IsWhatEachParticleGathersAlone) {
  expect_no_difference<double>(1e-14);
  expect_no_difference<float>(1e-5);
}

}  // namespace
}  // namespace riven
