// Tractions on the faces of cracks in whole runs: what they keep, and a crack under pressure against its closed form.
#include "core/state/tractions.hpp"

#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <string_view>

#include "tests/physics/scene_gates.hpp"
#include "tests/physics/scenes.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace test;
using std::numbers::pi;

TractionSettings pressure(double value) {
  TractionSettings s;
  s.pressure = constant(value);
  return s;
}

TractionSettings cohesive(TractionKind kind, double strength, double toughness, double peak) {
  TractionSettings s;
  s.kind = kind;
  s.strength = strength;
  s.toughness = toughness;
  s.peak = peak;
  return s;
}

/// A spinning, flying block that draws apart, with crossing cracks of which one ends in the air.
Scene torn_block() {
  Scene s = empty_scene(1. / 8, {{-2, -2}, {5, 3}});
  s.bodies = {body("block", Rectangle{{0, 0}, {1, 0.75}})};
  s.bodies[0].velocity = {1, -0.4};
  s.bodies[0].spin = 1;
  s.cracks = {crack("level", {{-0.3, 0.4}, {0.7, 0.41}}), crack("upright", {{0.45, 0.1}, {0.5, 0.9}})};
  s.contact.law = ContactLaw::ignored;
  s.cracks[0].traction = pressure(2e3);
  s.cracks[1].traction = cohesive(TractionKind::exponential, 1e4, 50, 0.1);
  return s;
}

TEST(Tractions, KeepMomentum) {
  for (const StressUpdate update : {StressUpdate::usl, StressUpdate::musl, StressUpdate::usf, StressUpdate::usavg})
    for (const Transfer transfer : {Transfer::flip, Transfer::xpic, Transfer::fmpm}) {
      Scene s = torn_block();
      s.stress_update = update;
      s.transfer = transfer;
      s.limits.energy_growth = 1;
      const ChosenSpace space;
      Simulation m(s, space);
      auto& p = m.state.particles;
      for (int i = 0; i < p.count(); ++i) {
        p.v[0][i] += 2 * (p.x[0][i] - 0.5);
        p.v[1][i] += 1.5 * (p.x[1][i] - 0.4);
      }
      m.take_stock();
      double most = 0;
      for (int n = 1; n <= 500; ++n) {
        m.step();
        if (n % 50 == 0) {
          m.take_stock();
          most = std::max(most, m.state.ledger.momentum.error());
        }
      }
      EXPECT_LT(most, 1e-12) << name_of(update) << " " << name_of(transfer);
      EXPECT_GT(m.state.ledger.energy.debonding, 0);
      EXPECT_NE(m.state.ledger.energy.external_work, 0);
    }
}

/// A face that lies in the air bears nothing: the area of the crack's points is that of its part in the block.
TEST(Tractions, ActOnTheSolidOnly) {
  const Scene s = torn_block();
  const ChosenSpace space;
  const Simulation m(s, space);
  const Cracks& c = m.state.cracks;
  double area[2] = {0, 0};
  for (int k = 0; k < c.points(); ++k)
    area[c.crack[k]] += face_area(c, k);
  EXPECT_NEAR(area[0], 0.7 * std::hypot(1, 0.01), 0.002);
  EXPECT_NEAR(area[1], 0.65 * std::hypot(0.05 / 0.8, 1), 0.002);
}

/// Nor does one that has drawn away from its part of the solid, as behind a corner that is left, and with it neither
/// does the other face: the nodes around have next to no mass and would be hurled off.
TEST(Tractions, ActOnFacesNextToTheirSolid) {
  Scene s = torn_block();
  s.bodies[0].velocity = {0, 0};
  s.bodies[0].spin = 0;
  s.cracks = {crack("across", {{-0.1, 0.4}, {1.1, 0.4}})};
  s.cracks[0].traction = pressure(2e3);
  const ChosenSpace space;
  for (const auto& [cells, bears] : {std::pair{0., true}, {0.5, true}, {1.15, false}}) {
    Simulation m(s, space);
    Cracks& c = m.state.cracks;
    const int k = c.points() / 2;
    c.upper[k].y -= cells * s.cell;
    m.step();
    EXPECT_EQ(m.point_forces[2 * k].applied, bears) << cells;
    EXPECT_TRUE(m.point_forces[2 * k + 4].applied);
  }
}

