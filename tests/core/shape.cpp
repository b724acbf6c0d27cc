// Shape functions: partition of unity, linear reproduction, gradients and closed forms, from wall to wall.
#include "core/math/shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <string>

namespace riven {
namespace {

constexpr int lower = 4, upper = 12;  // node numbers of the walls

template <class Shape>
class ShapeFunctions : public testing::Test {
 public:
  static constexpr double halves[] = {0.5, 0.25, 1. / 6, 0.05};  ///< of the particle's domain, in cells

  static AxisSetting<double> setting(double half) { return {half, 1 / (4 * half), lower, upper}; }

  /// test(X, setting) between the walls: on nodes, half-way, and where nothing is round.
  static void everywhere(const std::function<void(double, const AxisSetting<double>&)>& test) {
    for (const double half : halves)
      for (int n = 0; n <= 24 * (upper - lower); ++n) {
        test(lower + n / 24., setting(half));
        if (n < 24 * (upper - lower))
          test(lower + n / 24. + 0.0137, setting(half));
      }
  }
};

struct ShapeName {
  template <class Shape>
  static std::string GetName(int) {
    return Shape::name;
  }
};
using Shapes = testing::Types<Linear, UGimp, BSpline>;
TYPED_TEST_SUITE(ShapeFunctions, Shapes, ShapeName);

/// Values and gradients by node number, so that neighbouring cells can be compared.
struct ByNode {
  std::map<int, double> s, g;
};
template <class Shape>
ByNode by_node(double X, const AxisSetting<double>& a) {
  const auto axis = Shape::axis(X, a);
  ByNode out;
  for (int i = 0; i < Shape::width; ++i) {
    out.s[axis.base + i] += axis.s[i];
    out.g[axis.base + i] += axis.g[i];
  }
  return out;
}

TYPED_TEST(ShapeFunctions, SumToOneAndReproduceLinearFieldsUpToTheWalls) {
  this->everywhere([](double X, const AxisSetting<double>& a) {
    const auto axis = TypeParam::axis(X, a);
    double one = 0, x = 0, zero = 0, slope = 0;
    for (int i = 0; i < TypeParam::width; ++i) {
      EXPECT_GE(axis.s[i], 0) << X;
      one += axis.s[i];
      x += axis.s[i] * (axis.base + i);
      zero += axis.g[i];
      slope += axis.g[i] * (axis.base + i);
    }
    EXPECT_NEAR(one, 1, 1e-14) << X;
    EXPECT_NEAR(x, X, 1e-13) << X;
    EXPECT_NEAR(zero, 0, 1e-14) << X;
    EXPECT_NEAR(slope, 1, 1e-13) << X;
  });
}

TYPED_TEST(ShapeFunctions, GradientsAreTheDerivativesOfTheValues) {
  const double d = 1e-6;
  this->everywhere([d](double X, const AxisSetting<double>& a) {
    const double from = std::max(X - d, double{lower}), to = std::min(X + d, double{upper});
    const ByNode below = by_node<TypeParam>(from, a), at = by_node<TypeParam>(X, a), above = by_node<TypeParam>(to, a);
    if (TypeParam::width == 2 && std::floor(from) != std::floor(to))
      return;  // hats have a kink at their nodes
    auto values = above.s;
    for (const auto& [node, s] : below.s)
      values[node] -= s;
    // second derivatives are at most 1 / (2 half) <= 10, and jump: the difference may be off by that times d
    for (const auto& [node, change] : values)
      EXPECT_NEAR(change / (to - from), at.g.contains(node) ? at.g.at(node) : 0, 12 * d) << X << ", node " << node;
  });
}

TYPED_TEST(ShapeFunctions, DoNotJumpWhereAParticleTakesOtherNodes) {
  const double d = 1e-12;
  this->everywhere([d](double X, const AxisSetting<double>& a) {
    const ByNode here = by_node<TypeParam>(X, a), there = by_node<TypeParam>(X - d, a);
    for (const auto& [node, s] : here.s)
      EXPECT_NEAR(s, there.s.contains(node) ? there.s.at(node) : 0, 1e-11) << X;
  });
}

/// A row of particles under a uniform stress between tractions on its ends is in balance at every node, however it lies
/// in its cells; tractions are whole, and the nodes that bear them are those of the last particles.
TYPED_TEST(ShapeFunctions, AtEdgesBalanceARowUnderUniformStress) {
  for (const double half : this->halves)
    for (int n = 0; n < 100; ++n) {
      const double d = 2 * half, last = upper - 1.5003 - n / 100.;
      const int count = static_cast<int>(std::lround(5 / d));
      AxisSetting<double> a = this->setting(half);
      std::map<int, double> force;
      double whole[2] = {0, 0};
      for (int k = 0; k < count; ++k)
        for (const auto& [node, g] : by_node<TypeParam>(last - k * d, a).g)
          force[node] -= d * g;
      for (const int out : {-1, 1}) {
        const auto edge = axis_at_edge<TypeParam>(out < 0 ? last - (count - 1) * d : last, a, out);
        for (int i = 0; i < TypeParam::width; ++i) {
          force[edge.base + i] += out * edge.s[i];
          whole[out > 0] += edge.s[i];
        }
      }
      for (const auto& [node, f] : force)
        EXPECT_NEAR(f, 0, 1e-13) << "node " << node << " of a row from " << last << ", particles of " << d;
      EXPECT_NEAR(whole[0], 1, 1e-13);
      EXPECT_NEAR(whole[1], 1, 1e-13);
    }
}

double hat(double r) {
  return std::max(0., 1 - std::abs(r));
}

/// Integral of the hat function from -1 to r.
double hat_integral(double r) {
  if (r <= -1)
    return 0;
  if (r >= 1)
    return 1;
  return r < 0 ? 0.5 * (1 + r) * (1 + r) : 1 - 0.5 * (1 - r) * (1 - r);
}

/// Sulsky, Chen and Schreyer 1994.
TEST(ShapeFormulas, LinearIsTheHat) {
  ShapeFunctions<Linear>::everywhere([](double X, const AxisSetting<double>& a) {
    for (const auto& [node, s] : by_node<Linear>(X, a).s)
      EXPECT_NEAR(s, hat(X - node), 1e-14);
  });
}

/// Bardenhagen and Kober 2004, eq. 36: S = 1/(2 l) integral of the hat over the particle's domain.
TEST(ShapeFormulas, UGimpIsTheHatAveragedOverTheParticle) {
  ShapeFunctions<UGimp>::everywhere([](double X, const AxisSetting<double>& a) {
    const ByNode found = by_node<UGimp>(X, a);
    for (int node = lower - 1; node <= upper + 1; ++node) {
      const double s = (hat_integral(X + a.half - node) - hat_integral(X - a.half - node)) / (2 * a.half);
      const double g = (hat(X + a.half - node) - hat(X - a.half - node)) / (2 * a.half);
      EXPECT_NEAR(found.s.contains(node) ? found.s.at(node) : 0, s, 1e-13) << X;
      EXPECT_NEAR(found.g.contains(node) ? found.g.at(node) : 0, g, 1e-13) << X;
    }
  });
}

TEST(ShapeFormulas, UGimpAtAnEdgeIsTheHatThere) {
  ShapeFunctions<UGimp>::everywhere([](double X, const AxisSetting<double>& a) {
    for (const int out : {-1, 1}) {
      const auto edge = axis_at_edge<UGimp>(X, a, out);
      for (int i = 0; i < UGimp::width; ++i)
        EXPECT_NEAR(edge.s[i], hat(X + out * a.half - (edge.base + i)), 1e-13) << X;
    }
  });
}

double quadratic_bspline(double r) {
  const double d = std::abs(r);
  return d < 0.5 ? 0.75 - d * d : d < 1.5 ? 0.5 * (1.5 - d) * (1.5 - d) : 0;
}

/// The ghost node behind a wall carries the linear extrapolation of the two nodes inside, v_-1 = 2 v_0 - v_1.
TEST(ShapeFormulas, BSplineFoldsTheGhostNodeInwards) {
  ShapeFunctions<BSpline>::everywhere([](double X, const AxisSetting<double>& a) {
    std::map<int, double> expected;
    for (int node = lower; node <= upper; ++node)
      expected[node] = quadratic_bspline(X - node);
    const double below = quadratic_bspline(X - (lower - 1)), above = quadratic_bspline(X - (upper + 1));
    expected[lower] += 2 * below;
    expected[lower + 1] -= below;
    expected[upper] += 2 * above;
    expected[upper - 1] -= above;
    const ByNode found = by_node<BSpline>(X, a);
    for (const auto& [node, s] : expected)
      EXPECT_NEAR(found.s.contains(node) ? found.s.at(node) : 0, s, 1e-13) << X << ", node " << node;
    for (const auto& [node, s] : found.s) {
      if (node < lower || node > upper) {
        EXPECT_EQ(s, 0) << "nothing may reach the ghost node " << node << " from " << X;
      }
    }
  });
}

/// A particle that has slipped past a wall by less than half a cell keeps the sums, and masses that are not negative.
TEST(ShapeFormulas, BSplineStaysPositiveBehindTheWalls) {
  for (const double past : {0.01, 0.2, 0.49})
    for (const double X : {lower - past, upper + past}) {
      double one = 0;
      for (const auto& [node, s] : by_node<BSpline>(X, ShapeFunctions<BSpline>::setting(0.25)).s) {
        EXPECT_GE(s, 0);
        one += s;
      }
      EXPECT_NEAR(one, 1, 1e-14);
    }
}

}  // namespace
}  // namespace riven
