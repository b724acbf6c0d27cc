// The J integral of fields that are known everywhere, laid on particles: no step is made, so that what is off is the
// integral's own.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/fracture/place_domain.hpp"
#include "core/fracture/stress_intensity.hpp"
#include "kernels/crack_step.hpp"
#include "kernels/j_integral.hpp"
#include "tests/physics/scenes.hpp"

namespace riven {
namespace {

using test::body;
using test::crack;
using test::empty_scene;

/// A square of 24 cells of 1 m with the given cracks; J asked for.
Scene square(Plane plane, std::vector<CrackLine> cracks, ShapeFunction shape = ShapeFunction::ugimp) {
  Scene s = empty_scene(1, {{-15, -15}, {15, 15}});
  s.plane = plane;
  s.shape = shape;
  s.bodies = {body("square", Rectangle{{-12, -12}, {12, 12}})};
  s.cracks = std::move(cracks);
  s.fracture.asked = true;
  return s;
}

/// Displacement gradient and stress at a place.
struct Field {
  Mat2<double> H;
  double sxx, syy, sxy;
};

/// Lays a field on the particles of a body that turned by `turn` (cosine and sine) before, and finds their crack
/// fields.
template <class F>
void lay(Simulation& m, const F& field, Vec2 turn = {1, 0}) {
  auto& p = m.state.particles;
  const double density = m.scene.materials[0].density;
  for (long i = 0; i < p.count(); ++i) {
    const Field f = field(Vec2{p.x[0][i], p.x[1][i]});
    const Mat2<double> R{turn.x, -turn.y, turn.y, turn.x}, all = R + f.H * R;
    p.F[0][i] = all.xx;
    p.F[1][i] = all.xy;
    p.F[2][i] = all.yx;
    p.F[3][i] = all.yy;
    p.stress[0][i] = f.sxx / density;
    p.stress[1][i] = f.syy / density;
    p.stress[2][i] = f.sxy / density;
  }
  hash_if_due(m);
  find_fields(m);
}

/// Fields of K_I and K_II at a tip whose crack comes from behind its heading, with strains of some 1e-6.
Field near_tip(const PlaneElasticity& solid, Vec2 r, Vec2 t, double K_I, double K_II) {
  const Vec2 n = turned(t), local{dot(r, t), dot(r, n)};
  double s[3] = {}, H[4] = {};
  for (int mode = 1; mode <= 2; ++mode) {
    const double K = mode == 1 ? K_I : K_II;
    const AuxiliaryField a = auxiliary_fields(solid, RunningTip(solid, 0), local).mode[mode - 1];
    s[0] += K * a.sxx;
    s[1] += K * a.syy;
    s[2] += K * a.sxy;
    H[0] += K * a.dux_dx;
    H[1] += K * (2 * a.exy - a.duy_dx);
    H[2] += K * a.duy_dx;
    H[3] += K * a.eyy;
  }
  // R A R^T with R = [t n]
  const Mat2<double> R{t.x, n.x, t.y, n.y};
  const Mat2<double> turned_H = R * Mat2<double>{H[0], H[1], H[2], H[3]} * transposed(R);
  const Mat2<double> S = R * Mat2<double>{s[0], s[2], s[2], s[1]} * transposed(R);
  return {turned_H, S.xx, S.yy, S.xy};
}

TipSums sums_at(Simulation& m, Vec2 tip, Vec2 heading, double contour, bool faces = true, Vec2 turn = {1, 0}) {
  const PlaneElasticity solid(m.scene.materials[0], m.scene.plane);
  const double half = contour / 2, reach[4] = {half, half, half, half};
  TipTask task;
  task.domain = plain_domain(tip, reach, m.scene.cell);
  task.heading = heading;
  task.turn = turn;
  task.other_faces = faces;
  task.solid = &solid;
  task.interaction = true;
  std::vector<TipTask> tasks{task};
  sum_around_tips(m.space, m.plan, m.state, tasks);
  return tasks[0].sums;
}

TEST(JOfKnownFields, IsKSquaredOverTheModulusForAnyTipAndContour) {
  const exec::Space space(exec::Kind::serial, 1);
  const double K_I = 3, K_II = -2;
  for (const Plane plane : {Plane::strain, Plane::stress})
    for (const double angle : {0.0, 30.0, 101.0, 180.0})
      for (const Vec2 tip : {Vec2{0, 0}, Vec2{0.25, -0.5}, Vec2{-0.38, 0.21}}) {
        const Vec2 t{std::cos(angle * std::numbers::pi / 180), std::sin(angle * std::numbers::pi / 180)};
        const Scene scene = square(plane, {crack("target", {tip - 30 * t, tip})});
        Simulation m(scene, space);
        const PlaneElasticity solid(scene.materials[0], plane);
        lay(m, [&](Vec2 x) { return near_tip(solid, x - tip, t, K_I, K_II); });
        const double J = (K_I * K_I + K_II * K_II) / solid.E;
        for (const double contour : {4.0, 8.0, 16.0}) {
          const TipSums s = sums_at(m, tip, t, contour);
          SCOPED_TRACE(testing::Message()
                       << "angle " << angle << " tip " << tip.x << " " << tip.y << " contour " << contour);
          // what the midpoints of particles miss of fields that vary as 1/r falls as their spacing over r, squared
          const double part = contour == 4 ? 0.015 : 0.004;
          EXPECT_NEAR(dot(s.J, t), J, part * J);
          EXPECT_NEAR(0.5 * solid.E * s.interaction[0], K_I, part * K_I);
          EXPECT_NEAR(0.5 * solid.E * s.interaction[1], K_II, part * K_I);
          EXPECT_FALSE(s.crossed);
          for (const double filled : s.filled)
            EXPECT_NEAR(filled, 1, 1e-5);  // areas vary by the strains
        }
      }
}

// Strains of 1e-6 in a body that has turned by 50 degrees: what particles miss of the balance of forces must not count
// a million times.
TEST(JOfKnownFields, IsTheSameInABodyThatHasTurned) {
  const exec::Space space(exec::Kind::serial, 1);
  const double K_I = 3, K_II = -2, angle = 50 * std::numbers::pi / 180;
  const Vec2 turn{std::cos(angle), std::sin(angle)};
  for (const Vec2 tip : {Vec2{0, 0}, Vec2{-0.38, 0.21}}) {
    const Vec2 laid{1, 0}, t = turn;
    const Scene scene = square(Plane::stress, {crack("target", {tip - 30 * t, tip})});
    Simulation m(scene, space);
    const PlaneElasticity solid(scene.materials[0], Plane::stress);
    lay(
        m, [&](Vec2 x) { return near_tip(solid, x - tip, t, K_I, K_II); }, turn);
    const double J = (K_I * K_I + K_II * K_II) / solid.E;
    for (const double contour : {4.0, 8.0, 16.0}) {
      const TipSums s = sums_at(m, tip, t, contour, true, turn);
      const double part = contour == 4 ? 0.015 : 0.004;
      EXPECT_NEAR(dot(s.J, laid), J, part * J) << contour;
      EXPECT_NEAR(0.5 * solid.E * s.interaction[0], K_I, part * K_I) << contour;
      EXPECT_NEAR(0.5 * solid.E * s.interaction[1], K_II, part * K_I) << contour;
    }
  }
}

// A plate in two parts, the left without stress, the right in tension along the cut: nothing is released at a tip in
// the left part. What the contour alone makes of it is the strain energy of the right times the length of its cut
// (Nairn and Aimene, eq. 13).
TEST(JOfKnownFields, IsUntouchedByAPartBeyondAnotherCrack) {
  const exec::Space space(exec::Kind::serial, 1);
  for (const double cut : {0.7, 1.5, 2.2})
    for (const ShapeFunction shape : {ShapeFunction::linear, ShapeFunction::ugimp, ShapeFunction::bspline}) {
      const Scene scene = square(
          Plane::stress, {crack("target", {{-20, 0.1}, {0, 0.1}}), crack("cut", {{cut, -20}, {cut, 20}})}, shape);
      Simulation m(scene, space);
      const double stress = 1, E = scene.materials[0].E, nu = scene.materials[0].nu, strain = stress / E;
      lay(m, [&](Vec2 x) { return x.x < cut ? Field{} : Field{{-nu * strain, 0, 0, strain}, 0, stress, 0}; });
      const double W = 0.5 * stress * strain, contour = 8;
      const TipSums s = sums_at(m, {0, 0.1}, {1, 0}, contour), alone = sums_at(m, {0, 0.1}, {1, 0}, contour, false);
      EXPECT_TRUE(s.crossed);
      EXPECT_NEAR(alone.J.x, W * contour, 0.01 * W * contour) << cut;
      EXPECT_NEAR(s.J.x + s.faces.x, 0, 0.01 * W * contour) << cut;
      EXPECT_EQ(alone.faces.x, 0);
    }
}

// Where two faces of another crack press on each other the field goes on through it, and the crack might as well not
// be there.
TEST(JOfKnownFields, IsThatOfTheTipAloneAcrossAShutCrack) {
  const exec::Space space(exec::Kind::serial, 1);
  for (const double cut : {-2.3, 2.6, 3.5}) {
    const Scene scene =
        square(Plane::strain, {crack("target", {{-20, 0.1}, {0, 0.1}}), crack("cut", {{cut, -20}, {cut, 20}})});
    Simulation m(scene, space);
    const PlaneElasticity solid(scene.materials[0], scene.plane);
    lay(m, [&](Vec2 x) { return near_tip(solid, x - Vec2{0, 0.1}, {1, 0}, 1, 0.5); });
    const TipSums s = sums_at(m, {0, 0.1}, {1, 0}, 8);
    // what fits over a cell and a half make of fields that vary as 1/r: 1.5 % at 2.3 cells, 3 % at 1.7
    EXPECT_NEAR((s.J.x + s.faces.x) * solid.E, 1.25, 0.02 * 1.25) << cut;
  }
}

}  // namespace
}  // namespace riven
