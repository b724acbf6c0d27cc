// Cracks that run in bodies that fly or spin. No crack knows of how its body moves as a whole, but for the forces by
// which a body that spins is held together.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "tests/physics/scene_gates.hpp"
#include "tests/physics/scenes.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace test;

constexpr double mm = 1e-3, us = 1e-6, MPa = 1e6;

/// A crack 0.2 mm above the middle of a free plate that is pulled at both ends until it has been cut in two.
Scene flying_plate(Vec2 velocity) {
  Scene s = pulled_plate(crack("centre", {{-5 * mm, 0.2 * mm}, {5 * mm, 0.2 * mm}}), 4);
  s.transfer = Transfer::flip;
  s.grid_damping = {};
  s.bodies[0].velocity = velocity;
  for (Load& l : s.loads)
    l.value[1] =
        TimeFunction{l.name == "top" ? 10 * MPa : -10 * MPa, [](double t) { return std::min(1., t / (60 * us)); }, ""};
  s.growth = GrowthRule{};
  s.growth->toughness = 1e6;
  return s;
}

/// Where both tips leave the plate, as seen from it, and when.
struct Exit {
  double aside = 0;  ///< m, of the line of the crack, the larger one
  double time[2] = {};
};
Exit run_through(Vec2 velocity) {
  const Scene s = flying_plate(velocity);
  const ChosenSpace space;
  Simulation m(s, space);
  while (!m.finished() && (m.state.tips[0].open || m.state.tips[1].open))
    m.step();
  Exit found;
  for (const CrackEvent& e : m.state.events) {
    if (e.kind != CrackEvent::Kind::exit)
      continue;
    found.aside = std::max(found.aside, std::abs(e.place.y - velocity.y * e.time - 0.2 * mm));
    found.time[e.last] = e.time;
  }
  return found;
}

TEST(MovingBody, IsCutAsOneAtRest) {
  const Exit rest = run_through({});
  ASSERT_GT(std::min(rest.time[0], rest.time[1]), 0);
  for (const Vec2 velocity : {Vec2{0, 50}, Vec2{100, 0}}) {
    const Exit flies = run_through(velocity);
    const std::string speed = fmt::format("plate that flies at ({}, {}) m/s: ", velocity.x, velocity.y);
    gates::report(speed + "way of its crack off a straight one, mm", flies.aside / mm, "0.5");
    EXPECT_LT(flies.aside, 0.5 * mm);
    for (int end = 0; end < 2; ++end) {
      gates::report(speed + "time until it is cut over that of one at rest", flies.time[end] / rest.time[end],
                    "1 +- 0.04");
      EXPECT_NEAR(flies.time[end] / rest.time[end], 1, 0.04);
    }
  }
}

/// A crack that its pressure drives through a disk, and how far it runs off its radius, rad.
double way_off_radius(double spin) {
  Scene s = empty_scene(1 * mm, {{-36 * mm, -36 * mm}, {36 * mm, 36 * mm}});
  s.materials = {{"disk", LawKind::linear_elastic, 3e9, 0.3, 1200}};
  s.plane = Plane::stress;
  s.thickness = 1 * mm;
  s.transfer = Transfer::fmpm;
  s.order = 2;
  s.bodies = {body("disk", Disk{{0, 0}, 30 * mm})};
  s.bodies[0].spin = spin;
  CrackLine line = crack("centre", {{-8 * mm, 0}, {8 * mm, 0}});
  TractionSettings pressure;
  pressure.kind = TractionKind::pressure;
  pressure.pressure = TimeFunction{5 * MPa, [](double t) { return std::min(1., t / (10 * us)); }, ""};
  pressure.region = Rectangle{{-8 * mm, -1 * mm}, {8 * mm, 1 * mm}};
  line.traction = pressure;
  s.cracks = {line};
  s.growth = GrowthRule{};
  s.growth->toughness = 0.5e6;
  s.fracture.contour = 8;
  s.end_time = 60 * us;
  const ChosenSpace space;
  Simulation m(s, space);
  const auto length = [&](const Tip& t) { return t.length; };
  while (!m.finished() && length(m.state.tips[0]) < 12 * mm && length(m.state.tips[1]) < 12 * mm)
    m.step();
  double most = 0;
  const double turned_by = spin * m.state.clock.time;
  for (const Tip& t : m.state.tips) {
    const Vec2 x = m.state.cracks.plane[m.state.cracks.end_point(t.crack, t.last)];
    EXPECT_GT(t.length, 8 * mm);
    const double way = std::atan2(x.y, x.x) - turned_by;
    most = std::max(most, std::abs(std::remainder(way, std::numbers::pi)));
  }
  return most;
}

