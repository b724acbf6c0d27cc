// Contact in whole runs, against closed forms: bonded and stiff interfaces against the solid, an elastic impact of two
// bars, two blocks on a spring, a squeezed block with two crossing cracks, and Coulomb's limit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "kernels/simulation.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

Scene make_scene(double cell, Rectangle grid) {
  Scene s;
  s.cell = cell;
  s.grid = grid;
  s.end_time = 1e3;
  s.thickness = 1;
  s.materials = {{"solid", LawKind::linear_elastic, 1e6, 0.3, 1000}};
  s.deterministic = true;
  return s;
}

Body block(const char* name, Vec2 lower, Vec2 upper, Vec2 velocity = {}) {
  Body b;
  b.name = name;
  b.region = Rectangle{lower, upper};
  b.velocity = velocity;
  return b;
}

CrackLine crack(const char* name, Vec2 from, Vec2 to) {
  CrackLine c;
  c.name = name;
  c.points = {from, to};
  return c;
}

std::vector<Vec2> places(const Simulation& m) {
  std::vector<Vec2> x(static_cast<size_t>(m.state.particles.count()));
  for (int i = 0; i < m.state.particles.count(); ++i)
    x[static_cast<size_t>(m.state.particles.id[i])] = {m.state.particles.x[0][i], m.state.particles.x[1][i]};
  return x;
}

/// A turning, vibrating block, whole or cut by two crossing cracks; largest distance between the two after 100 steps.
double distance_from_whole(StressUpdate update, Transfer transfer, int order, ContactSettings law) {
  Scene whole = make_scene(1. / 8, {{-0.5, -0.5}, {1.5, 1.5}});
  whole.stress_update = update;
  whole.transfer = transfer;
  whole.order = order;
  whole.bodies = {block("block", {0, 0}, {1, 1}, {0.1, -0.05})};
  whole.bodies[0].spin = 0.5;
  Scene cut = whole;
  cut.contact = law;
  cut.cracks = {crack("level", {0, 0.513}, {1, 0.513}), crack("upright", {0.487, 0}, {0.487, 1})};
  const test::ChosenSpace space;
  Simulation a(whole, space), b(cut, space);
  for (int n = 0; n < 100; ++n) {
    a.step();
    b.step();
  }
  EXPECT_GT(b.contact_after.touching, 1000);
  const auto xa = places(a), xb = places(b);
  double most = 0;
  for (size_t i = 0; i < xa.size(); ++i)
    most = std::max(most, norm(xa[i] - xb[i]));
  return most;
}

TEST(ContactRuns, BondedCracksAreNotThere) {
  for (StressUpdate update : {StressUpdate::usl, StressUpdate::musl, StressUpdate::usf, StressUpdate::usavg})
    for (Transfer transfer : {Transfer::flip, Transfer::xpic, Transfer::fmpm})
      EXPECT_LT(distance_from_whole(update, transfer, 2, {ContactLaw::bonded}), 1e-12);
  for (Transfer transfer : {Transfer::xpic, Transfer::fmpm})
    for (int order : {3, 4, 6})
      EXPECT_LT(distance_from_whole(StressUpdate::usavg, transfer, order, {ContactLaw::bonded}), 1e-12);
}

TEST(ContactRuns, AStiffInterfaceIsABondAndASoftOneIsNot) {
  for (Transfer transfer : {Transfer::flip, Transfer::xpic, Transfer::fmpm})
    for (int order : {2, 4})
      EXPECT_LT(distance_from_whole(StressUpdate::usavg, transfer, order, {ContactLaw::interface, 0, 1e16, 1e16}),
                1e-10)
          << name_of(transfer) << ' ' << order;
  EXPECT_GT(distance_from_whole(StressUpdate::usavg, Transfer::flip, 1, {ContactLaw::interface, 0, 1e4, 1e4}), 1e-5);
}

struct TwoBars {
  double low = 0, up = 0;  ///< mean velocities
};
TwoBars mean_velocities(const Simulation& m) {
  TwoBars v;
  const auto& p = m.state.particles;
  for (int i = 0; i < p.count(); ++i)
    (p.body[i] == 0 ? v.low : v.up) += p.v[1][i] * 2 / p.count();
  return v;
}

