// What gradients of velocity on particles are for (solver.affine): waves and bending at the frequencies of the
// continuum, bodies that spin without strain, and faces that PIC, XPIC and FMPM keep where they are.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/plan/plan.hpp"
#include "tests/physics/scenes.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace test;
constexpr double pi = std::numbers::pi;

Field field(std::function<double(double X, double Y)> at) {
  return {1, [at](double, long n, const double* X, const double* Y, double* out) {
            for (long i = 0; i < n; ++i)
              out[i] = at(X[i], Y[i]);
          }};
}

/// A free bar of L x H about the origin on cells of 1 m, whose particles start by a velocity of 1 mm/s times `mode`.
Scene swinging_bar(double L, double H, double nu, bool affine, const Field& x, const Field& y) {
  Scene s = empty_scene(1, {{-L / 2 - 4, -H / 2 - 4}, {L / 2 + 4, H / 2 + 4}});
  s.materials[0].nu = nu;
  s.affine = affine;
  s.bodies = {body("bar", Rectangle{{-L / 2, -H / 2}, {L / 2, H / 2}})};
  s.bodies[0].velocity_field[0] = x;
  s.bodies[0].velocity_field[1] = y;
  s.bodies[0].velocity_field[0]->value = s.bodies[0].velocity_field[1]->value = 1e-3;
  return s;
}

/// Period of what the particles' velocities have of those they start with, from the times at which it vanishes.
double period(const Scene& s, int swings) {
  const ChosenSpace space;
  Simulation m(s, space);
  const auto& p = m.state.particles;
  const auto velocities = [&] {
    std::vector<Vec2> v(static_cast<size_t>(p.count()));
    for (int i = 0; i < p.count(); ++i)
      v[static_cast<size_t>(p.id[i])] = {p.v[0][i], p.v[1][i]};
    return v;
  };
  const std::vector<Vec2> first = velocities();
  double before = 1, start = 0;
  for (int found = 0;;) {
    m.step();
    double now = 0;
    const std::vector<Vec2> v = velocities();
    for (size_t i = 0; i < v.size(); ++i)
      now += dot(v[i], first[i]);
    if (now * before < 0) {
      const double at = m.state.clock.time - m.state.clock.dt * now / (now - before);
      if (found == 0)
        start = at;
      if (found++ == 2 * swings)
        return (at - start) / swings;
    }
    before = now;
  }
}

// A free bar without Poisson's ratio swings along itself by sin(pi X / L) with the period 2 L sqrt(rho / E).
TEST(VelocityGradient, BringsABarsFrequencyFourTimesAsNear) {
  constexpr double L = 8;
  const auto error = [&](bool affine) {
    const Scene s = swinging_bar(L, 4, 0, affine, field([=](double X, double) { return std::sin(pi * X / L); }),
                                 field([](double, double) { return 0; }));
    return period(s, 2) / (2 * L / std::sqrt(s.materials[0].E / s.materials[0].density)) - 1;
  };
  const double with = error(true), without = error(false);
  RecordProperty("with", std::to_string(with));
  RecordProperty("without", std::to_string(without));
  EXPECT_NEAR(with, 0, 0.007);
  EXPECT_GT(without, 3 * with);
}

// A free beam eight times as long as thick, in its first mode of bending by Bernoulli and Euler. Finer cells
// give 1.0549 of that theory's period (with gradients 1.0550 by 8 cells in the thickness and 1.0547 by 4,
// without 1.0575 and 1.0651, whose limit is 1.0549); here the thickness is two cells.
TEST(VelocityGradient, BendsABeamOfTwoCells) {
  constexpr double H = 2, L = 8 * H, b = 4.730040744862704;
  const auto shape = [](double z) { return std::cos(z) / std::cos(b / 2) + std::cosh(z) / std::cosh(b / 2); };
  const auto slope = [](double z) { return -std::sin(z) / std::cos(b / 2) + std::sinh(z) / std::cosh(b / 2); };
  const auto found = [&](bool affine) {
    const Scene s =
        swinging_bar(L, H, 0.3, affine, field([&](double X, double Y) { return -Y * b / L * slope(b * X / L); }),
                     field([&](double X, double) { return shape(b * X / L); }));
    const Material& m = s.materials[0];
    const double stiffness = m.E / (1 - m.nu * m.nu) * H * H / 12 / m.density;
    return period(s, 1) / (2 * pi * L * L / (b * b * std::sqrt(stiffness)));
  };
  EXPECT_NEAR(found(true), 1.0549, 0.005);
  EXPECT_GT(found(false), 1.0549 + 0.03);
}

struct Spun {
  double strain, lost, angular;  ///< of the first kinetic energy; error of the angular momentum
};