/// Half of a square plate of half width w with a crack of half length a in its middle, both in cells of 1 mm.
Scene plate(double a, double w) {
  constexpr double mm = 1e-3;
  Scene s = empty_scene(mm, {{-2 * mm, -(w + 2) * mm}, {(w + 2) * mm, (w + 2) * mm}});
  s.materials = {{"plate", LawKind::linear_elastic, 3e9, 0.33, 1000}};
  s.bodies = {body("plate", Rectangle{{0, -w * mm}, {w * mm, w * mm}})};
  s.symmetry = {{0, 0, +1}};
  s.cracks = {crack("crack", {{-1.5 * mm, 0.2 * mm}, {a * mm, 0.2 * mm}})};
  return s;
}

struct Pressed {
  std::vector<Vec2> opening;                   ///< (place along the crack, normal opening) of each point, m
  double strain = 0, work = 0, potential = 0;  ///< J, per m of thickness
  double kinetic = 0, error = 0;
  Tip tip;  ///< if J was asked for
};

/// The plate under pressure, at rest.
Pressed press(Scene s, double p) {
  const double ramp = 2 * s.grid.upper.x / std::sqrt(3e9 / 1000);
  s.cracks[0].traction = pressure(p);
  s.cracks[0].traction->pressure.shape = [ramp](double t) {
    return t < ramp ? 0.5 * (1 - std::cos(pi * t / ramp)) : 1;
  };
  s.grid_damping = constant(3 / ramp);
  s.end_time = 6 * ramp;
  const ChosenSpace space;
  Simulation m(s, space);
  while (!m.finished())
    m.step();
  m.take_stock();
  Pressed r;
  const Cracks& c = m.state.cracks;
  for (int k = 0; k < c.points(); ++k) {
    if (c.plane0[k].x >= 0)
      r.opening.push_back({c.plane0[k].x, face_opening(c, k).normal});
    r.potential += face_area(c, k) * stored_energy(c, k);
  }
  const Energy& e = m.state.ledger.energy;
  r.strain = e.strain;
  r.work = e.external_work;
  r.kinetic = e.kinetic;
  r.error = std::abs(e.relative_error());
  if (!m.state.tips.empty())
    r.tip = m.state.tips[0];
  return r;
}

constexpr double MPa = 1e6, half_length = 12e-3;

/// A crack grows under its pressure until it has cut a block that flies and spins; the halves draw apart, and their
/// corners leave points of the faces behind.
Scene pressed_block() {
  Scene s = empty_scene(1. / 20, {{-0.5, -0.5}, {1.5, 1.5}});
  s.bodies = {body("block", Rectangle{{0, 0}, {1, 1}})};
  s.bodies[0].velocity = {0.2, 0.1};
  s.bodies[0].spin = 1.2;
  s.plane = Plane::stress;
  s.cracks = {crack("crack", {{0.25, 0.45}, {0.7, 0.6}})};
  s.cracks[0].traction = TractionSettings{};
  s.cracks[0].traction->pressure = {2e3, [](double t) { return std::min(t / 0.025, 1.0); }, ""};
  s.contact.law = ContactLaw::frictionless;
  s.fracture.contour = 6;
  s.growth = GrowthRule{};
  s.growth->toughness = 1.4e3;
  s.growth->speed_limit = 9;  // half the Rayleigh speed: near that a tip may turn back from the edge on so few cells
  return s;
}

TEST(Pressure, DoesNoWorkOnWhatItHasLeftBehind) {
  for (const int contour : {4, 6, 8, 10}) {  // which take the crack different ways
    Scene s = pressed_block();
    s.fracture.contour = contour;
    const ChosenSpace space;
    Simulation m(s, space);
    double worst = 0;
    while (m.state.clock.time < 0.16) {
      m.step();
      m.take_stock();
      worst = std::max(worst, std::abs(m.state.ledger.energy.relative_error()));
    }
    int exits = 0;
    for (const CrackEvent& e : m.state.events)
      exits += e.kind == CrackEvent::Kind::exit;
    EXPECT_EQ(exits, 2);
    EXPECT_LT(worst, 5e-4) << contour;  // 1e-4
  }
}