/// Bars of one length exchange their velocities in 2 L / c (one dimension, no Poisson's ratio).
TEST(ContactRuns, ElasticBarsExchangeTheirVelocities) {
  for (ContactLaw law : {ContactLaw::frictionless, ContactLaw::stick}) {
    Scene s = make_scene(1. / 16, {{-0.5, -1}, {0.75, 3}});
    s.materials[0].nu = 0;
    s.contact.law = law;
    s.bodies = {block("low", {0, 0}, {0.25, 1}), block("up", {0, 1}, {0.25, 2}, {0, -1})};
    s.cracks = {crack("contact", {0, 1 + 1e-4}, {0.25, 1 + 1e-4})};
    const test::ChosenSpace space;
    Simulation m(s, space);
    m.take_stock();
    const double first = m.state.ledger.energy.total(), duration = 2 / std::sqrt(1e3);
    double last_contact = 0;
    while (m.state.clock.time < 1.5 * duration) {
      const long before = m.contact_after.touching;
      m.step();
      if (m.contact_after.touching >= before + 5)  // of ten, twice five nodes; corners may touch once more
        last_contact = m.state.clock.time;
    }
    m.take_stock();
    EXPECT_NEAR(last_contact, duration, 0.05 * duration);
    const TwoBars v = mean_velocities(m);
    EXPECT_NEAR(v.low, -1, 0.06);  // numerical dispersion keeps a few per cent in vibration
    EXPECT_NEAR(v.up, 0, 0.06);
    EXPECT_NEAR(m.state.ledger.energy.total(), first, 0.005 * first);
    EXPECT_LT(m.contact_after.penetration, 0.05 * s.cell);
    EXPECT_LT(m.contact_after.gap, 0.2 * s.cell);
    EXPECT_LT(m.state.ledger.momentum.error(), 1e-12);
    EXPECT_EQ(m.contact_after.capped + m.contact_before.capped + m.contact_again.capped, 0);
  }
}

/// Two nearly rigid blocks of 125 kg on a spring of 1e5 Pa/m times 0.25 m^2.
TEST(ContactRuns, BlocksOnASoftInterfaceOscillateWithItsFrequency) {
  Scene s = make_scene(1. / 8, {{-0.5, -0.5}, {0.75, 1.5}});
  s.materials[0].nu = 0;
  s.materials[0].E = 1e7;
  s.contact = {ContactLaw::interface, 0, 1e5, 0};
  const double speed = 0.01;
  s.bodies = {block("low", {0, 0}, {0.25, 0.5}), block("up", {0, 0.5}, {0.25, 1}, {0, speed})};
  s.cracks = {crack("spring", {0, 0.5 + 1e-4}, {0.25, 0.5 + 1e-4})};
  const test::ChosenSpace space;
  Simulation m(s, space);
  m.take_stock();
  const double first = m.state.ledger.energy.total();
  const double w = std::sqrt(1e5 * 0.25 / (125. / 2)), period = 2 * std::numbers::pi / w;
  double before = 1, widest = 0, turn[2] = {};
  int turns = 0;
  while (m.state.clock.time < period) {
    m.step();
    const TwoBars v = mean_velocities(m);
    const double opening_speed = v.up - v.low;
    if (before * opening_speed < 0 && turns < 2)
      turn[turns++] = m.state.clock.time;
    before = opening_speed;
    for (const Vec2& j : m.state.cracks.jump)
      widest = std::max(widest, j.x);
  }
  ASSERT_EQ(turns, 2);
  EXPECT_NEAR(turn[0], period / 4, 0.02 * period / 4);
  EXPECT_NEAR(turn[1] - turn[0], period / 2, 0.02 * period / 2);
  EXPECT_NEAR(widest, speed / w, 0.02 * speed / w);
  EXPECT_NEAR(before, speed, 0.02 * speed);
  m.take_stock();
  EXPECT_LT(m.state.ledger.energy.total(), first * 1.001);
}

TimeFunction ramp(double velocity, double duration) {
  TimeFunction f;
  f.value = velocity;
  f.shape = [=](double t) { return t < duration ? 1. : 0.; };
  return f;
}

/// Walls move inwards by `strain` / 2 of the unit block on each side and carry its sides along.
Scene squeezed_block(double strain_x, double strain_y) {
  Scene s = make_scene(1. / 8, {{-0.5, -0.5}, {1.5, 1.5}});
  s.bodies = {block("block", {0, 0}, {1, 1})};
  const double time = 0.2;
  const auto wall = [&](const char* name, Rectangle box, int axis, double v) {
    FixedNodes f;
    f.name = name;
    f.box = box;
    f.velocity[axis] = ramp(v / time, time);
    s.fixed.push_back(f);
  };
  wall("bottom", {{-0.5, -0.5}, {1.5, 0}}, 1, -strain_y / 2);
  wall("top", {{-0.5, 1}, {1.5, 1.5}}, 1, strain_y / 2);
  wall("left", {{-0.5, -0.5}, {0, 1.5}}, 0, -strain_x / 2);
  wall("right", {{1, -0.5}, {1.5, 1.5}}, 0, strain_x / 2);
  TimeFunction damping;
  damping.value = 20;
  s.grid_damping = damping;
  return s;
}

