// The figures by which a run is judged while it goes on, each set by hand to what it is then found to be.
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "kernels/tally.hpp"
#include "kernels/watch_figures.hpp"
#include "tests/physics/scenes.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace test;

constexpr double h = 0.125;

Scene cracked_block() {
  Scene s = empty_scene(h, {{-0.5, -0.5}, {1.5, 1.5}});
  s.bodies = {body("block", Rectangle{{0, 0}, {1, 1}})};
  s.cracks = {crack("shut", {{0.2, 0.5}, {0.8, 0.5}}), crack("ignored", {{0.2, 0.7}, {0.8, 0.7}})};
  s.cracks[1].contact = ContactSettings{.law = ContactLaw::ignored};
  s.contact.law = ContactLaw::frictionless;
  return s;
}

Vec2 place(const Simulation& m, long i) {
  return {m.state.particles.x[0][i], m.state.particles.x[1][i]};
}

const Monitor& figure(const Simulation& m, Watched which) {
  return monitor(m.state.monitors, which);
}

TEST(WatchedFigures, AreWhatTheStateHolds) {
  for (const LawKind law : {LawKind::linear_elastic, LawKind::neo_hookean}) {
    Scene s = cracked_block();
    s.materials[0].law = law;
    const ChosenSpace space;
    Simulation m(s, space);
    auto& p = m.state.particles;
    const auto set_J = [&](long i, double J) {
      if (p.J.empty())
        p.F[0][i] = J;
      else
        p.J[i] = J;
    };
    set_J(17, 0.25);
    set_J(40, 1.5);
    if (p.J.empty())
      p.F[1][30] = 2;  // simple shear, of principal stretch 1 + sqrt 2
    Cracks& c = m.state.cracks;
    c.upper[1].y -= 0.1 * h;            // of the crack that contact keeps shut: above has come below
    c.upper[2].y += 0.4 * h;            // open
    c.upper[3] += h * Vec2{1.2, -0.3};  // slid away from what it lay on
    const int free = c.start[1] + 1;
    c.upper[free].y -= 0.7 * h;  // of one whose faces may pass through each other
    tally(space, m.plan, m.state);
    m.state.watch.velocity_difference = 3;
    m.state.ledger.momentum.impulse.x = 7;
    m.state.ledger.momentum.scale = 70;
    m.state.ledger.momentum.torque_impulse = 7;
    m.state.ledger.momentum.angular_scale = 35;
    m.state.ledger.energy.largest = 5;
    m.state.ledger.energy.external_work = m.state.ledger.energy.total() - m.state.ledger.energy.first + 0.1;
    watch_figures(m);
    EXPECT_DOUBLE_EQ(figure(m, Watched::compression).value, 4);
    EXPECT_EQ(figure(m, Watched::compression).place, place(m, 17));
    EXPECT_DOUBLE_EQ(figure(m, Watched::expansion).value, 1.5);
    EXPECT_EQ(figure(m, Watched::expansion).place, place(m, 40));
    EXPECT_NEAR(figure(m, Watched::penetration).value, 0.7, 1e-12);
    EXPECT_EQ(figure(m, Watched::penetration).place, c.plane[free]);
    const Vec2 before = c.plane[free + 1];
    c.plane[free + 1].x += 3 * h;  // a segment of it spans the opening of another crack
    watch_figures(m);
    EXPECT_NEAR(figure(m, Watched::penetration).value, 0.1, 1e-12);
    c.plane[free + 1] = before;
    watch_figures(m);
    EXPECT_NEAR(figure(m, Watched::penetration).value, 0.7, 1e-12);
    c.upper[free].y += 0.7 * h;
    watch_figures(m);
    EXPECT_NEAR(figure(m, Watched::penetration).value, 0.1, 1e-12);
    EXPECT_EQ(figure(m, Watched::velocity_difference).value, 3);
    EXPECT_NEAR(figure(m, Watched::momentum).value, 0.1, 1e-12);
    EXPECT_NEAR(figure(m, Watched::angular_momentum).value, 0.2, 1e-12);
    EXPECT_NEAR(figure(m, Watched::stretch).value, p.J.empty() ? 1 + std::sqrt(2) : 1.5, 1e-12);
    EXPECT_EQ(figure(m, Watched::stretch).place, place(m, p.J.empty() ? 30 : 40));
    EXPECT_NEAR(figure(m, Watched::energy).value, 0.02, 1e-12);
  }
}

