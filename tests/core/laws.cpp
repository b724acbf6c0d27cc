// Elastic laws: rotations leave no stress, stress is the derivative of energy, plane stress is what a solid does whose
// faces are free, waves are as fast as they say.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "core/laws/elastic.hpp"

namespace riven {
namespace {

constexpr Plane planes[] = {Plane::strain, Plane::stress};

template <class T>
struct LawCase {
  using Law = T;
  static Material material() {
    return {"solid", std::is_same_v<T, NeoHookean<double>> ? LawKind::neo_hookean : LawKind::linear_elastic, 2.5e9,
            0.33, 1200};
  }
};
/// AnyElastic, once for each law that it can stand for.
struct AnyLinear : LawCase<AnyElastic<double>> {};
struct AnyNeo : LawCase<AnyElastic<double>> {
  static Material material() {
    Material m = LawCase<Law>::material();
    m.law = LawKind::neo_hookean;
    return m;
  }
};

template <class Case>
class Laws : public testing::Test {
 public:
  using Law = typename Case::Law;
  const Material material = Case::material();
  const double E = material.E / material.density;  ///< m^2/s^2, as the stresses
  const bool hyperelastic = material.law == LawKind::neo_hookean;
  Law law(Plane plane) const { return Law(material, plane); }
};
using Cases = testing::Types<LawCase<LinearElastic<double>>, LawCase<NeoHookean<double>>, AnyLinear, AnyNeo>;
TYPED_TEST_SUITE(Laws, Cases);

using State = LawState<double>;

State fresh() {
  return {{1, 0, 0, 1}, 1, 0, 0, 0};
}
Mat2<double> rotation(double angle) {
  return {std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle)};
}
Mat2<double> minus_identity(const Mat2<double>& F) {
  return {F.xx - 1, F.xy, F.yx, F.yy - 1};
}
double largest(const State& p) {
  return std::max({std::abs(p.xx), std::abs(p.yy), std::abs(p.xy)});
}
template <class Law>
State after(const Law& law, State p, const Mat2<double>& G) {
  law.update(G, p);
  return p;
}
template <class Law>
State stretched(const Law& law) {
  return after(law, fresh(), Mat2<double>{0.08, 0.05, -0.02, -0.05});
}

constexpr int steps = 1000;
constexpr double turn = 2 * std::numbers::pi / steps;

TYPED_TEST(Laws, OneTurnLeavesNoStress) {
  for (const Plane plane : planes) {
    const auto law = this->law(plane);
    const Mat2<double> exact = minus_identity(rotation(turn));
    const Mat2<double> from_rate = exp_minus_identity(Mat2<double>{0, -turn, turn, 0});
    for (const Mat2<double>& G : {exact, from_rate}) {
      State p = fresh();
      double most = 0;
      for (int n = 0; n < steps; ++n) {
        law.update(G, p);
        most = std::max(most, largest(p));
      }
      EXPECT_LT(most, 1e-10 * this->E);
      EXPECT_NEAR(p.J, 1, 1e-11);
    }
  }
}

/// exp(A (I + A)^-1) by the inverse and the product.
TEST(ExpOfMiddle, IsThatOfTheProduct) {
  for (const Mat2<double>& A :
       {Mat2<double>{0.04, 0.03, -0.01, -0.02}, Mat2<double>{0, -0.2, 0.2, 0}, Mat2<double>{-3e-9, 5e-9, 1e-9, 2e-9}}) {
    const Mat2<double> one = exp_of_middle_minus_identity(A), other = exp_minus_identity(A * inverse_of_one_plus(A));
    const double rounding = 1e-15 * std::sqrt(A.xx * A.xx + A.xy * A.xy + A.yx * A.yx + A.yy * A.yy);
    EXPECT_NEAR(one.xx, other.xx, rounding);
    EXPECT_NEAR(one.xy, other.xy, rounding);
    EXPECT_NEAR(one.yx, other.yx, rounding);
    EXPECT_NEAR(one.yy, other.yy, rounding);
  }
}

/// A strain increment far below the last bit of 1, along and across a shear, and with a spin of twenty
/// times its size.
TEST(LinearElasticLaw, KeepsAllDigitsOfSmallIncrements) {
  const Material material = LawCase<LinearElastic<double>>::material();
  const LinearElastic<double> law(material, Plane::strain);
  const double e = 3e-19, g = 5e-19, spin = 1e-17;
  const State p = after(law, fresh(), Mat2<double>{e, g - spin, g + spin, 2 * e});
  EXPECT_NEAR(p.xx, (3 * law.lambda + 2 * law.mu) * e, 1e-14 * law.mu * e);
  EXPECT_NEAR(p.yy, (3 * law.lambda + 4 * law.mu) * e, 1e-14 * law.mu * e);
  EXPECT_NEAR(p.xy, 2 * law.mu * g, 1e-14 * law.mu * g);
}

/// A strain to and fro 1,000 times, with a spin; increments of the first order would creep by their square each time.
TYPED_TEST(Laws, StrainToAndFroLeavesNoStress) {
  const Mat2<double> A{0.004, 0.003, -0.001, -0.002};
  for (const Plane plane : planes) {
    const auto law = this->law(plane);
    State p = fresh();
    for (int n = 0; n < 1000; ++n) {
      law.update(exp_minus_identity(A), p);
      law.update(exp_minus_identity(-1. * A), p);
    }
    EXPECT_LT(largest(p), 1e-6 * this->E);
  }
}

/// tau(R F) = R tau(F) R^T at every step of a turn.
TYPED_TEST(Laws, StressTurnsWithTheBody) {
  for (const Plane plane : planes) {
    const auto law = this->law(plane);
    const State first = stretched(law);
    State p = first;
    ASSERT_GT(largest(first), 0.01 * this->E);
    for (int n = 1; n <= steps; ++n) {
      law.update(exp_minus_identity(Mat2<double>{0, -turn, turn, 0}), p);
      const Mat2<double> R = rotation(n * turn), T{first.xx, first.xy, first.xy, first.yy};
      const Mat2<double> turned = R * T * Mat2<double>{R.xx, R.yx, R.xy, R.yy};
      ASSERT_NEAR(p.xx, turned.xx, 1e-10 * this->E);
      ASSERT_NEAR(p.yy, turned.yy, 1e-10 * this->E);
      ASSERT_NEAR(p.xy, turned.xy, 1e-10 * this->E);
    }
    EXPECT_NEAR(law.energy(p), law.energy(first), 1e-10 * law.energy(first));
  }
}

/// dW = tau : D dt / rho0, along every direction of D, with and without spin.
TYPED_TEST(Laws, StressIsTheDerivativeOfEnergy) {
  const double d = 1e-4;
  for (const Plane plane : planes) {
    const auto law = this->law(plane);
    const State p = stretched(law);
    for (const Mat2<double>& A :
         {Mat2<double>{1, 0, 0, 0}, {0, 0, 0, 1}, {0, 1, 0, 0}, {0, 0, 1, 0}, {1, -2, 2, 0.5}}) {
      const auto energy = [&](double s) {
        return law.energy(after(law, p, exp_minus_identity(Mat2<double>{s * A.xx, s * A.xy, s * A.yx, s * A.yy})));
      };
      const double slope = (8 * (energy(d) - energy(-d)) - (energy(2 * d) - energy(-2 * d))) / (12 * d);
      EXPECT_NEAR(slope, p.xx * A.xx + p.yy * A.yy + p.xy * (A.xy + A.yx), 1e-9 * this->E);
    }
  }
}

/// Hooke's law for small strains: E, nu and the plane give the stress.
TYPED_TEST(Laws, SmallStrainsGiveHookesLaw) {
  const double e = 1e-5, E = this->E, nu = this->material.nu;
  for (const Plane plane : planes) {
    const auto law = this->law(plane);
    const State pulled = after(law, fresh(), Mat2<double>{e, 0, 0, 0});
    const State sheared = after(law, fresh(), Mat2<double>{0, e, 0, 0});
    const bool stress = plane == Plane::stress;
    const double stiff = stress ? E / (1 - nu * nu) : E * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
    const double across = stress ? nu * stiff : nu / (1 - nu) * stiff;
    EXPECT_NEAR(pulled.xx, stiff * e, 1e-4 * E * e);
    EXPECT_NEAR(pulled.yy, across * e, 1e-4 * E * e);
    EXPECT_NEAR(sheared.xy, E / (2 * (1 + nu)) * e, 1e-4 * E * e);
    EXPECT_NEAR(law.stress_zz(pulled), stress ? 0 : nu * (pulled.xx + pulled.yy), 1e-4 * E * e);
    EXPECT_NEAR(law.thickness_ratio(pulled.J), stress ? 1 - nu / (1 - nu) * e : 1, 1e-4 * e);
    EXPECT_NEAR(law.energy(pulled), 0.5 * stiff * e * e, 1e-4 * E * e * e);
  }
}

/// Longitudinal waves of a plate without stress: c^2 rho = E / (1 - nu^2) in plane stress (at least),
/// E (1 - nu) / ((1 + nu) (1 - 2 nu)) in plane strain.
TYPED_TEST(Laws, WaveSpeedOfTheStressFreeSolid) {
  const double nu = this->material.nu;
  EXPECT_NEAR(this->law(Plane::strain).wave_speed(fresh()), std::sqrt(this->E * (1 - nu) / ((1 + nu) * (1 - 2 * nu))),
              1e-12 * std::sqrt(this->E));
  EXPECT_GE(this->law(Plane::stress).wave_speed(fresh()), std::sqrt(this->E / (1 - nu * nu)) * (1 - 1e-12));
}

/// Simo and Pister's energy of the whole, three-dimensional solid.
double solid_energy(const Elasticity& e, const Mat2<double>& F, double F33) {
  const double J = det(F) * F33;
  const double trace = F.xx * F.xx + F.xy * F.xy + F.yx * F.yx + F.yy * F.yy + F33 * F33;
  return 0.5 * e.mu * (trace - 3) - e.mu * std::log(J) + 0.25 * e.lambda * (J * J - 1) - 0.5 * e.lambda * std::log(J);
}

std::vector<Mat2<double>> deformations() {
  return {{1.5, 0.2, -0.1, 0.9}, {0.6, 0, 0, 0.7}, {1.1, 0.6, -0.4, 1.3}, {0.4, 0.1, 0.3, 2.2}};
}

/// In plane stress the thickness is the one of least energy; there tau_zz = F33 dW/dF33 = 0.
TEST(NeoHookeanLaw, PlaneStressIsTheFreeThickness) {
  const Material m = LawCase<NeoHookean<double>>::material();
  const Elasticity e = elasticity(m);
  const NeoHookean<double> stress(m, Plane::stress), strain(m, Plane::strain);
  for (const Mat2<double>& F : deformations()) {
    const State p = after(stress, fresh(), minus_identity(F));
    const double t = stress.thickness_ratio(p.J), d = 1e-5;
    EXPECT_NEAR(stress.energy(p), solid_energy(e, F, t), 1e-13 * e.mu);
    EXPECT_NEAR((solid_energy(e, F, t + d) - solid_energy(e, F, t - d)) / (2 * d), 0, 1e-8 * e.mu);
    EXPECT_LT(std::abs(stress.stress_zz(p)), 1e-13 * e.mu);
    const State q = after(strain, fresh(), minus_identity(F));
    EXPECT_NEAR(strain.energy(q), solid_energy(e, F, 1), 1e-13 * e.mu);
    EXPECT_NEAR(strain.stress_zz(q), (solid_energy(e, F, 1 + d) - solid_energy(e, F, 1 - d)) / (2 * d), 1e-8 * e.mu);
  }
}

/// Hooke's law in three dimensions for the logarithmic strains of a plate with free faces, stretched along its axes.
TEST(LinearElasticLaw, PlaneStressIsTheFreeThickness) {
  const Material m = LawCase<LinearElastic<double>>::material();
  const Elasticity e = elasticity(m);
  const LinearElastic<double> law(m, Plane::stress);
  State p = fresh();
  const double ex = 0.1, ey = -0.03;
  const int parts = 200;
  for (int n = 0; n < parts; ++n)
    law.update({std::expm1(ex / parts), 0, 0, std::expm1(ey / parts)}, p);
  const double ez = std::log(law.thickness_ratio(p.J)), volume = e.lambda * (ex + ey + ez);
  EXPECT_NEAR(volume + 2 * e.mu * ez, 0, 1e-10 * e.mu);
  EXPECT_EQ(law.stress_zz(p), 0);
  EXPECT_NEAR(p.xx, volume + 2 * e.mu * ex, 1e-6 * e.mu);  // increments are of second order in their size
  EXPECT_NEAR(p.yy, volume + 2 * e.mu * ey, 1e-6 * e.mu);
}

/// Squared speeds of plane waves along n: roots of Q a = (d tau n) - (a . n) tau n, d tau the change of the Kirchhoff
/// stress as F goes to (I + a (x) n) F (the first Piola-Kirchhoff stress on the present configuration).
double fastest_wave(const NeoHookean<double>& law, const Mat2<double>& F, double angle) {
  const double n[2] = {std::cos(angle), std::sin(angle)}, d = 1e-5;
  const State p = after(law, fresh(), minus_identity(F));
  Mat2<double> Q{};
  for (int c = 0; c < 2; ++c) {
    const double a[2] = {c == 0 ? 1. : 0., c == 1 ? 1. : 0.};
    const auto changed = [&](double s) {
      const Mat2<double> dF{1 + s * a[0] * n[0], s * a[0] * n[1], s * a[1] * n[0], 1 + s * a[1] * n[1]};
      return after(law, fresh(), minus_identity(dF * F));
    };
    const State above = changed(d), below = changed(-d);
    const double xx = (above.xx - below.xx) / (2 * d) - n[c] * p.xx, yy = (above.yy - below.yy) / (2 * d) - n[c] * p.yy;
    const double xy = (above.xy - below.xy) / (2 * d) - n[c] * p.xy;
    (c == 0 ? Q.xx : Q.xy) = xx * n[0] + xy * n[1];
    (c == 0 ? Q.yx : Q.yy) = xy * n[0] + yy * n[1];
  }
  return std::sqrt(0.5 * (Q.xx + Q.yy) + std::sqrt(0.25 * (Q.xx - Q.yy) * (Q.xx - Q.yy) + Q.xy * Q.yx));
}

TEST(NeoHookeanLaw, NoWaveIsFasterThanItsWaveSpeed) {
  const Material m = LawCase<NeoHookean<double>>::material();
  for (const Plane plane : planes) {
    const NeoHookean<double> law(m, plane);
    for (const Mat2<double>& F : deformations()) {
      const double bound = law.wave_speed(after(law, fresh(), minus_identity(F)));
      double most = 0;
      for (int k = 0; k < 90; ++k)
        most = std::max(most, fastest_wave(law, F, k * std::numbers::pi / 90));
      EXPECT_LT(most, bound * (1 + 1e-6));
      EXPECT_GT(most, 0.6 * bound) << "so loose a bound wastes time steps";
    }
  }
}

}  // namespace
}  // namespace riven