/// As steady fields around a tip move with it, what the disk does as a whole would be a part of K_II.
TEST(MovingBody, SpinsAndItsCrackKeepsToTheRadius) {
  for (const double spin : {0., 1000.}) {
    const double degrees = way_off_radius(spin) * 180 / std::numbers::pi;
    gates::report(fmt::format("way of a crack off its radius in a disk with {} rad/s, degrees", spin), degrees, "0.5");
    EXPECT_LT(degrees, 0.5);
  }
}

/// A block that is pulled across its crack and pushed along it: both tips have the same, whatever the contour. What
/// holds the block back within the contour is of the order of J by 4 cells, and three times J by 8.
TEST(MovingBody, SpeedsUpWithTheSameJAtBothTips) {
  Scene s = empty_scene(1 * mm, {{-28 * mm, -20 * mm}, {36 * mm, 20 * mm}});
  s.materials = {{"block", LawKind::linear_elastic, 3e9, 0.3, 1200}};
  s.thickness = 1 * mm;
  const Rectangle block{{-16 * mm, -16 * mm}, {16 * mm, 16 * mm}};
  s.bodies = {body("block", block)};
  s.cracks = {crack("centre", {{-6 * mm, 0}, {6 * mm, 0}})};
  const auto rises = [](double t) {
    return t < 150 * us ? 0.5 * (1 - std::cos(std::numbers::pi * t / (150 * us))) : 1;
  };
  const auto pull = [&](Load::Edge edge, int axis, double stress) {
    Load load = traction_on(edge, block);
    load.value[axis] = TimeFunction{stress, rises, ""};
    s.loads.push_back(load);
  };
  pull(Load::Edge::top, 1, 5 * MPa);
  pull(Load::Edge::bottom, 1, -5 * MPa);
  pull(Load::Edge::right, 0, 40 * MPa);
  s.fracture.asked = true;
  for (const int contour : {4, 8, 16}) {
    FractureRules rules;
    rules.contour = contour;
    s.readings.push_back({std::to_string(contour), rules});
  }
  s.output.history_every = 1 * us;
  s.end_time = 200 * us;
  const ChosenSpace space;
  Simulation m(s, space);
  double J[3][2] = {};  // sums over steps
  while (!m.finished()) {
    m.step();
    if (m.state.clock.time < 160 * us)
      continue;
    for (size_t k = 0; k < 3; ++k)
      for (size_t tip = 0; tip < 2; ++tip)
        J[k][tip] += m.state.readings[k][tip].J;
  }
  const double by_16 = 0.5 * (J[2][0] + J[2][1]);
  for (size_t k = 0; k < 3; ++k)
    for (size_t tip = 0; tip < 2; ++tip) {
      gates::report(fmt::format("block that speeds up along its crack: J of {} tip by {} cells over that by 16",
                                tip == 0 ? "first" : "last", s.readings[k].name),
                    J[k][tip] / by_16, "1 +- 0.02");
      EXPECT_NEAR(J[k][tip] / by_16, 1, 0.02);
    }
}

/// At the tips of a crack through the middle of a disk v^2/2 of the spin would make J of rho omega^2 r times the area
/// within the contour, 2700 J/m^2; at rest such a crack has 380 to 510 by its stress.
TEST(MovingBody, SpinsWithoutJOfItsVelocity) {
  constexpr double omega = 4500, density = 1200;
  Scene s = empty_scene(1 * mm, {{-26 * mm, -26 * mm}, {26 * mm, 26 * mm}});
  s.materials = {{"disk", LawKind::linear_elastic, 3e9, 0.33, density}};
  s.plane = Plane::stress;
  s.thickness = 1 * mm;
  s.transfer = Transfer::flip;
  s.bodies = {body("disk", Disk{{0, 0}, 20 * mm})};
  s.bodies[0].spin = omega;
  s.cracks = {crack("centre", {{-6 * mm, 0}, {6 * mm, 0}})};
  s.fracture.asked = true;
  s.fracture.contour = 4;
  s.growth = GrowthRule{};
  s.growth->toughness = 0.05e6;
  s.growth->direction = GrowthDirection::self_similar;
  s.growth->speed_limit = 50;
  s.end_time = 30 * us;
  const ChosenSpace space;
  Simulation m(s, space);
  double most = 0;
  while (!m.finished()) {
    m.step();
    for (const Tip& t : m.state.tips)
      if (t.running)
        most = std::max(most, t.J);
  }
  const double of_velocity = density * omega * omega * 7 * mm * (4 * mm) * (4 * mm);
  gates::report("J of a tip that runs in a disk that spins, over what v^2/2 of the spin makes", most / of_velocity,
                "less than 0.3");
  EXPECT_GT(most, 0);
  EXPECT_LT(most, 0.3 * of_velocity);
}

