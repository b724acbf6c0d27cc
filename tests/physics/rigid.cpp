// Rigid motion and conservation: a body that only moves feels nothing, and no momentum appears or goes.
#include <gtest/gtest.h>

#include "tests/physics/scenes.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace test;

constexpr StressUpdate updates[] = {StressUpdate::usl, StressUpdate::musl, StressUpdate::usf, StressUpdate::usavg};
constexpr ShapeFunction shapes[] = {ShapeFunction::linear, ShapeFunction::ugimp, ShapeFunction::bspline};

/// Two cracks through a block of 1 m x 0.75 m.
void cut(Scene& s, ContactLaw law) {
  s.contact = {law, 0.3, 0, 0};
  s.cracks = {crack("level", {{0.1, 0.38}, {0.9, 0.41}}), crack("upright", {{0.52, 0}, {0.47, 0.75}})};
}

/// A translation over about nine cells along x and four along y.
void translate(const Scene& scene) {
  const ChosenSpace space;
  Simulation m(scene, space);
  const Vec2 v = scene.bodies[0].velocity;
  auto& p = m.state.particles;
  std::vector<Vec2> start(static_cast<size_t>(p.count()));
  for (int i = 0; i < p.count(); ++i)
    start[static_cast<size_t>(p.id[i])] = {p.x[0][i], p.x[1][i]};
  while (m.state.clock.time * v.x < 9 * scene.cell)
    m.step();
  EXPECT_LT(largest_stress(m, 1000), 1e-10 * 1e6);
  double speed = 0, place = 0;
  for (int i = 0; i < p.count(); ++i) {
    speed = std::max(speed, norm(Vec2{p.v[0][i], p.v[1][i]} - v));
    place = std::max(place,
                     norm(Vec2{p.x[0][i], p.x[1][i]} - start[static_cast<size_t>(p.id[i])] - m.state.clock.time * v));
  }
  EXPECT_LT(speed, 1e-12 * norm(v));
  EXPECT_LT(place, 1e-12);
  m.take_stock();
  EXPECT_LT(m.state.ledger.momentum.error(), 1e-12);
}

Scene flying_block(LawKind law) {
  Scene s = empty_scene(1. / 8, {{-0.5, -0.5}, {3, 2}}, law);
  s.bodies = {body("block", Rectangle{{0, 0}, {1, 0.75}})};
  s.bodies[0].velocity = {9, 4};
  return s;
}

TEST(RigidTranslation, MakesNoStressInAnyUpdateOrShape) {
  for (const LawKind law : {LawKind::linear_elastic, LawKind::neo_hookean})
    for (const ShapeFunction shape : shapes)
      for (const StressUpdate update : updates) {
        Scene s = flying_block(law);
        s.shape = shape;
        s.stress_update = update;
        s.plane = update == StressUpdate::musl ? Plane::stress : Plane::strain;
        SCOPED_TRACE(testing::Message() << name_of(law) << " " << name_of(shape) << " " << name_of(update));
        translate(s);
      }
}

TEST(RigidTranslation, MakesNoStressInAnyTransfer) {
  for (const Transfer transfer : {Transfer::pic, Transfer::xpic, Transfer::fmpm})
    for (const int order : {1, 2, 4}) {
      Scene s = flying_block(LawKind::linear_elastic);
      s.transfer = transfer;
      s.order = order;
      s.pic_fraction = 0.25 * order;
      SCOPED_TRACE(testing::Message() << name_of(transfer) << " " << order);
      translate(s);
    }
}

TEST(RigidTranslation, MakesNoStressInACrackedBody) {
  for (const ContactLaw law :
       {ContactLaw::ignored, ContactLaw::frictionless, ContactLaw::coulomb, ContactLaw::stick, ContactLaw::bonded})
    for (const Transfer transfer : {Transfer::flip, Transfer::xpic, Transfer::fmpm}) {
      Scene s = flying_block(LawKind::linear_elastic);
      s.transfer = transfer;
      cut(s, law);
      SCOPED_TRACE(testing::Message() << name_of(law) << " " << name_of(transfer));
      translate(s);
    }
}

