// Faces held by stiff springs: imperfect interfaces and cohesive laws, up to a million times as stiff as a cell.
#include <numbers>

#include "core/state/tractions.hpp"
#include "tests/spaces.hpp"
#include "tests/stability/gates.hpp"

namespace riven {
namespace {

using namespace test;
using namespace hard_cases;

constexpr double h = 0.125, E = 1e6;

/// A bar of 8 x 2 cells with a cut in the middle that ends `beyond` its edges, m; no Poisson's ratio.
Scene cut_bar(double beyond) {
  Scene s = empty_scene(h, {{-8 * h, -4 * h}, {16 * h, 6 * h}});
  s.materials[0].nu = 0;
  s.bodies = {body("bar", Rectangle{{0, 0}, {1, 2 * h}})};
  s.cracks = {crack("cut", {{0.51, -beyond}, {0.51, 2 * h + beyond}})};
  return s;
}

void pull(Scene& s, double stress) {
  for (const bool right : {false, true}) {
    Load load = traction_on(right ? Load::Edge::right : Load::Edge::left, s.bodies[0].region);
    load.value[0] = TimeFunction{right ? stress : -stress, [](double t) { return std::min(1., t / 0.2); }, ""};
    s.loads.push_back(load);
  }
}

/// Drawn past the edges it bears no more than what lies in the bar.
TEST(StiffInterface, JumpsByTheStressOverItsStiffness) {
  struct Case {
    double ratio, beyond;
  };
  for (const auto& [ratio, beyond] : {Case{1, 0}, {1, 2 * h}, {1e2, 0}, {1e2, 2 * h}, {1e4, 0}}) {
    const double D = ratio * E / h, stress = 1e-3 * E;
    Scene s = cut_bar(beyond);
    s.contact = {ContactLaw::interface, 0, D, D};
    s.grid_damping = constant(60);
    pull(s, stress);
    const ChosenSpace space;
    Simulation m(s, space);
    Account account(m);
    while (m.state.clock.time < 1)
      run(m, account, 10);
    double jump = 0, length = 0;
    const Cracks& c = m.state.cracks;
    for (int k = 0; k + 1 < c.points(); ++k) {
      const double inside = std::min(c.plane[k + 1].y, 2 * h) - std::max(c.plane[k].y, 0.);
      if (inside > 0) {
        jump += inside * c.jump[k].x;
        length += inside;
      }
    }
    const double off = std::abs(jump / length * D / stress - 1);
    const std::string row = fmt::format("interface of {:g} E/h, {:g} cells past the edges", ratio, beyond / h);
    below(row + ", at rest: jump beside stress over stiffness", off, 0.01);
    expect_kept(row + ", at rest", account, m);
  }
}

/// Without damping the bar swings on; the same spring by the explicit update, which takes the opening at the start of
/// the step for all of it, grows without bound.
TEST(StiffInterface, DoesNotGrowWhereTheNaiveOneDoes) {
  const double D = 1e4 * E / h;
  Scene s = cut_bar(0);
  s.contact = {ContactLaw::interface, 0, D, D};
  s.limits.energy_growth = 1e9;
  const ChosenSpace space;
  Simulation m(s, space);
  for (int i = 0; i < m.state.particles.count(); ++i)
    m.state.particles.v[0][i] = 0.1 * (m.state.particles.x[0][i] - 0.5);
  Account account(m);
  run(m, account, 2000);
  expect_kept("interface of 1e4 E/h, swinging for 2000 steps", account, m);
  // two nodes of half a cell each on either side of the cut
  const double dt = m.state.clock.dt, reduced = 1000 * h / 4, phase2 = D * dt * dt / reduced;
  double u = 1e-6, opening = 0;
  for (int n = 0; n < 50; ++n) {
    u += phase2 * opening / dt;
    opening -= dt * u;
  }
  above("interface of 1e4 E/h, naive explicit update (control): growth in 50 steps", std::abs(u) / 1e-6, 1e3);
}

struct Parted {
  double dissipated = 0;  ///< by the law, over the toughness
  double lost = 0;        ///< work that is not found again, over the toughness
  double limit = 0;       ///< 1 when the law limited the time step in all of them
  double strongest = 0;   ///< traction of the faces over the strength
  double gave_back = 0;   ///< largest fall of the dissipated energy, over all of it
  double error = 0;       ///< Energy::relative_error
};

/// Pulls a bar at its ends until it has parted and beyond.
Parted part(const Scene& s, double way) {
  const ChosenSpace space;
  Simulation m(s, space);
  m.take_stock();
  const Cohesive law(*s.cracks[0].traction);
  const Cracks& c = m.state.cracks;
  double area = 0;
  for (int k = 0; k < c.points(); ++k)
    area += face_area(c, k);
  Parted r;
  r.limit = 1;
  double before = 0;
  const double parting = area * law.toughness.normal;
  while (m.state.constraints.owners[1].travel.x - m.state.constraints.owners[0].travel.x < way) {
    m.step();
    if (m.state.clock.step % 20 == 0) {
      m.take_stock();
      r.error = std::max(r.error, std::abs(m.state.ledger.energy.relative_error()));
    }
    if (std::string(m.state.clock.limiter) != "cohesive law")
      r.limit = 0;
    for (int k = 0; k < c.points(); ++k)
      if (face_area(c, k) > 0)
        r.strongest = std::max(r.strongest, norm(traction_on(c, k)) / law.strength.normal);
    r.gave_back = std::max(r.gave_back, (before - m.state.ledger.energy.debonding) / parting);
    before = m.state.ledger.energy.debonding;
  }
  m.take_stock();
  const Energy& e = m.state.ledger.energy;
  r.dissipated = e.debonding / parting;
  r.lost = (e.external_work - e.kinetic - e.strain - e.cohesive) / parting;
  return r;
}

void grip_ends(Scene& s, double length, double height, double cell, double speed, double rise) {
  for (const bool right : {false, true}) {
    Grip g;
    g.name = right ? "right" : "left";
    g.region = right ? Rectangle{{length, 0}, {length + cell, height}} : Rectangle{{-cell, 0}, {0, height}};
    g.velocity[0] = {right ? speed : -speed,
                     [rise](double t) { return t < rise ? 0.5 * (1 - std::cos(std::numbers::pi * t / rise)) : 1; }, ""};
    s.grips.push_back(g);
  }
}

TEST(StiffCohesion, DissipatesItsToughnessAtItsTimeStep) {
  for (const double ratio : {1e3, 1e4, 1e5, 1e6}) {
    Scene s = cut_bar(h);
    s.contact.law = ContactLaw::ignored;
    TractionSettings law;
    law.kind = TractionKind::triangular;
    law.strength = 1e-3 * E;
    const double critical = 0.02 * h;
    law.toughness = 0.5 * law.strength * critical;
    law.peak = law.strength / (ratio * E / h) / critical;
    s.cracks[0].traction = law;
    grip_ends(s, 1, 2 * h, h, 0.002 * std::sqrt(E / 1000), 0.2);
    const Parted r = part(s, 4 * critical);
    const std::string row = fmt::format("cohesive law of {:g} E/h", ratio);
    above(row + ": steps that it limited, 1 for all", r.limit, 0.5);
    between(row + ": dissipated over the toughness", r.dissipated, 0.97, 1.03);
    between(row + ": energy not found again over the toughness", r.lost, 0.97, 1.03);
  }
}

/// FLIP keeps what faces and the particles beside them do to each other between nodes. Beside a cut through the middle
/// of a cell the nodes that pull are not those by which the faces move: by accelerations that are not fitted this bar
/// makes twice its energy.
TEST(StiffCohesion, SwingsWithoutGain) {
  struct Case {
    StressUpdate update;
    ContactLaw contact;
  };
  for (const auto& [update, contact] :
       {Case{StressUpdate::musl, ContactLaw::ignored}, Case{StressUpdate::usf, ContactLaw::ignored},
        Case{StressUpdate::usavg, ContactLaw::ignored}, Case{StressUpdate::usavg, ContactLaw::frictionless}}) {
    Scene s = cut_bar(2 * h);
    s.transfer = Transfer::flip;
    s.stress_update = update;
    s.contact.law = contact;
    for (Vec2& x : s.cracks[0].points)
      x.x = 4.5 * h;
    TractionSettings law;
    law.kind = TractionKind::triangular;
    law.peak = 0.5;
    law.strength = law.shear_strength = 0.1 * E;
    law.toughness = law.shear_toughness = law.strength * law.strength * h / (6 * E * 2 * law.peak);  // 6 E/h
    s.cracks[0].traction = law;
    s.limits.energy_growth = 1e9;
    const ChosenSpace space;
    Simulation m(s, space);
    auto& p = m.state.particles;
    for (int i = 0; i < p.count(); ++i)
      p.v[0][i] = 0.01 * (p.x[0][i] - 0.5);
    Account account(m);
    run(m, account, 6000);
    const std::string row = fmt::format("cohesive law of 6 E/h, {}, {}, swinging", name_of(update), name_of(contact));
    if (contact == ContactLaw::ignored)  // else it takes what the faces lose as they bounce
      expect_kept(row, account, m);
    below(row + ": energy made", account.gained, 0.05);
  }
}

/// A bar of concrete, longer than 2 E G / f^2, gives way faster than its ends are drawn: it snaps, and what it held
/// more than the faces take runs away as waves.
TEST(SnapBack, PartsAtItsStrengthWithoutGain) {
  constexpr double modulus = 30e9, strength = 3e6, toughness = 100, cell = 0.02;
  constexpr int cells = 50;
  static_assert(cells * cell > 1.4 * 2 * modulus * toughness / (strength * strength));
  for (const double speed : {0.005, 0.05, 0.5}) {  // of either end, m/s
    Scene s = empty_scene(cell, {{-0.2, -0.1}, {1.2, 0.14}});
    s.materials = {{"concrete", LawKind::linear_elastic, modulus, 0, 2400}};
    s.bodies = {body("bar", Rectangle{{0, 0}, {1, 2 * cell}})};
    s.cracks = {crack("cut", {{0.507, -cell}, {0.507, 3 * cell}})};
    s.contact.law = ContactLaw::ignored;
    TractionSettings law;
    law.kind = TractionKind::triangular;
    law.strength = strength;
    law.toughness = toughness;
    s.cracks[0].traction = law;
    grip_ends(s, 1, 2 * cell, cell, speed, 1e-3);
    const Parted r = part(s, 3e-4);
    const std::string row = fmt::format("snap-back of a bar of 1.5 x 2 E G / f^2, {:g} m/s", 2 * speed);
    between(row + ": peak over the strength", r.strongest, 0.97, 1.03);
    between(row + ": dissipated over the toughness", r.dissipated, 0.97, 1.03);
    below(row + ": fall of what damage has taken", r.gave_back, 1e-12);
    below(row + ": energy error", r.error, 0.03);
  }
}

}  // namespace
}  // namespace riven