struct Stress {
  double xx = 0, yy = 0, xy = 0;
};
Stress mean_stress(const Simulation& m) {
  Stress t;
  const auto& p = m.state.particles;
  for (int i = 0; i < p.count(); ++i) {
    t.xx += 1000 * p.stress[0][i] / p.count();
    t.yy += 1000 * p.stress[1][i] / p.count();
    t.xy += 1000 * p.stress[2][i] / p.count();
  }
  return t;
}

/// Plane strain: sigma = E e / ((1 + nu) (1 - 2 nu)) on both axes.
TEST(ContactRuns, TwoCrossingClosedCracksCarryTheLoadOfASqueezedBlock) {
  const double strain = -1e-3, expected = 1e6 * strain / (1.3 * 0.4);
  for (ContactLaw law : {ContactLaw::frictionless, ContactLaw::ignored}) {
    Scene s = squeezed_block(strain, strain);
    s.contact.law = law;
    s.cracks = {crack("level", {0, 0.513}, {1, 0.513}), crack("upright", {0.487, 0}, {0.487, 1})};
    const test::ChosenSpace space;
    Simulation m(s, space);
    while (m.state.clock.time < 0.5)
      m.step();
    const Stress t = mean_stress(m);
    if (law == ContactLaw::ignored) {  // negative control: the quarters pass through each other
      EXPECT_LT(std::abs(t.xx), 0.7 * std::abs(expected));
      continue;
    }
    EXPECT_NEAR(t.xx, expected, 0.01 * std::abs(expected));
    EXPECT_NEAR(t.yy, expected, 0.01 * std::abs(expected));
    EXPECT_NEAR(t.xy, 0, 0.001 * std::abs(expected));
    EXPECT_LT(m.contact_after.penetration, 0.05 * s.cell);
    EXPECT_EQ(m.contact_after.capped, 0);
  }
}

/// A body pressed onto another by a weight slides to rest under friction: what it loses of its speed the lower body, of
/// the same mass and free to move, gains, until both move together. The weight is there at once: in a column of height
/// H = 2 y on a floor, with waves of speed c, what y bears of it is 0 up to y / c, then g c (t - y / c) of the mass
/// above, and from 3 y / c to 5 y / c twice that at rest.
TEST(ContactRuns, FrictionSlowsASlidingBodyByCoulombsLaw) {
  const double mu = 0.3, g = 10, speed = 0.3;
  Scene s = make_scene(1. / 8, {{-1, -0.5}, {3, 1.5}});
  s.materials[0].nu = 0;
  s.contact = {ContactLaw::coulomb, mu, 0, 0};
  s.bodies = {block("low", {0, 0}, {1, 0.25}), block("up", {0, 0.25}, {1, 0.5}, {speed, 0})};
  FixedNodes floor;
  floor.name = "floor";
  floor.box = {{-1, -0.5}, {3, 0}};
  floor.velocity[1] = TimeFunction{};
  s.fixed = {floor};
  s.body_force[1] = TimeFunction{-g, {}, ""};
  s.cracks = {crack("slide", {0, 0.25 + 1e-4}, {1, 0.25 + 1e-4})};
  const test::ChosenSpace space;
  Simulation m(s, space);
  const auto along = [&] {
    TwoBars v;
    const auto& p = m.state.particles;
    for (int i = 0; i < p.count(); ++i)
      (p.body[i] == 0 ? v.low : v.up) += p.v[0][i] * 2 / p.count();
    return v;
  };
  const double rest = speed / (2 * mu * g);  // when the relative velocity has gone
  while (m.state.clock.time < 0.5 * rest)
    m.step();
  const TwoBars half = along();
  const double y = 0.25, c = std::sqrt(1e3), t = m.state.clock.time;
  const double borne = g * c * (0.5 * std::pow(2 * y / c, 2) + 2 * y / c * (t - 3 * y / c)) / y;  // per mass
  ASSERT_GT(t, 3 * y / c);
  EXPECT_NEAR(half.up, speed - mu * borne, 0.01 * speed);
  EXPECT_NEAR(half.low, mu * borne, 0.01 * speed);
  while (m.state.clock.time < 4 * rest)  // they swing against each other at first
    m.step();
  const TwoBars end = along();
  EXPECT_NEAR(end.up, 0.5 * speed, 0.03 * speed);
  EXPECT_NEAR(end.low, 0.5 * speed, 0.03 * speed);
}

}  // namespace
}  // namespace riven