/// New faces bear the pressure within its region, and not beyond.
TEST(Pressure, StaysInItsRegionAsTheCrackGrows) {
  for (const double right : {0.7, 0.8, 2.}) {  // to the tip, a cell past it, and everywhere
    Scene s = pressed_block();
    s.cracks[0].traction->region = Rectangle{{-1, -1}, {right, 2}};
    s.growth->toughness = 1.2e3;
    const ChosenSpace space;
    Simulation m(s, space);
    const Cracks& c = m.state.cracks;
    while (m.state.tips[1].length < 0.2 && m.state.clock.time < 0.4)
      m.step();
    ASSERT_GE(m.state.tips[1].length, 0.2) << right;
    long grown = 0;
    for (int k = c.start[0]; k < c.start[1]; ++k) {
      if (c.plane0[k].x < 0.71)
        continue;
      ++grown;
      const double reach = 0.025;  // half of a new segment
      if (c.plane0[k].x > right + reach) {
        EXPECT_EQ(face_area(c, k), 0) << right;
      } else if (c.plane0[k].x < right - reach) {
        EXPECT_GT(face_area(c, k), 0) << right;
      }
    }
    EXPECT_GT(grown, 5) << right;
  }
}

/// The faces part as an ellipse, delta = 4 P sqrt(a^2 - x^2) / E' in an infinite plate, times
///   V = -0.071 - 0.535 r + 0.169 r^2 + 0.02 r^3 - 1.071 ln(1 - r) / r,   r = a / w
/// in the middle of a strip (H. Tada, P.C. Paris and G.R. Irwin, The Stress Analysis of Cracks Handbook, 3rd ed., 2.1;
/// a uniform stress that is added to make faces free of it opens nothing). 4 % is half a cell on the length of the
/// crack: the tip is not known better than that.
TEST(Pressure, OpensACrackToAnEllipse) {
  for (const Plane plane : {Plane::strain, Plane::stress}) {
    Scene s = plate(12, 60);
    s.plane = plane;
    const Pressed r = press(s, 3 * MPa);
    const double E = plane == Plane::stress ? 3e9 : 3e9 / (1 - 0.33 * 0.33), w = 0.2;
    const double V = -0.071 - 0.535 * w + 0.169 * w * w + 0.02 * w * w * w - 1.071 * std::log(1 - w) / w;
    const double middle = V * 4 * 3 * MPa * half_length / E;
    const char* name = plane == Plane::stress ? "stress" : "strain";
    gates::report(fmt::format("crack under pressure, plane {}, opening in the middle over the closed form", name),
                  r.opening[0].y / middle, "1 +-4 %");
    EXPECT_NEAR(r.opening[0].y, middle, 0.04 * middle);
    for (const Vec2 o : r.opening)
      if (o.x < 0.9 * half_length) {
        EXPECT_NEAR(o.y, middle * std::sqrt(1 - std::pow(o.x / half_length, 2)), 0.04 * middle) << o.x;
      }
  }
}

/// The potential of the pressure is -P times the area between the faces, W_Z of all points; at rest the strain energy
/// is half of what it has given (Clapeyron). Strain and potential together fall as the crack is made longer: a pressure
/// raises J, to F^2 P^2 pi a / E' with F = 1.055 for a / w = 0.2 in a square plate (Isida, Eng. Fract. Mech. 5 (1973)
/// 647-665; in a long one it is 1.0254).
TEST(Pressure, DrivesTheCrack) {
  const Pressed shorter = press(plate(11, 60), 3 * MPa), longer = press(plate(13, 60), 3 * MPa);
  for (const Pressed& r : {shorter, longer}) {
    EXPECT_LT(r.potential, 0);
    EXPECT_NEAR(r.strain, -0.5 * r.potential, 0.01 * r.strain);
    EXPECT_LT(r.kinetic, 1e-4 * r.strain);
    EXPECT_LT(r.error, 0.01);
    EXPECT_GT(r.work, r.strain);
  }
  const double J = -(longer.strain + longer.potential - shorter.strain - shorter.potential) / 2e-3;
  const double E = 3e9 / (1 - 0.33 * 0.33), exact = std::pow(1.055 * 3 * MPa, 2) * pi * half_length / E;
  gates::report("crack under pressure, energy release rate over the closed form", J / exact, "1 +-5 %");
  EXPECT_NEAR(J, exact, 0.05 * exact);
}