/// v' = -kappa v: v falls to exp(-kappa t), the way is (v0 - v) / kappa, as far as steps of 0.01 / kappa can tell.
TEST(RigidTranslation, SlowsDownUnderEitherDampingAsOneBody) {
  for (const bool particles : {false, true})
    for (const StressUpdate update : updates) {
      Scene s = flying_block(LawKind::linear_elastic);
      s.stress_update = update;
      s.dt_max = 1e-3;
      const double kappa = 0.01 / s.dt_max;
      (particles ? s.particle_damping : s.grid_damping) = constant(kappa);
      const ChosenSpace space;
      Simulation m(s, space);
      const auto& p = m.state.particles;
      const double v0 = p.v[0][0], x0 = p.x[0][0];
      const int id = p.id[0];
      while (m.state.clock.step < 100)
        m.step();
      const long i = std::find(p.id.begin(), p.id.end(), id) - p.id.begin();
      ASSERT_DOUBLE_EQ(m.state.clock.dt, s.dt_max);
      SCOPED_TRACE(testing::Message() << name_of(update) << (particles ? " particles" : " grid"));
      EXPECT_NEAR(p.v[0][i], v0 * std::pow(0.99, 100), 1e-10 * v0);
      // each step moves the particle by the mean of its velocities before and after
      EXPECT_NEAR(p.x[0][i] - x0, (v0 - p.v[0][i]) / kappa * (1 - 0.005), 1e-10);
      EXPECT_LT(largest_stress(m, 1000), 1e-10 * 1e6);
      m.take_stock();
      EXPECT_LT(std::abs(m.state.ledger.energy.relative_error()), 1e-12);
      EXPECT_LT(m.state.ledger.momentum.error(), 1e-12);
    }
}

/// 1000 steps of a cracked block that spins and pulsates, its crack faces beating.
void beat(const Scene& scene, bool cracked) {
  const ChosenSpace space;
  Simulation m(scene, space);
  auto& p = m.state.particles;
  for (int i = 0; i < p.count(); ++i) {
    p.v[0][i] -= 2 * (p.x[0][i] - 0.5);
    p.v[1][i] -= 1.5 * (p.x[1][i] - 0.4);
  }
  m.take_stock();
  double most = 0;
  for (int n = 1; n <= 1000; ++n) {
    m.step();
    if (n % 50 == 0) {
      m.take_stock();
      most = std::max(most, m.state.ledger.momentum.error());
    }
  }
  EXPECT_LT(most, 1e-12);
  if (cracked) {
    EXPECT_GT(m.contact_after.touching, 1000) << "the faces must meet for this to prove anything";
  }
}

Scene beating_block() {
  Scene s = empty_scene(1. / 8, {{-2, -2}, {5, 3}});
  s.bodies = {body("block", Rectangle{{0, 0}, {1, 0.75}})};
  s.bodies[0].velocity = {1, -0.4};
  s.bodies[0].spin = 1;
  return s;
}

TEST(Momentum, IsKeptThroughEveryUpdateAndTransfer) {
  for (const StressUpdate update : updates)
    for (const Transfer transfer : {Transfer::flip, Transfer::xpic, Transfer::fmpm}) {
      Scene s = beating_block();
      s.stress_update = update;
      s.transfer = transfer;
      s.cfl = 0.3;
      s.limits.energy_growth = 1;
      SCOPED_TRACE(testing::Message() << name_of(update) << " " << name_of(transfer));
      beat(s, false);
    }
}

TEST(Momentum, IsKeptThroughContactOnCrossingCracks) {
  for (const ContactLaw law : {ContactLaw::frictionless, ContactLaw::coulomb, ContactLaw::stick, ContactLaw::bonded})
    for (const Transfer transfer : {Transfer::flip, Transfer::xpic, Transfer::fmpm}) {
      Scene s = beating_block();
      s.transfer = transfer;
      cut(s, law);
      SCOPED_TRACE(testing::Message() << name_of(law) << " " << name_of(transfer));
      beat(s, law != ContactLaw::ignored);
    }
}

}  // namespace
}  // namespace riven
