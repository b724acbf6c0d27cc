// Criterion and direction of growth against brute force, and the Rayleigh speed against published roots.
#include "core/fracture/growth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace riven {
namespace {

constexpr double pi = std::numbers::pi;

double hoop(double K_I, double K_II, double angle) {
  const double c = std::cos(angle / 2);
  return c * (K_I * c * c - 1.5 * K_II * std::sin(angle));
}

TEST(Growth, TurnsToTheGreatestHoopStress) {
  for (int i = 0; i < 72; ++i) {
    const double K_I = std::cos(i * pi / 36), K_II = std::sin(i * pi / 36);
    double most = -1e9, at = 0;
    constexpr int n = 20000;
    for (int k = -n; k <= n; ++k)
      if (const double K = hoop(K_I, K_II, pi * k / n); K > most) {
        most = K;
        at = pi * k / n;
      }
    const HoopStress found = greatest_hoop_stress(K_I, K_II);
    EXPECT_NEAR(found.K, most, 1e-7) << i;
    if (K_I > -0.9999) {  // else shut and without shear: nothing pulls anywhere, least of all backwards
      EXPECT_NEAR(found.angle, at, 2 * pi / n) << i;
    }
    EXPECT_NEAR(hoop(K_I, K_II, found.angle), found.K, 1e-12) << i;
  }
}

/// The formulas as printed, for K_I >= 0, with the angle counted counter-clockwise.
TEST(Growth, IsThePapersAngleForOpenCracks) {
  for (const double R : {-30., -2., -0.3, -1e-6, 0., 1e-6, 0.3, 2., 30.}) {
    const double cosine = (3 * R * R + std::sqrt(1 + 8 * R * R)) / (1 + 9 * R * R), sine = -R * (3 * cosine - 1);
    const HoopStress found = greatest_hoop_stress(1, R);
    EXPECT_NEAR(std::cos(found.angle), cosine, 1e-12) << R;
    EXPECT_NEAR(std::sin(found.angle), sine, 1e-12) << R;
  }
  EXPECT_NEAR(greatest_hoop_stress(0, 1).angle, -std::acos(1. / 3), 1e-12);  // 70.53 degrees
  EXPECT_NEAR(greatest_hoop_stress(0, -1).angle, std::acos(1. / 3), 1e-12);
  EXPECT_NEAR(greatest_hoop_stress(-1e-12, 1).angle, -std::acos(1. / 3), 1e-10);  // no jump where K_I changes sign
}

GrowthRule rule(GrowthCriterion criterion, double toughness, GrowthDirection direction) {
  GrowthRule r;
  r.criterion = criterion;
  r.toughness = toughness;
  r.direction = direction;
  r.heading = {0, 3};
  return r;
}

Tip tip_with(double K_I, double K_II, double J) {
  Tip t;
  t.drive_I = K_I;
  t.drive_II = K_II;
  t.release = J;
  return t;
}

TEST(Growth, StartsAtTheToughness) {
  const auto by_K = rule(GrowthCriterion::k_max, 2, GrowthDirection::hoop);
  EXPECT_LT(growth_load(by_K, tip_with(1.999, 0, 0)), 1);
  EXPECT_GE(growth_load(by_K, tip_with(2, 0, 0)), 1);
  EXPECT_LT(growth_load(by_K, tip_with(-9, 0, 0)), 1);    // shut
  EXPECT_GE(growth_load(by_K, tip_with(0, 1.74, 0)), 1);  // 2 / 1.1547 = 1.732 in pure shear
  EXPECT_LT(growth_load(by_K, tip_with(0, 1.72, 0)), 1);
  EXPECT_LT(growth_load(by_K, tip_with(NAN, 0, 5)), 1);
  const auto by_J = rule(GrowthCriterion::critical_j, 5, GrowthDirection::self_similar);
  EXPECT_LT(growth_load(by_J, tip_with(1, 0, 4.999)), 1);
  EXPECT_GE(growth_load(by_J, tip_with(1, 0, 5)), 1);
  EXPECT_LT(growth_load(by_J, tip_with(-1, 0, 50)), 1);
  EXPECT_LT(growth_load(by_J, tip_with(-1, 1, 9)), 1);  // half of it is shear
  EXPECT_GE(growth_load(by_J, tip_with(-1, 1, 11)), 1);
}

TEST(Growth, GoesTheWayThatIsAskedFor) {
  const Tip tip = tip_with(1, 0.5, 9);
  const double angle = greatest_hoop_stress(1, 0.5).angle;
  EXPECT_LT(angle, 0);  // clockwise, seen along the direction of growth, at either end
  for (const Vec2 ahead : {Vec2{1, 0}, Vec2{-1, 0}, Vec2{0.6, 0.8}}) {
    const Vec2 hoop = growth_direction(rule(GrowthCriterion::k_max, 0.1, GrowthDirection::hoop), tip, ahead);
    EXPECT_NEAR(std::atan2(cross(ahead, hoop), dot(ahead, hoop)), angle, 1e-12);
    EXPECT_NEAR(norm(hoop), 1, 1e-12);
    EXPECT_EQ(growth_direction(rule(GrowthCriterion::k_max, 0.1, GrowthDirection::self_similar), tip, ahead), ahead);
  }
  const auto fixed = rule(GrowthCriterion::k_max, 0.1, GrowthDirection::fixed);
  EXPECT_EQ(growth_direction(fixed, tip, {0.6, 0.8}), (Vec2{0, 1}));
  EXPECT_EQ(growth_direction(fixed, tip, {0.6, -0.8}), (Vec2{0, -1}));
}

/// c_R / c_s = 0.9194 for nu = 1/4: c_R^2 = (2 - 2/sqrt 3) c_s^2 (Rayleigh, Proc. London Math. Soc. 17 (1885) 4-11);
/// 0.8740 for nu = 0 and 0.9553 as nu goes to 1/2 (Viktorov, Rayleigh and Lamb Waves, 1967).
TEST(Growth, KnowsTheRayleighSpeed) {
  const auto over_shear = [](double nu, Plane plane) {
    Material m;
    m.E = 2 * (1 + nu) * 7;
    m.nu = nu;
    m.density = 7;
    return rayleigh_speed(m, plane);
  };
  EXPECT_NEAR(over_shear(0.25, Plane::strain), std::sqrt(2 - 2 / std::sqrt(3)), 1e-12);
  EXPECT_NEAR(over_shear(0, Plane::strain), 0.8740, 5e-5);
  EXPECT_NEAR(over_shear(0.5 - 1e-9, Plane::strain), 0.9553, 5e-5);
  // plane stress is plane strain with nu / (1 + nu), at the same shear modulus
  EXPECT_NEAR(over_shear(1. / 3, Plane::stress), over_shear(0.25, Plane::strain), 1e-12);
}

TEST(Growth, ChecksATipOncePerParticleAtTheSpeedLimit) {
  EXPECT_EQ(check_interval(1, 0.1, 1), 10);
  EXPECT_EQ(check_interval(1, 0.3, 1), 3);
  EXPECT_EQ(check_interval(1, 1, 1), 1);
  EXPECT_EQ(check_interval(1, 50, 1), 1);
  EXPECT_EQ(check_interval(0.3, 0.1, 1), 3);  // but for rounding
  Tip tip;
  tip.due = 7;
  EXPECT_FALSE(growth_due(tip, 7));
  tip.grows = true;
  EXPECT_TRUE(growth_due(tip, 7));
  EXPECT_FALSE(growth_due(tip, 6));
  tip.open = false;
  EXPECT_FALSE(growth_due(tip, 7));
}

TEST(Growth, SaysHowNearATipIsToIt) {
  Tip tip;
  tip.drive_I = 3;
  tip.release = 25;
  EXPECT_DOUBLE_EQ(growth_load(rule(GrowthCriterion::k_max, 6, GrowthDirection::hoop), tip), 0.5);
  EXPECT_DOUBLE_EQ(growth_load(rule(GrowthCriterion::critical_j, 100, GrowthDirection::hoop), tip), 0.5);
  tip.release = 0;
  tip.drive_I = 0;
  for (const GrowthCriterion c : {GrowthCriterion::k_max, GrowthCriterion::critical_j})
    EXPECT_EQ(growth_load(rule(c, 6, GrowthDirection::hoop), tip), 0);
}

TEST(Growth, LeavesTipsAtRestAloneForHalfTheWayToIt) {
  EXPECT_EQ(steps_at_rest(0.5, 0, 6), 6);
  EXPECT_EQ(steps_at_rest(0.5, -1, 6), 6);
  EXPECT_EQ(steps_at_rest(0.5, 0.01, 6), 6);
  EXPECT_EQ(steps_at_rest(0.9, 0.0099, 6), 5);
  EXPECT_EQ(steps_at_rest(0.9, 0.02, 6), 2);
  EXPECT_EQ(steps_at_rest(0.9, 0.2, 6), 1);
  EXPECT_EQ(steps_at_rest(0.95, 0, 8), 4);
  EXPECT_EQ(steps_at_rest(0.99, 0, 8), 1);
  EXPECT_EQ(steps_at_rest(0.5, 0, 0), 1);
  for (const double rise : {-1., 0., 1.})
    EXPECT_EQ(steps_at_rest(1.2, rise, 6), 1);
}

}  // namespace
}  // namespace riven
