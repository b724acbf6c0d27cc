// Stress intensity factors from J and the opening, and the fields around a tip at rest.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/fracture/auxiliary_fields.hpp"

namespace riven {
namespace {

Material steel() {
  return {"steel", LawKind::linear_elastic, 200e9, 0.3, 5000};
}

TEST(StressIntensity, SpeedsAreThoseOfThePaper) {
  const PlaneElasticity s(steel(), Plane::strain);  // Guo and Nairn, section 4.2: c_d = 7.338, c_s = 3.922 km/s
  EXPECT_NEAR(s.dilatational_speed, 7338, 0.5);
  EXPECT_NEAR(s.shear_speed, 3922.3, 0.5);
}

TEST(StressIntensity, AtRestIsRootOfJTimesTheModulus) {
  for (const Plane plane : {Plane::strain, Plane::stress}) {
    const PlaneElasticity s(steel(), plane);
    const StressIntensity K = share_out(s, 100, 0, {3e-6, -4e-6});
    EXPECT_NEAR(K.I, 0.6 * std::sqrt(100 * s.E), 1e-6 * K.I);
    EXPECT_NEAR(K.II, -0.8 * std::sqrt(100 * s.E), 1e-6 * K.I);
  }
}

// Freund 1990, eqs. 5.3.9-11: J of a running tip, from its intensities, and the openings that go with them.
TEST(StressIntensity, OfARunningTipGiveBackItsJAndItsOpening) {
  const PlaneElasticity s(steel(), Plane::strain);
  for (double share : {0.01, 0.3, 0.6, 0.85}) {
    const double c = share * s.shear_speed;
    const double a = std::sqrt(1 - std::pow(c / s.dilatational_speed, 2)), b = std::sqrt(1 - share * share);
    const double D = 4 * a * b - std::pow(1 + b * b, 2), A_I = a * share * share / D, A_II = b * share * share / D;
    const StressIntensity K = share_out(s, 50, c, {2e-6, 1e-6});
    EXPECT_NEAR((A_I * K.I * K.I + A_II * K.II * K.II) / (2 * s.mu), 50, 1e-6);
    EXPECT_NEAR(A_II * K.II / (A_I * K.I), 0.5, 1e-9);
  }
}

TEST(StressIntensity, TendsToItsValueAtRest) {
  const PlaneElasticity s(steel(), Plane::strain);
  const StressIntensity slow = share_out(s, 50, 1.1e-3 * s.shear_speed, {2e-6, 1e-6}),
                        rest = share_out(s, 50, 0, {2e-6, 1e-6});
  EXPECT_NEAR(slow.I, rest.I, 1e-5 * rest.I);
  EXPECT_NEAR(slow.II, rest.II, 1e-5 * rest.I);
}

TEST(StressIntensity, FacesThatOverlapHaveNegativeModeOne) {
  const PlaneElasticity s(steel(), Plane::strain);
  EXPECT_LT(share_out(s, 50, 0, {-1e-6, 0}).I, 0);
  EXPECT_EQ(share_out(s, -1, 0, {1e-6, 0}).I, 0);
}

/// Displacement under K = 1 from its textbook form (Williams 1957).
Vec2 displacement(const PlaneElasticity& s, Vec2 r, int mode) {
  const double R = norm(r), t = std::atan2(r.y, r.x), c = std::cos(t / 2), n = std::sin(t / 2), k = s.kappa;
  const double scale = std::sqrt(R / (2 * std::numbers::pi)) / (2 * s.mu);
  if (mode == 1)
    return scale * Vec2{c * (k - 1 + 2 * n * n), n * (k + 1 - 2 * c * c)};
  return scale * Vec2{n * (k + 1 + 2 * c * c), -c * (k - 1 - 2 * n * n)};
}

TEST(AuxiliaryField, IsWilliamsDisplacementAndItsHookeanStress) {
  for (const Plane plane : {Plane::strain, Plane::stress})
    for (int mode : {1, 2})
      for (double angle = -3.1; angle < 3.15; angle += 0.31) {
        const PlaneElasticity s(steel(), plane);
        const Vec2 r = 1e-3 * Vec2{std::cos(angle), std::sin(angle)};
        const double e = 1e-9;
        const AuxiliaryField f = auxiliary_fields(s, RunningTip(s, 0), r).mode[mode - 1];
        const Vec2 dx = (displacement(s, r + Vec2{e, 0}, mode) - displacement(s, r - Vec2{e, 0}, mode)) * (0.5 / e);
        const Vec2 dy = (displacement(s, r + Vec2{0, e}, mode) - displacement(s, r - Vec2{0, e}, mode)) * (0.5 / e);
        const double size = 1 / std::sqrt(2 * std::numbers::pi * 1e-3) / s.mu;
        EXPECT_NEAR(f.dux_dx, dx.x, 1e-5 * size);
        EXPECT_NEAR(f.duy_dx, dx.y, 1e-5 * size);
        EXPECT_NEAR(f.exx, dx.x, 1e-5 * size);
        EXPECT_NEAR(f.eyy, dy.y, 1e-5 * size);
        EXPECT_NEAR(f.exy, 0.5 * (dx.y + dy.x), 1e-5 * size);
        const double lambda = plane == Plane::strain ? s.mu * 2 * 0.3 / 0.4 : s.mu * 2 * 0.3 / 0.7;
        EXPECT_NEAR(f.sxx, 2 * s.mu * f.exx + lambda * (f.exx + f.eyy), 1e-9 * size * s.mu);
        EXPECT_NEAR(f.syy, 2 * s.mu * f.eyy + lambda * (f.exx + f.eyy), 1e-9 * size * s.mu);
      }
}

// J of the field itself over a circle is A / 2 mu, at rest and at any speed: a steadily running field makes the dynamic
// contour integral independent of the contour.
TEST(AuxiliaryField, ContourIntegralIsTheEnergyReleaseRate) {
  for (const Plane plane : {Plane::strain, Plane::stress})
    for (const double share : {0.0, 0.1, 0.4, 0.7, 0.85})
      for (int mode : {1, 2}) {
        const PlaneElasticity s(steel(), plane);
        const RunningTip tip(s, share * s.shear_speed);
        double J = 0;
        constexpr int n = 4000;
        for (int i = 0; i < n; ++i) {
          const double angle = std::numbers::pi * (2 * (i + 0.5) / n - 1);
          const Vec2 normal{std::cos(angle), std::sin(angle)};
          const AuxiliaryField f = auxiliary_fields(s, tip, 0.01 * normal).mode[mode - 1];
          const double rate2 = tip.speed * tip.speed * (f.dux_dx * f.dux_dx + f.duy_dx * f.duy_dx);
          const double W = 0.5 * (f.sxx * f.exx + f.syy * f.eyy + 2 * f.sxy * f.exy) + 0.5 * steel().density * rate2;
          const Vec2 T{f.sxx * normal.x + f.sxy * normal.y, f.sxy * normal.x + f.syy * normal.y};
          J += (W * normal.x - T.x * f.dux_dx - T.y * f.duy_dx) * 0.01 * 2 * std::numbers::pi / n;
        }
        EXPECT_NEAR(2 * s.mu * J / (mode == 1 ? tip.A_I : tip.A_II), 1, 1e-5) << share << " mode " << mode;
      }
}

TEST(AuxiliaryField, OfASlowTipIsThatOfATipAtRest) {
  const PlaneElasticity s(steel(), Plane::strain);
  const RunningTip slow(s, 0.051 * s.shear_speed), rest(s, 0);
  for (double angle = -3.1; angle < 3.15; angle += 0.31)
    for (int mode : {0, 1}) {
      const Vec2 r = 1e-3 * Vec2{std::cos(angle), std::sin(angle)};
      const AuxiliaryField a = auxiliary_fields(s, slow, r).mode[mode], b = auxiliary_fields(s, rest, r).mode[mode];
      const double size = 1 / std::sqrt(2 * std::numbers::pi * 1e-3);
      for (const auto member : {&AuxiliaryField::sxx, &AuxiliaryField::syy, &AuxiliaryField::sxy})
        EXPECT_NEAR(a.*member, b.*member, 0.005 * size) << angle;
      for (const auto member : {&AuxiliaryField::dux_dx, &AuxiliaryField::duy_dx})
        EXPECT_NEAR(a.*member, b.*member, 0.005 * size / s.mu) << angle;
    }
}

}  // namespace
}  // namespace riven
