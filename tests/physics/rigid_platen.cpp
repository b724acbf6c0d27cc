// A body that is a grip all through, and one that is pressed on it and slides: the platen bears the load, and friction
// times it, and stands; where it is free in one component alone, it is pushed aside.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "tests/physics/scene_gates.hpp"
#include "tests/physics/scenes.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace test;

constexpr double length = 20;  // cells, each 1 m

/// A block of 20 x 10 cells, each 1 m, on a platen that is a grip through and through, pressed down by 1 % of E within
/// 2 s. From 6 s on its upper edge moves sideways by `speed`, m/s.
Scene block_on_platen(const ContactSettings& law, double speed) {
  Scene s = empty_scene(1, {{-8, -6}, {length + 8, 14}});
  s.materials[0].nu = 0;
  const Rectangle platen{{-6, -4}, {length + 6, 0}};
  s.bodies = {body("platen", platen), body("block", Rectangle{{0, 0}, {length, 10}})};
  s.cracks = {crack("foot", {{-7, 0}, {length + 7, 0}})};
  s.contact = law;
  const auto from = [](double start) { return [start](double t) { return std::clamp((t - start) / 2, 0., 1.); }; };
  s.grips = {grip_at_rest("platen", platen)};
  s.fixed = {{"top", {{-2, 10}, {length + 2, 10}}, {TimeFunction{-speed, from(6), ""}, std::nullopt}}};
  Load top = traction_on(Load::Edge::top, Rectangle{{0, 9}, {length, 10}});
  top.name = "top";
  top.value[1] = TimeFunction{-0.01 * s.materials[0].E, from(0), ""};
  s.loads = {top};
  s.grid_damping = constant(5);
  s.end_time = 16;
  return s;
}

struct OnPlaten {
  double sunk = 0;      ///< cells, mean of the lowest particles of the block
  Vec2 carried;         ///< reaction of the platen over the load, mean of the last 2 s
  double unbooked = 0;  ///< energy that nothing accounts for, over the largest
  double caught = 0;    ///< and what grips caught
};

OnPlaten press_on_platen(const Scene& s) {
  const ChosenSpace space;
  Simulation m(s, space);
  OnPlaten r;
  Vec2 impulse;
  double since = 0;
  while (!m.finished()) {
    m.step();
    const Clock& c = m.state.clock;
    if (c.time < s.end_time - 2)
      continue;
    since += c.dt;
    impulse += c.dt * m.state.constraints.owners.back().reaction;
  }
  r.carried = (1 / since / (0.01 * s.materials[0].E * length)) * impulse;
  const auto& p = m.state.particles;
  int count = 0;
  for (long i = 0; i < p.count(); ++i)
    if (p.body[i] == 1 && p.x0[1][i] < 0.5) {
      r.sunk += p.x0[1][i] - p.x[1][i];
      ++count;
    }
  r.sunk /= count;
  m.take_stock();
  const Energy& e = m.state.ledger.energy;
  r.unbooked = e.relative_error();
  r.caught = e.capture / e.strain;
  return r;
}

// The lowest particles lie a quarter of a cell above the platen, and sink by a quarter of 1 % of a cell.
TEST(RigidPlaten, DoesNotGiveWayToFacesThatPressOnIt) {
  const auto expect = [](const char* what, const Scene& s, double friction) {
    const OnPlaten r = press_on_platen(s);
    gates::report(fmt::format("{} on a rigid platen: face, cells below where it was", what), r.sunk, "0.0025 +-0.01");
    gates::report("and force along the platen over the load", r.carried.x, fmt::format("{} +-1 %", friction));
    EXPECT_NEAR(r.sunk, 0.0025, 0.01) << what;
    EXPECT_NEAR(r.carried.y, 1, 0.01) << what;
    EXPECT_NEAR(r.carried.x, friction, 0.01 * friction + 1e-3) << what;
    EXPECT_LT(std::abs(r.unbooked), 0.01) << what;
    EXPECT_LT(std::abs(r.caught), 0.02) << what;
  };
  for (const Transfer transfer : {Transfer::flip, Transfer::fmpm}) {
    Scene smooth = block_on_platen({ContactLaw::frictionless, 0, 0, 0}, 0.05);
    Scene rough = block_on_platen({ContactLaw::coulomb, 0.3, 0, 0}, 0.05);
    Scene stuck = block_on_platen({ContactLaw::stick, 0, 0, 0}, 0);
    Scene cut = smooth;  // nodes that hold two cracks
    cut.cracks.push_back(crack("cut", {{length / 2, 11}, {length / 2, -1}}));
    for (Scene* s : {&smooth, &rough, &stuck, &cut}) {
      s->transfer = transfer;
      s->order = 2;
    }
    expect("smooth block", smooth, 0);
    expect("rough block", rough, 0.3);
    expect("block that sticks", stuck, 0);
    expect("block cut in two", cut, 0);
  }
}

/// Of the particles of a body.
struct Means {
  Vec2 place, velocity;
};
Means means_of(const Simulation& m, int body) {
  const auto& p = m.state.particles;
  Means all;
  int count = 0;
  for (long i = 0; i < p.count(); ++i)
    if (p.body[i] == body) {
      all.place += {p.x[0][i], p.x[1][i]};
      all.velocity += {p.v[0][i], p.v[1][i]};
      ++count;
    }
  return {(1. / count) * all.place, (1. / count) * all.velocity};
}