/// A disk of 10 cells' radius, whose rim moves at 2 % of its wave speed, turned by 45 degrees.
Spun spin(StressUpdate update, Transfer transfer, bool affine) {
  Scene s = empty_scene(1, {{-13, -13}, {13, 13}}, LawKind::neo_hookean);
  s.stress_update = update;
  s.transfer = transfer;
  s.order = 2;
  s.affine = affine;
  s.limits.energy_growth = 1;
  s.bodies = {body("disk", Disk{{0, 0}, 10})};
  s.bodies[0].spin = 0.002 * std::sqrt(s.materials[0].E * 1.35 / s.materials[0].density);
  s.end_time = pi / 4 / s.bodies[0].spin;
  const ChosenSpace space;
  Simulation m(s, space);
  m.take_stock();
  const double first = m.state.ledger.energy.kinetic;
  while (m.state.clock.time < s.end_time * (1 - 1e-12))
    m.step();
  m.take_stock();
  const Energy& e = m.state.ledger.energy;
  return {e.strain / first, 1 - (e.kinetic + e.strain) / first, m.state.ledger.momentum.angular_error()};
}

// Centripetal stress has 1e-4 of the kinetic energy.
TEST(VelocityGradient, LetsADiskSpinWithoutStrain) {
  for (const StressUpdate update : {StressUpdate::usl, StressUpdate::musl, StressUpdate::usf, StressUpdate::usavg})
    for (const Transfer transfer : {Transfer::flip, Transfer::fmpm}) {
      const Spun with = spin(update, transfer, true);
      EXPECT_LT(with.strain, 4e-4) << name_of(update) << " " << name_of(transfer);
      EXPECT_LT(with.lost, 1e-3) << name_of(update) << " " << name_of(transfer);
      EXPECT_LT(with.angular, 1e-3) << name_of(update) << " " << name_of(transfer);
    }
  EXPECT_GT(spin(StressUpdate::usavg, Transfer::flip, false).strain, 1e-3);
  EXPECT_GT(spin(StressUpdate::usavg, Transfer::fmpm, false).lost, 0.02);
}

// A bar of 8 cells with an interface in its middle, pulled slowly, grows by sigma (L/E + 1/D), to 2 % with FLIP, which
// takes no velocity of the grid. FMPM takes those of nodes beside the faces.
TEST(VelocityGradient, KeepsTheStiffnessOfAnInterfaceByFmpm) {
  const auto error = [](Transfer transfer, bool affine) {
    Scene s = empty_scene(1, {{-8, -4}, {8, 4}});
    s.materials[0].nu = 0;
    s.bodies = {body("bar", Rectangle{{-4, -1}, {4, 1}})};
    s.cracks = {crack("cut", {{0.5, -1}, {0.5, 1}})};
    const double D = s.materials[0].E, stress = 1e-3 * D;
    s.contact = {ContactLaw::interface, 0, D, D};
    s.transfer = transfer;
    s.order = 2;
    s.affine = affine;
    s.grid_damping = constant(8);
    for (const bool right : {false, true}) {
      Load load = traction_on(right ? Load::Edge::right : Load::Edge::left, s.bodies[0].region);
      load.value[0] = TimeFunction{right ? stress : -stress, [](double t) { return std::min(1., t / 2); }, ""};
      s.loads.push_back(load);
    }
    const ChosenSpace space;
    Simulation m(s, space);
    const auto ends = [&](const Simulation& now) {
      const auto& p = now.state.particles;
      double sum = 0;
      for (int i = 0; i < p.count(); ++i)
        if (p.id[i] == 0 || p.id[i] == p.count() - 1)
          sum += p.id[i] == 0 ? -p.x[0][i] : p.x[0][i];
      return sum;
    };
    const double first = ends(m);
    while (m.state.clock.time < 4)
      m.step();
    return (ends(m) - first) / (stress / D * (std::abs(first) + 1)) - 1;
  };
  const double flip = error(Transfer::flip, false);
  EXPECT_NEAR(flip, 0, 0.02);
  EXPECT_NEAR(error(Transfer::fmpm, true), flip, 0.003);
  EXPECT_GT(error(Transfer::fmpm, false), flip + 0.02);
}

TEST(VelocityGradient, IsNotOfLinearFunctions) {
  Scene s = swinging_bar(8, 4, 0, true, {}, {});
  EXPECT_NO_THROW(make_plan(s));
  s.shape = ShapeFunction::linear;
  try {
    make_plan(s);
    FAIL() << "no kernel has moments of linear functions";
  } catch (const Error& e) {
    EXPECT_EQ(e.trouble().code, Exit::bad_input);
    EXPECT_NE(e.trouble().suggestion.find("ugimp"), std::string::npos);
  }
}

}  // namespace
}  // namespace riven
