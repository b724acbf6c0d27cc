// What four particles of a cell gather and scatter together is what each does alone: sums S q, dS/dx q and dS/dy q over
// nodes with random values, and S A + dS/dx B + dS/dy C to nodes.
#include "kernels/gather.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "kernels/scatter.hpp"

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
    for (auto& of_lane : given_)
      for (Real& v : of_lane)
        v = Real(values(random));
    for (AxisSetting<Real>& a : domain_.axis)
      a.wall_upper = nx;
    block_.template weigh<true>({x_, y_, 0, 0, 2, {&domain_, nullptr, true}}, 0);
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

  /// The same of the last two of four node values gathered by themselves.
  double last_two_apart(int k) const {
    const GatheredFour<Real> four = gather_four<false, 2>(block_, k, q_ + 2, nx);
    double most = 0;
    for (int p = 0; p < 4; ++p)
      for (int c = 0; c < 2; ++c)
        most = std::max<double>(most, std::abs(four.value[c][p] - gather<false>(block_, k + p, q_, nx).value[2 + c]));
    return most;
  }

  /// The largest difference between nodes after four lanes from `k` on have scattered together and one by one.
  double momenta_apart(int k) const {
    const auto A = [&](int lane) { return quad_at<Real>(given_[lane]); };
    return sums_apart(
        [&](const NodeTarget<Real>& to) {
          const Quad<Real> all[4]{A(k), A(k + 1), A(k + 2), A(k + 3)};
          scatter_four(block_, k, all, to);
        },
        [&](const NodeTarget<Real>& to) {
          const Quad<Real> none{};
          for (int p = k; p < k + 4; ++p)
            scatter<false, false>(block_, p, Real(0), A(p), none, none, to);
        });
  }
  double forces_apart(int k) const {
    const auto of_four = [&](int c) {
      return Quad<Real>{given_[k][c], given_[k + 1][c], given_[k + 2][c], given_[k + 3][c]};
    };
    return sums_apart(
        [&](const NodeTarget<Real>& to) {
          scatter_forces_of_four(block_, k, {of_four(0), of_four(1)}, {of_four(2), of_four(3)},
                                 {of_four(4), of_four(5)}, to);
        },
        [&](const NodeTarget<Real>& to) {
          for (int p = k; p < k + 4; ++p) {
            const Real* g = given_[p];
            const Quad<Real> A{0, 0, g[0], g[1]}, B{0, 0, g[2], g[3]}, C{0, 0, g[4], g[5]};
            scatter<false, true>(block_, p, Real(0), A, B, C, to);
          }
        });
  }

 private:
  static constexpr int nx = 12;

  template <class Together, class Alone>
  double sums_apart(const Together& together, const Alone& alone) const {
    alignas(64) Real a[4 * nx * nx], b[4 * nx * nx];
    std::copy(std::begin(q_), std::end(q_), a);
    std::copy(std::begin(q_), std::end(q_), b);
    together({nullptr, a, nx, 0, 0});
    alone({nullptr, b, nx, 0, 0});
    EXPECT_FALSE(std::equal(std::begin(q_), std::end(q_), b));
    double most = 0;
    for (int n = 0; n < 4 * nx * nx; ++n)
      most = std::max<double>(most, std::abs(a[n] - b[n]));
    return most;
  }

  double x_[exec::lanes], y_[exec::lanes];
  alignas(64) Real q_[4 * nx * nx];
  alignas(64) Real given_[exec::lanes][8];  ///< numbers of each particle
  DomainSetting<Real, 2> domain_;
  Block<Real, Shape> block_;
};

/// `most(cell, k)` for four lanes from k on of each shape.
template <class Real, class Most>
void expect_no_difference(double rounding, const Most& most) {
  for (int k = 0; k + 4 <= exec::lanes; ++k) {  // from odd lanes on, too
    EXPECT_LT(most(CellOfFour<Real, Linear>(), k), rounding) << "linear, lanes from " << k;
    EXPECT_LT(most(CellOfFour<Real, UGimp>(), k), rounding) << "uGIMP, lanes from " << k;
    EXPECT_LT(most(CellOfFour<Real, BSpline>(), k), rounding) << "B-spline, lanes from " << k;
  }
}
template <class Most>
void expect_no_difference(const Most& most) {
  expect_no_difference<double>(1e-14, most);
  expect_no_difference<float>(1e-5, most);
}

TEST(GatherByFour, IsWhatEachParticleGathersAlone) {
  expect_no_difference([](const auto& cell, int k) { return cell.apart(k); });
}

TEST(GatherByFour, TakesTwoOfFourValues) {
  expect_no_difference([](const auto& cell, int k) { return cell.last_two_apart(k); });
}

TEST(ScatterByFour, AddsWhatEachParticleAddsAlone) {
  expect_no_difference([](const auto& cell, int k) { return cell.momenta_apart(k); });
}

TEST(ScatterByFour, AddsForcesAsEachParticleDoesAlone) {
  expect_no_difference([](const auto& cell, int k) { return cell.forces_apart(k); });
}

}  // namespace
}  // namespace riven