TEST(WatchedFigures, CountWhatContactMakesBeyondWhatIsWornDown) {
  const Scene s = cracked_block();
  const ChosenSpace space;
  Simulation m(s, space);
  Energy& e = m.state.ledger.energy;
  e.largest = 5;
  const auto energy_with = [&](double contact, double transfer) {
    e.contact = contact;
    e.transfer = transfer;
    e.external_work = e.total() - e.first + contact + transfer;  // all is accounted for
    watch_figures(m);
    return figure(m, Watched::energy).value;
  };
  EXPECT_NEAR(energy_with(0.2, 0), 0, 1e-12);
  EXPECT_NEAR(energy_with(-0.2, 0), 0.04, 1e-12);
  EXPECT_NEAR(energy_with(-0.2, 0.15), 0.01, 1e-12);
  EXPECT_NEAR(energy_with(-0.2, 0.3), 0, 1e-12);
}

TEST(WatchedFigures, RememberTheWorstAndTheFirstThatWasBeyond) {
  Scene s = cracked_block();
  s.limits.warn[static_cast<size_t>(Watched::expansion)] = 1.2;
  const ChosenSpace space;
  Simulation m(s, space);
  const double values[] = {1.1, 1.3, 1.6, 1.4, 1.1};
  for (int n = 0; n < 5; ++n) {
    m.state.clock.step = 10 * n;
    m.state.particles.J[50 + n] = values[n];
    if (n > 0)
      m.state.particles.J[49 + n] = 1;
    tally(space, m.plan, m.state);
    watch_figures(m);
    EXPECT_EQ(figure(m, Watched::expansion).value, values[n]);
  }
  const Monitor& f = figure(m, Watched::expansion);
  EXPECT_EQ(f.worst, 1.6);
  EXPECT_EQ(f.place, place(m, 52));
  EXPECT_EQ(f.beyond, 3);
  EXPECT_EQ(f.first, 10);
  EXPECT_EQ(f.first_place, place(m, 51));
  EXPECT_EQ(figure(m, Watched::compression).beyond, 0);
}

TEST(WatchedFigures, StopTheRunWhereTheSceneSaysSo) {
  for (const Watched which : {Watched::compression, Watched::velocity_difference}) {
    Scene s = cracked_block();
    s.limits.stop[static_cast<size_t>(which)] = 1.5;
    const ChosenSpace space;
    Simulation m(s, space);
    m.state.particles.v[0][9] = 1;  // the fastest: named where a figure has no place
    m.state.particles.J[9] = 0.5;
    m.state.watch.velocity_difference = 2;
    try {
      m.take_stock();
      FAIL() << "it went on";
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), Exit::unstable);
      EXPECT_EQ(e.trouble().place, place(m, 9));
      EXPECT_TRUE(e.trouble().value.starts_with("2")) << e.what();
      EXPECT_NE(e.trouble().limit.find("1.5 (limits.stop."), std::string::npos) << e.what();
      EXPECT_FALSE(e.trouble().suggestion.empty());
    }
  }
}

/// Bodies that move as one move with the grid; a particle with a velocity of its own does not.
TEST(WatchedFigures, CompareVelocitiesOfParticlesAndGrid) {
  for (const StressUpdate update : {StressUpdate::usl, StressUpdate::usavg}) {
    Scene s = cracked_block();
    s.cracks.clear();
    s.stress_update = update;
    s.bodies[0].velocity = {3, -2};
    const ChosenSpace space;
    Simulation m(s, space);
    m.step();
    EXPECT_LT(m.state.watch.velocity_difference, 1e-13);
    m.begin();
    m.state.particles.v[1][20] += 5;  // of which the grid around it takes some
    m.step();
    EXPECT_GT(m.state.watch.velocity_difference, 3);
    EXPECT_LT(m.state.watch.velocity_difference, 5);
    const double first = m.state.watch.velocity_difference;
    m.state.particles.v[1][20] += 50;
    m.step();
    EXPECT_EQ(m.state.watch.velocity_difference, first) << "looked at now and then";
  }
}

}  // namespace
}  // namespace riven
