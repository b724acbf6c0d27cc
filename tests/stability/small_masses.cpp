// Particles that all but leave a cell, that lie on the edge of one, and that cross many: nodes of next to no mass, and
// the noise of crossings.
#include "kernels/sort_particles.hpp"
#include "tests/program.hpp"
#include "tests/spaces.hpp"
#include "tests/stability/gates.hpp"

namespace riven {
namespace {

using namespace test;
using namespace hard_cases;

constexpr StressUpdate updates[] = {StressUpdate::usl, StressUpdate::musl, StressUpdate::usf, StressUpdate::usavg};
constexpr ShapeFunction shapes[] = {ShapeFunction::linear, ShapeFunction::ugimp, ShapeFunction::bspline};

/// A particle of 1 m on cells of 1 m.
Scene lone_particle(ShapeFunction shape, StressUpdate update) {
  Scene s = empty_scene(1, {{-8, -8}, {16, 8}});
  s.shape = shape;
  s.stress_update = update;
  s.bodies = {body("particle", Rectangle{{0.1, 0.1}, {0.9, 0.9}})};
  s.bodies[0].particles_per_cell = 1;
  s.limits.energy_growth = 1e99;
  return s;
}

void put(Simulation& m, Vec2 x) {
  m.state.particles.x[0][0] = x.x;
  m.state.particles.x[1][0] = x.y;
  sort_particles(m.space, m.plan, m.state);
}

struct Thrown {
  double speed = 0;     ///< m/s, of the fastest node that strains the particle
  double allowed = 0;   ///< m/s, v_p + 4 dt a, with a = stress / (density h)
  double momentum = 0;  ///< error after the step
};

/// A particle under stress at a distance `off` from where a node's weight ends, over one step. A node that it gives the
/// part `off` of its mass bears a force of the stress times the particle's section, however small that part is.
Thrown step_near_an_edge(ShapeFunction shape, StressUpdate update, double off) {
  const Scene s = lone_particle(shape, update);
  const ChosenSpace space;
  Simulation m(s, space);
  const double reach = shape == ShapeFunction::linear ? 1 : 1.5;
  put(m, {reach - off, 0.5});
  auto& p = m.state.particles;
  p.v[0][0] = 1;
  p.stress[0][0] = 1;  // sigma_xx = E / 1000
  m.take_stock();
  Thrown t;
  const auto look = [&](const double* q) {
    for (int n = 0; n < m.state.grid.slots(); ++n)
      if (m.state.grid.mass[n] > 0)
        t.speed = std::max(t.speed, std::hypot(q[4 * n], q[4 * n + 1]));
  };
  const auto after = [&](const char* label, auto array) {
    gates::insert_task(m, label, true, [&look, array](Simulation& sim) { look((sim.state.grid.*array).data()); });
  };
  if (update == StressUpdate::usl)
    after("advance grid", &Grid<double>::q);
  if (update == StressUpdate::usf || update == StressUpdate::usavg)
    after("velocities", &Grid<double>::q);
  if (update == StressUpdate::musl || update == StressUpdate::usavg)
    after("velocities again", &Grid<double>::again);
  try {
    m.step();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), Exit::unstable);
    EXPECT_EQ(update, StressUpdate::usl) << e.what();
  }
  t.allowed = 1 + 4 * m.state.clock.dt * 1;
  m.take_stock();
  t.momentum = m.state.ledger.momentum.error();
  return t;
}

TEST(SmallMass, ThrowsNoNodeButInStressUpdateLast) {
  for (const StressUpdate update : updates) {
    double speed = 0, momentum = 0;
    for (const ShapeFunction shape : {ShapeFunction::linear, ShapeFunction::ugimp})
      for (int k = 2; k <= 10; ++k) {
        const Thrown t = step_near_an_edge(shape, update, std::pow(10, -k));
        speed = std::max(speed, t.speed / t.allowed);
        momentum = std::max(momentum, t.momentum);
      }
    const std::string row = "small nodal mass, 1e-2 to 1e-10, " + std::string(name_of(update));
    if (update == StressUpdate::usl)
      above(row + " (control): fastest node over v_p + 4 a dt", speed, 1e3);
    else
      below(row + ": fastest node over v_p + 4 a dt", speed, 1);
    below(row + ": momentum error", momentum, 1e-12);
  }
}

/// The impact of section 3.4 of J.A. Nairn, CMES 4 (2003) 649-664: a node that only one particle, just come into the
/// cell, touches.
TEST(SmallMass, StopsAnImpactWithStressUpdateLast) {
  const sample::Folder folder;
  const std::string results = (folder / "results").string();
  const Outcome o = riven(
      "run beam_impact --quiet --threads 1 --set output.frames=1 "
      "--set solver.stress_update=usl -o " +
          results,
      folder);
  EXPECT_EQ(o.code, static_cast<int>(Exit::unstable));
  EXPECT_NE(o.errors.find(", particle "), std::string::npos) << o.errors;
  bool reason = false;
  for (const char* why : {"turned inside out", "left the grid", "energy grows", "not a number"})
    reason |= o.errors.find(why) != std::string::npos;
  EXPECT_TRUE(reason) << o.errors;
  const size_t at = o.errors.find("time ");
  ASSERT_NE(at, std::string::npos) << o.errors;
  below("beam under impact, usl (control): stops at, ms (published 3.6)",
        1e3 * std::strtod(o.errors.c_str() + at + 5, nullptr), 1.3 * 3.6);
  EXPECT_TRUE(std::filesystem::exists(folder / "results" / "summary.json"));
}