/// Means of a crack that pressure holds open, from 0.9 to 1 times the end: J of its tips, how far its faces are apart
/// in the middle, and the row of particles beside them; and the strain energy at the end.
struct HeldOpen {
  double J = 0, faces = 0, particles = 0, strain = 0;
};
HeldOpen held_open(double spin, double degrees) {
  Scene s = empty_scene(1 * mm, {{-16 * mm, -16 * mm}, {16 * mm, 16 * mm}});
  s.materials = {{"disk", LawKind::linear_elastic, 2.5e9, 0.33, 1000}};
  s.plane = Plane::stress;
  s.thickness = 1 * mm;
  s.stress_update = StressUpdate::usl;
  s.bodies = {body("disk", Disk{{0, 0}, 12 * mm})};
  s.bodies[0].spin = spin;
  CrackLine line = crack("centre", {{-4 * mm, 0}, {4 * mm, 0}});
  line.traction = TractionSettings{};
  line.traction->kind = TractionKind::pressure;
  line.traction->pressure = TimeFunction{
      5 * MPa, [](double t) { return t < 200 * us ? 0.5 - 0.5 * std::cos(std::numbers::pi * t / (200 * us)) : 1; }, ""};
  s.cracks = {line};
  s.fracture.asked = true;
  s.output.history_every = 20 * us;
  s.end_time = spin > 0 ? degrees * std::numbers::pi / 180 / spin : 600 * us;
  const ChosenSpace space;
  Simulation m(s, space);
  HeldOpen mean;
  long taken = 0;
  while (!m.finished()) {
    m.step();
    const double t = m.state.clock.time;
    if (t < 0.9 * s.end_time)
      continue;
    const Cracks& c = m.state.cracks;
    const int middle = c.points() / 2;
    const Vec2 along = c.plane[middle + 2] - c.plane[middle - 2], across = turned(along) * (1 / norm(along));
    double rows = 0, number = 0;
    for (int i = 0; i < m.state.particles.count(); ++i) {
      const Vec2 first{m.state.particles.x0[0][i], m.state.particles.x0[1][i]};
      if (std::abs(first.x) < 1 * mm && std::abs(first.y) < 0.5 * mm) {
        const double at = dot(Vec2{m.state.particles.x[0][i], m.state.particles.x[1][i]}, across);
        rows += std::abs(at) - std::abs(first.y);
        number += 0.5;
      }
    }
    ++taken;
    mean.faces += dot(c.upper[middle] - c.lower[middle], across);
    mean.particles += rows / number;
    mean.J += 0.5 * (m.state.tips[0].J + m.state.tips[1].J);
  }
  m.take_stock();
  return {mean.J / double(taken), mean.faces / double(taken), mean.particles / double(taken),
          m.state.ledger.energy.strain};
}

/// Faces are moved by what nodes beside them do, which give way further than particles, and strains by what nodes do
/// not see: over some cells these errors add up.
TEST(MovingBody, TurnsWithFacesAndStrainsAtItsParticles) {
  const HeldOpen rest = held_open(0, 0);
  const double by = rest.faces / rest.particles;
  for (const double degrees : {90., 180.}) {
    const HeldOpen turned = held_open(1000, degrees);
    const std::string after = fmt::format("crack held open in a disk after {} degrees: ", degrees);
    gates::report(after + "opening over that of the particles, against that at rest",
                  turned.faces / turned.particles / by, "1 +- 0.035");
    EXPECT_NEAR(turned.faces / turned.particles / by, 1, 0.035);
    gates::report(after + "J over that at rest", turned.J / rest.J, "1 +- 0.2");
    EXPECT_NEAR(turned.J / rest.J, 1, 0.2);
    gates::report(after + "strain energy over that at rest", turned.strain / rest.strain, "1 +- 0.25");
    EXPECT_NEAR(turned.strain / rest.strain, 1, 0.25);
  }
}

}  // namespace
}  // namespace riven
