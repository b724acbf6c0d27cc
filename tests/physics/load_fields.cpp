// Loads that vary over places and time: their sums, their impulse and their work against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "tests/physics/scenes.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace test;

/// A block of 1 x 1 m and 1000 kg in free space.
Scene block() {
  Scene s = empty_scene(1. / 8, {{-0.5, -0.5}, {1.5, 1.5}});
  s.bodies = {body("block", Rectangle{{0, 0}, {1, 1}})};
  return s;
}

Load acceleration(const Scene& s, Field x) {
  Load load;
  load.kind = Load::Kind::acceleration;
  load.region = s.bodies[0].region;
  load.value[0] = std::move(x);
  return load;
}

/// a = X t.
Field ramp() {
  return {1, [](double t, long n, const double* X, const double*, double* out) {
            for (long i = 0; i < n; ++i)
              out[i] = X[i] * t;
          }};
}

TEST(LoadFields, AUniformAccelerationIsTheBodyForce) {
  Scene with_load = block(), with_gravity = block();
  with_load.loads = {acceleration(with_load, constant(3))};
  with_gravity.body_force[0] = constant(3);
  const ChosenSpace space;
  Simulation a(with_load, space), b(with_gravity, space);
  for (int k = 0; k < 50; ++k) {
    a.step();
    b.step();
  }
  a.take_stock();
  b.take_stock();
  const double v = 3 * b.state.clock.time;
  for (int i = 0; i < a.state.particles.count(); ++i) {
    EXPECT_NEAR(a.state.particles.v[0][i], v, 1e-12 * v);
    EXPECT_NEAR(b.state.particles.v[0][i], v, 1e-12 * v);
  }
  const double work = 0.5 * 1000 * v * v;
  EXPECT_NEAR(a.state.ledger.energy.external_work, work, 0.02 * work);  // booked half a step late
  EXPECT_LT(a.state.ledger.momentum.error(), 1e-13);
}

/// The impulse of a(X, t) = X t on a block of mass M between 0 and 1 is M T^2 / 4: particles sit evenly about the
/// middle, and a step takes the load as it is in its middle.
TEST(LoadFields, GiveTheImpulseOfTheirIntegral) {
  Scene s = block();
  s.loads = {acceleration(s, ramp())};
  const ChosenSpace space;
  Simulation m(s, space);
  for (int k = 0; k < 40; ++k)
    m.step();
  m.take_stock();
  const double T = m.state.clock.time, impulse = 1000 * T * T / 4;
  EXPECT_NEAR(m.state.ledger.momentum.linear.x, impulse, 1e-12 * impulse);
  EXPECT_NEAR(m.state.ledger.momentum.impulse.x, impulse, 1e-12 * impulse);
  EXPECT_LT(m.state.ledger.momentum.error(), 1e-13);
}

/// A traction that rises along the edge has the resultant and the moment of its triangle.
TEST(LoadFields, GiveTheMomentOfATractionThatVariesAlongItsEdge) {
  Scene s = block();
  Load load = traction_on(Load::Edge::right, s.bodies[0].region);
  load.value[0] = {60, [](double, long n, const double*, const double* Y, double* out) { std::copy(Y, Y + n, out); }};
  s.loads = {load};
  const ChosenSpace space;
  Simulation m(s, space);
  m.step();
  Vec2 force;
  double moment = 0;
  for (long k = 0; k < m.state.loads.force.size(); ++k) {
    force += m.state.loads.force[k];
    moment += cross(m.state.loads.applied_at[k], m.state.loads.force[k]);
  }
  EXPECT_NEAR(force.x, 30, 1e-12);
  EXPECT_EQ(force.y, 0);
  EXPECT_NEAR(moment, -20, 0.02);  // -60 times the mean of y^2 over the rows of particles
}

/// A bar of 30 x 10 cells between tractions that stretch it by 0.8 %, so that its ends lie an eighth of a cell within
/// the next cells, at rest. By the functions of the particles' middles the last two rows bore 0.3 and 1.3 of them.
TEST(LoadFields, TractionsAreTheStressOfTheParticlesBesideThem) {
  constexpr double mm = 1e-3, E = 2.5e9, traction = 20e6, rise = 0.1e-3;
  for (const ShapeFunction shape : {ShapeFunction::linear, ShapeFunction::ugimp, ShapeFunction::bspline}) {
    Scene s = empty_scene(mm, {{-6 * mm, -4 * mm}, {36 * mm, 14 * mm}});
    s.plane = Plane::stress;
    s.shape = shape;
    s.transfer = Transfer::fmpm;
    s.materials = {{"bar", LawKind::linear_elastic, E, 0.33, 1000}};
    s.bodies = {body("bar", Rectangle{{0, 0}, {30 * mm, 10 * mm}})};
    for (const double side : {-1., 1.}) {
      Load load = traction_on(side > 0 ? Load::Edge::right : Load::Edge::left, s.bodies[0].region);
      load.value[0] = TimeFunction{side * traction, [](double t) { return std::min(t / rise, 1.); }, ""};
      s.loads.push_back(load);
    }
    s.grid_damping = constant(8e4);
    const ChosenSpace space;
    Simulation m(s, space);
    const auto& p = m.state.particles;
    const std::vector<double> first(p.x[0].begin(), p.x[0].end());  // by id
    while (m.state.clock.time < 1e-3)
      m.step();
    for (long i = 0; i < p.count(); ++i)
      if (const double from = first[static_cast<size_t>(p.id[i])]; from < mm || from > 29 * mm) {
        EXPECT_NEAR(1000 * p.stress[0][i] / traction, 1, 0.02) << name_of(shape) << ", from " << from;
      }
    m.take_stock();
    EXPECT_NEAR(m.state.ledger.energy.unaccounted() / m.state.ledger.energy.external_work, 0, 1e-4);
  }
}

TEST(LoadFields, AreTheSameOnAnyNumberOfThreads) {
  const auto run = [](int threads) {
    Scene s = block();
    s.bodies[0].particles_per_cell = 5;
    s.loads = {acceleration(s, ramp())};
    const exec::Space space(exec::Kind::openmp, threads);
    Simulation m(s, space);
    for (int k = 0; k < 20; ++k)
      m.step();
    return std::vector<double>(m.state.particles.x[0].begin(), m.state.particles.x[0].end());
  };
  EXPECT_EQ(run(1), run(3));
}

/// Fields that are not finite where they act are refused before the first step, with the place.
TEST(LoadFields, MustBeNumbersWhereTheyAct) {
  const auto bad = [](double, long n, const double* X, const double*, double* out) {
    for (long i = 0; i < n; ++i)
      out[i] = std::sqrt(0.5 - X[i]);
  };
  Scene load = block(), velocity = block();
  load.loads = {acceleration(load, Field(1, bad))};
  load.loads[0].name = "wind";
  velocity.bodies[0].velocity_field[0] = Field(1, bad);
  const ChosenSpace space;
  for (const Scene* s : {&load, &velocity})
    try {
      const Simulation m(*s, space);
      ADD_FAILURE() << "not refused";
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), Exit::bad_input);
      EXPECT_NE(std::string(e.what()).find("is not a number everywhere"), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find(s == &load ? "load wind" : "body block"), std::string::npos);
    }
}

}  // namespace
}  // namespace riven
