// Particles that leave, turn over, stand alone or in one row.
#include <numbers>
#include <random>
#include <utility>

#include "kernels/sort_particles.hpp"
#include "kernels/tally.hpp"
#include "tests/spaces.hpp"
#include "tests/stability/gates.hpp"

namespace riven {
namespace {

using namespace test;
using namespace hard_cases;

constexpr double h = 0.125;

double mass_of(const Simulation& m) {
  double sum = 0;
  for (const double mass : m.state.particles.mass)
    sum += mass;
  return sum;
}

/// A block thrown at the open edge stops the run, by the name of a particle; the account up to then is closed.
TEST(LeavingTheGrid, StopsWithAClosedAccount) {
  double momentum = 0, energy = 0, mass = 0, stops = 0, cases = 0;
  for (const StressUpdate update : {StressUpdate::usl, StressUpdate::musl, StressUpdate::usf, StressUpdate::usavg})
    for (const Vec2 v : {Vec2{20, 0}, Vec2{-20, 3}, Vec2{0, 20}, Vec2{-12, -15}}) {
      Scene s = empty_scene(h, {{-4 * h, -4 * h}, {12 * h, 10 * h}});
      s.bodies = {body("block", Rectangle{{0, 0}, {8 * h, 6 * h}})};
      s.bodies[0].velocity = v;
      s.stress_update = update;
      const ChosenSpace space;
      Simulation m(s, space);
      Account account(m);
      const double first = mass_of(m);
      ++cases;
      try {
        run(m, account, 1000);
      } catch (const Error& e) {
        stops += e.code() == Exit::unstable && e.trouble().where.find("particle ") != std::string::npos;
      }
      tally(space, m.plan, m.state);
      momentum = std::max(momentum, m.state.ledger.momentum.error());
      energy = std::max(energy, std::abs(m.state.ledger.energy.relative_error()));
      mass = std::max(mass, std::abs(mass_of(m) / first - 1));
      EXPECT_FALSE(has_nan(m.state.particles));
    }
  between("block thrown off the grid: runs that stop and name a particle, of 16", stops, cases, cases);
  below("block thrown off the grid: momentum account at the stop", momentum, 1e-12);
  below("block thrown off the grid: energy account at the stop", energy, 1e-12);
  below("block thrown off the grid: mass account at the stop", mass, 1e-12);
}

double least_det_F(const Simulation& m) {
  const auto& p = m.state.particles;
  double least = 1e9;
  for (int i = 0; i < p.count(); ++i)
    least = std::min(least, p.F[0][i] * p.F[3][i] - p.F[1][i] * p.F[2][i]);
  return least;
}

/// A neo-Hookean block between plates and smooth walls is pressed together to 0.3 of its height.
TEST(Compression, KeepsDetFPositive) {
  Scene s = empty_scene(h, {{0, -h}, {8 * h, 10 * h}}, LawKind::neo_hookean);
  s.bodies = {body("block", Rectangle{{0, 0}, {8 * h, 8 * h}})};
  s.symmetry = {{0, 0, +1}, {0, 8 * h, -1}, {1, 0, +1}};
  const double speed = 0.02 * wave_speed(s.materials[0]);
  Grip plate;
  plate.name = "plate";
  plate.region = Rectangle{{0, 8 * h}, {8 * h, 9 * h}};
  plate.velocity[1] = {-speed, [](double t) { return std::min(1., t / 0.1); }, ""};
  s.grips = {plate};
  const ChosenSpace space;
  Simulation m(s, space);
  Account account(m);
  double least = 1;
  while (-m.state.constraints.owners.back().travel.y < 0.7 * 8 * h) {
    run(m, account, 10);
    least = std::min(least, least_det_F(m));
  }
  between("block pressed to 0.3 of its height: least det F", least, 1e-3, 0.3);
  expect_kept("block pressed to 0.3 of its height", account, m);
}

/// The particles of one cell are kicked towards its middle, so fast that it would turn inside out: either the run stops
/// there, or no particle is ever inside out.
TEST(InvertedCell, IsCaughtOrPrevented) {
  double least = 1, stopped = 0, wrong = 0, cases = 0;
  for (const auto& [law, update] : {std::pair{LawKind::neo_hookean, StressUpdate::usavg},
                                    {LawKind::linear_elastic, StressUpdate::usavg},
                                    {LawKind::neo_hookean, StressUpdate::usl},
                                    {LawKind::linear_elastic, StressUpdate::usl}})
    for (const double cfl : {0.4, 0.8, 1.5})
      for (const double kick : {0.3, 1., 3., 10., 100.}) {
        Scene s = empty_scene(h, {{-8 * h, -8 * h}, {16 * h, 16 * h}}, law);
        s.stress_update = update;
        s.bodies = {body("block", Rectangle{{0, 0}, {8 * h, 8 * h}})};
        s.cfl = cfl;
        s.fracture.asked = true;  // makes both laws keep F
        s.cracks = {crack("far", {{-6 * h, -6 * h}, {-5 * h, -6 * h}})};
        const ChosenSpace space;
        Simulation m(s, space);
        auto& p = m.state.particles;
        const double c = wave_speed(s.materials[0]);
        const Vec2 middle{4.5 * h, 4.5 * h};
        for (int i = 0; i < p.count(); ++i) {
          const Vec2 r = Vec2{p.x[0][i], p.x[1][i]} - middle;
          if (std::max(std::abs(r.x), std::abs(r.y)) < 0.5 * h) {
            p.v[0][i] = -kick * c * r.x / (0.25 * h);
            p.v[1][i] = -kick * c * r.y / (0.25 * h);
          }
        }
        ++cases;
        try {
          Account account(m);
          for (int n = 0; n < 200; ++n) {
            run(m, account, 1);
            least = std::min(least, least_det_F(m));
            wrong += account.nan;
          }
        } catch (const Error& e) {
          ++stopped;
          wrong += e.code() != Exit::unstable;
        }
      }
  above("cell kicked inwards, 60 kicks: least det F of a run that goes on", least, 0);
  below("cell kicked inwards, 60 kicks: numbers that are none, or other errors", wrong, 1);
  between("cell kicked inwards, 60 kicks: runs stopped", stopped, 1, cases - 1);
}

/// 200 particles, four cells from each other, that fly apart under gravity: none feels another.
TEST(IsolatedParticles, FlyOnTheirOwn) {
  for (const ShapeFunction shape : {ShapeFunction::linear, ShapeFunction::ugimp, ShapeFunction::bspline})
    for (const Transfer transfer : {Transfer::flip, Transfer::xpic, Transfer::fmpm}) {
      const Vec2 g{0.5, -2};
      Scene s = empty_scene(1, {{-60, -60}, {140, 110}});
      s.shape = shape;
      s.transfer = transfer;
      s.bodies = {body("cloud", Rectangle{{0, 0}, {20, 10}})};
      s.bodies[0].particles_per_cell = 1;
      s.body_force[0] = constant(g.x);
      s.body_force[1] = constant(g.y);
      const ChosenSpace space;
      Simulation m(s, space);
      auto& p = m.state.particles;
      ASSERT_EQ(p.count(), 200);
      std::mt19937 random(5);
      std::uniform_real_distribution<double> u(-0.3, 0.3);
      std::vector<Vec2> x(200), v(200);
      for (int i = 0; i < 200; ++i) {
        const auto id = static_cast<size_t>(p.id[i]);
        for (auto* a : {&p.x[0], &p.x[1]})
          (*a)[i] = 4 * (*a)[i] + u(random);
        x[id] = {p.x[0][i], p.x[1][i]};
        v[id] = 0.3 * x[id] + Vec2{u(random), u(random)};
        p.v[0][i] = v[id].x;
        p.v[1][i] = v[id].y;
      }
      sort_particles(space, m.plan, m.state);
      Account account(m);
      double off = 0;
      for (int n = 0; n < 30; ++n) {
        run(m, account, 10);
        const double t = m.state.clock.time;
        for (int i = 0; i < 200; ++i) {
          const auto id = static_cast<size_t>(p.id[i]);
          const Vec2 at{p.x[0][i], p.x[1][i]}, there = x[id] + t * v[id] + 0.5 * t * t * g;
          off = std::max({off, norm(at - there), norm(Vec2{p.v[0][i], p.v[1][i]} - v[id] - t * g) / norm(v[id])});
        }
      }
      const std::string row = fmt::format("200 particles on their own, {}, {}", name_of(shape), name_of(transfer));
      below(row + ": off their parabolas, cells", off, 1e-10);
      expect_kept(row, account, m);
    }
}

/// A strip of one row of particles, its ends free, swings in bending: what alternates from particle to particle must
/// not grow.
TEST(SingleRow, BendsWithoutHourglass) {
  for (const int per_cell : {1, 2})
    for (const Transfer transfer : {Transfer::flip, Transfer::fmpm}) {
      constexpr int cells = 24;
      const double thick = h / per_cell;
      Scene s = empty_scene(h, {{-4 * h, -8 * h}, {(cells + 4) * h, 8 * h}});
      s.transfer = transfer;
      s.bodies = {body("strip", Rectangle{{0, 0}, {cells * h, thick}})};
      s.bodies[0].particles_per_cell = per_cell;
      const ChosenSpace space;
      Simulation m(s, space);
      auto& p = m.state.particles;
      const int count = cells * per_cell;
      ASSERT_EQ(p.count(), count);
      const double speed = 0.01 * wave_speed(s.materials[0]), length = cells * h;
      for (int i = 0; i < count; ++i)
        p.v[1][i] = speed * (std::sin(std::numbers::pi * p.x[0][i] / length) - 2 / std::numbers::pi);
      Account account(m);
      double alternating = 0;
      for (int n = 0; n < 500; ++n) {
        run(m, account, 10);
        Vec2 sum;
        for (int i = 0; i < count; ++i)  // numbered along the strip
          sum += (p.id[i] % 2 ? -1. : 1.) * Vec2{p.v[0][i], p.v[1][i]};
        alternating = std::max(alternating, norm(sum) / count / speed);
      }
      const std::string row =
          fmt::format("strip of one row, {} in a cell, 5000 steps, {}", per_cell, name_of(transfer));
      below(row + ": velocity that alternates, over the first", alternating, 0.1);
      expect_kept(row, account, m);
    }
}

}  // namespace
}  // namespace riven