/// The same release rate by the area integral, whatever its contour: what the pressure does on the faces inside belongs
/// to it (Nairn and Aimene, eq. 11), for without that a contour of 16 cells, two thirds of the crack's half length on
/// either side of the tip, would find far less than one of 4.
TEST(Pressure, BelongsToJ) {
  const double E = 3e9 / (1 - 0.33 * 0.33), K = 1.055 * 3 * MPa * std::sqrt(pi * half_length), exact = K * K / E;
  for (const int contour : {4, 16}) {
    Scene s = plate(12, 60);
    s.fracture.asked = true;
    s.fracture.contour = contour;
    s.fracture.area = AreaTerm::never;
    const Tip tip = press(s, 3 * MPa).tip;
    gates::report(fmt::format("crack under pressure, J by {} cells over the closed form", contour), tip.J / exact,
                  "1 +-4 %");
    gates::report(fmt::format("crack under pressure, K_I by the interaction integral, {} cells", contour), tip.M_I / K,
                  "1 +-2 %");
    EXPECT_NEAR(tip.J, exact, 0.04 * exact);
    EXPECT_NEAR(tip.M_I, K, 0.02 * K);
  }
}

/// A bar across whose middle a stiff undamaged law acts, as stiff as a fortieth of a cell of the bar, swings on as if
/// it were whole, at the time step that the law asks for. Forces that act elsewhere than the faces are, by half a cell,
/// lose or gain 5 % of the energy across this crack at a slant to the grid.
TEST(Cohesive, StiffLawsHoldTheirFacesTogetherAtTheirTimeStep) {
  Scene s = empty_scene(1. / 8, {{-1, -1}, {3, 2}});
  s.bodies = {body("bar", Rectangle{{0, 0}, {2, 0.5}})};
  s.cracks = {crack("crack", {{0.97, -0.3}, {1.03, 0.8}})};
  s.cracks[0].traction = cohesive(TractionKind::triangular, 1e6, 1e4, 0.15625);
  const double stiffness = 40 * 1e6 / s.cell;
  const auto swing = [](const Scene& scene) {
    const ChosenSpace space;
    Simulation m(scene, space);
    for (int i = 0; i < m.state.particles.count(); ++i)
      m.state.particles.v[0][i] = 0.1 * std::sin(pi * (m.state.particles.x[0][i] - 1) / 2);
    m.take_stock();
    double error = 0, strain = 0;
    while (m.state.clock.time < 0.3) {
      m.step();
      if (m.state.clock.step % 20 == 0) {
        m.take_stock();
        error = std::max(error, std::abs(m.state.ledger.energy.relative_error()));
        strain = std::max(strain, m.state.ledger.energy.strain);
      }
    }
    EXPECT_EQ(m.state.ledger.energy.debonding, 0);
    return std::array{error, strain, m.state.clock.stable_dt,
                      double(std::string_view(m.state.clock.limiter) == "cohesive law")};
  };
  const auto held = swing(s);
  EXPECT_EQ(held[3], 1);
  EXPECT_DOUBLE_EQ(held[2], s.cfl * std::sqrt(1000 * s.cell / stiffness));
  gates::report("stiff cohesive law, energy error", held[0], "0.02");
  EXPECT_LT(held[0], 0.02);
  Scene whole = s;
  whole.cracks.clear();
  EXPECT_NEAR(held[1], swing(whole)[1], 0.05 * held[1]);
}

}  // namespace
}  // namespace riven