// A block of mass m slides down a slope of 30 degrees on a wedge of mass M, whose grip holds it up and lets it go
// sideways. With N the force across the slope, s and c its sine and cosine,
//   M A = N (s - mu c),   N (c + mu s + (s - mu c) (1 + m/M) s/c) = m g.
TEST(RigidPlaten, IsPushedAsideWhereItIsFree) {
  const double angle = std::numbers::pi / 6, c = std::cos(angle), s = std::sin(angle), weight = 0.125;
  const double time = 6;  // in which the wedge moves by half a cell, and its grip does not
  const auto at = [&](double along, double up) { return Vec2{c * along - s * up, s * along + c * up}; };
  for (const double mu : {0., 0.3}) {
    Scene scene = empty_scene(1, {{-26, -24}, {34, 34}});
    scene.transfer = Transfer::xpic;
    scene.order = 2;
    const Polygon wedge{{at(-20, -5), at(26, -5), at(26, 0), at(-20, 0)}};
    scene.bodies = {body("wedge", wedge), body("block", Polygon{{at(0, 0), at(16, 0), at(16, 8), at(0, 8)}})};
    scene.cracks = {crack("foot", {at(-21, 0), at(27, 0)})};
    scene.contact = {ContactLaw::coulomb, mu, 0, 0};
    scene.grips = {grip_at_rest("wedge", wedge)};
    scene.grips[0].velocity[0].reset();
    scene.body_force[1] = constant(-weight);
    const ChosenSpace space;
    Simulation m(scene, space);
    const auto apart = [&] { return dot(means_of(m, 1).place - means_of(m, 0).place, Vec2{-s, c}); };
    const double first = apart();
    while (m.state.clock.time < time)
      m.step();
    double mass[2] = {0, 0};
    for (long i = 0; i < m.state.particles.count(); ++i)
      mass[m.state.particles.body[i]] += m.state.particles.mass[i];
    const double slides = s - mu * c, ratio = mass[1] / mass[0];
    const double across = mass[1] * weight / (c + mu * s + slides * (1 + ratio) * s / c);
    const double wedge_speed = means_of(m, 0).velocity.x, block_speed = means_of(m, 1).velocity.x;
    const double aside = wedge_speed / (m.state.clock.time * across * slides / mass[0]);
    gates::report(fmt::format("wedge that a block pushes aside, friction {}: its speed over that of rigid bodies", mu),
                  aside, "1 +-0.03");
    gates::report("and how far the block sinks into it, cells", first - apart(), "0 +-0.01");
    EXPECT_NEAR(aside, 1, 0.03);
    EXPECT_NEAR(first - apart(), 0, 0.01);
    EXPECT_NEAR(wedge_speed + ratio * block_speed, 0, 1e-9) << "momentum along x";
  }
}

/// A block of 20 x 12 cells between a clamp and a platen whose border lies at `angle`, under the one and over the
/// other. The platen rises by 0.05 cells within 8 s and then stands; sideways it is free. How far the energy that
/// contact takes changes from there on, in which nothing moves, over the strain energy.
double contact_creep(double angle, const ContactSettings& law) {
  Scene s = empty_scene(1, {{-8, -10}, {length + 8, 24}});
  s.transfer = Transfer::flip;
  const double rise = length * std::tan(angle);
  const Polygon platen{{{0, -4}, {length, -4}, {length, rise}, {0, 0}}};
  const Polygon block{{{0, 0}, {length, rise}, {length, 18}, {0, 18}}};
  s.bodies = {body("platen", platen), body("block", block)};
  s.cracks = {crack("foot", {{-3, -3 * std::tan(angle)}, {length + 3, rise + 3 * std::tan(angle)}})};
  s.contact = law;
  s.grips = {grip_at_rest("clamp", Rectangle{{0, 18}, {length, 20}}), grip_at_rest("platen", platen)};
  s.grips[1].velocity[0].reset();
  s.grips[1].velocity[1] = TimeFunction{
      0.05 / 4, [](double t) { return t < 8 ? 0.5 * (1 - std::cos(2 * std::numbers::pi * t / 8)) : 0; }, ""};
  s.end_time = 40;
  const ChosenSpace space;
  Simulation m(s, space);
  while (m.state.clock.time < 10)
    m.step();
  const double first = m.state.ledger.energy.contact;
  while (!m.finished())
    m.step();
  m.take_stock();
  return (m.state.ledger.energy.contact - first) / m.state.ledger.energy.strain;
}

TEST(RigidPlaten, ThatIsFreeSidewaysTakesNoEnergyAtRest) {
  const std::pair<double, ContactSettings> scenes[] = {{0, {ContactLaw::stick, 0, 0, 0}},
                                                       {0.3, {ContactLaw::coulomb, 0.6, 0, 0}}};
  for (const auto& [angle, law] : scenes) {
    const double creep = contact_creep(angle, law);
    gates::report(fmt::format("platen at {} that is free sideways: energy of contact at rest over strain", angle),
                  creep, "0 +-0.01");
    EXPECT_NEAR(creep, 0, 0.01) << angle;
  }
}

}  // namespace
}  // namespace riven