/// Down to the last bit of a particle's place, past the mass below which nodes are taken to be empty.
TEST(SmallMass, CutOffKeepsMomentum) {
  for (const ShapeFunction shape : shapes) {
    double momentum = 0;
    for (const StressUpdate update : {StressUpdate::musl, StressUpdate::usf, StressUpdate::usavg})
      for (int k = 1; k <= 53; ++k)
        momentum = std::max(momentum, step_near_an_edge(shape, update, std::ldexp(1., -k)).momentum);
    below("mass cut-off, 2^-1 to 2^-53 of a cell, " + std::string(name_of(shape)) + ": momentum error", momentum,
          1e-12);
  }
}

struct Felt {
  double stress = 0, velocity = 0;  ///< over E, over v
};

Felt meet_nodes(Scene s, Vec2 v) {
  s.pic_fraction = 0.5;
  s.materials[0].E = 10;  // waves of 0.1 m/s
  s.dt_max = 0.125;       // a whole number of steps to each node
  const ChosenSpace space;
  Simulation m(s, space);
  put(m, {0, 0});
  auto& p = m.state.particles;
  p.v[0][0] = v.x;
  p.v[1][0] = v.y;
  Felt f;
  for (int n = 0; n < 40; ++n) {
    try {
      m.step();
    } catch (const Error&) {
      f.stress = std::numeric_limits<double>::infinity();
      break;
    }
    EXPECT_EQ(m.state.clock.dt, 0.125);
    f.stress = std::max(f.stress, largest_stress(m, 1000) / 10);
    f.velocity = std::max(f.velocity, norm(Vec2{p.v[0][0], p.v[1][0]} - v));
  }
  return f;
}

/// A particle that meets nodes exactly moves as one that does not; not so where stress is updated last, which no small
/// nodal mass can be trusted with (SmallMass above).
TEST(ParticleOnAnEdge, FeelsNothing) {
  for (const ShapeFunction shape : shapes) {
    Felt most, last;
    for (const StressUpdate update : updates)
      for (const Transfer transfer : {Transfer::flip, Transfer::pic, Transfer::xpic, Transfer::fmpm})
        for (const Vec2 v : {Vec2{1, 0}, Vec2{0.5, 0.25}, Vec2{-1, 1}}) {
          Scene s = lone_particle(shape, update);
          s.transfer = transfer;
          const Felt f = meet_nodes(s, v);
          Felt& of = update == StressUpdate::usl ? last : most;
          of = {std::max(of.stress, f.stress), std::max(of.velocity, f.velocity)};
        }
    const std::string row = "particle exactly on an edge, 5 cells, " + std::string(name_of(shape));
    below(row + ": stress over E", most.stress, 1e-14);
    below(row + ": change of velocity over v", most.velocity, 1e-14);
    note(row + ", usl: stress over E", last.stress);
  }
}

struct Crossed {
  double stress = 0;  ///< root mean square error over the prestress, at its worst
  Account account;
};

/// A bar of 20 cells under prestress, drawn by its grips over 10 cells.
Crossed draw_bar(ShapeFunction shape) {
  constexpr int cells = 20;
  const double h = 1. / cells;
  Scene s = empty_scene(h, {{-0.5, 0}, {2.5, h}});
  s.shape = shape;
  s.materials[0].nu = 0;
  constexpr double prestrain = 1e-3, prestress = 1e6 * prestrain;
  const double v = 0.1 * std::sqrt(1e6 / 1000);
  s.bodies = {body("bar", Rectangle{{0, 0}, {1, h}})};
  s.bodies[0].velocity = {v, 0};
  s.symmetry = {{1, 0, +1}, {1, h, -1}};
  for (const double end : {-h, 1.}) {
    Grip g;
    g.name = end < 0 ? "left" : "right";
    const double at = end < 0 ? end : end * (1 + prestrain);
    g.region = Rectangle{{at, 0}, {at + h, h}};
    g.velocity[0] = constant(v);
    s.grips.push_back(g);
  }
  s.limits.energy_growth = 1e9;
  const ChosenSpace space;
  Simulation m(s, space);
  auto& p = m.state.particles;
  for (int i = 0; i < p.count(); ++i) {
    p.x[0][i] *= 1 + prestrain;
    p.stress[0][i] = prestress / 1000;
    p.J[i] = 1 + prestrain;
  }
  sort_particles(space, m.plan, m.state);
  Crossed r{0, Account(m)};
  while (m.state.clock.time * v < 10 * h) {
    run(m, r.account, 1, 1);
    double sum = 0;
    for (int i = 0; i < p.count(); ++i)
      sum += std::pow(1000 * p.stress[0][i] / prestress - 1, 2);
    r.stress = std::max(r.stress, std::sqrt(sum / p.count()));
  }
  expect_kept("cell crossing, " + std::string(name_of(shape)), r.account, m);
  return r;
}

TEST(CellCrossing, DisturbsTheStressOfLinearFunctionsOnly) {
  below("cell crossing, ugimp: stress error, rms", draw_bar(ShapeFunction::ugimp).stress, 0.05);
  below("cell crossing, bspline: stress error, rms", draw_bar(ShapeFunction::bspline).stress, 0.05);
  above("cell crossing, linear (control): stress error, rms", draw_bar(ShapeFunction::linear).stress, 0.05);
}

}  // namespace
}  // namespace riven
