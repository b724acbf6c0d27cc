// A bar between two grips that pull it or push it together: its stress against that of a bar of its length. Grips that
// end on a crack, and fixed nodes there: what they move, and what friction they feel.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/physics/scene_gates.hpp"
#include "tests/physics/scenes.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace test;

constexpr double length = 20, height = 6;  // cells, each 1 m

/// Either end moves outwards by `way` (m) in 4 s, in which sound runs to and fro three times, and comes to rest.
Scene gripped_bar(double way) {
  Scene s = empty_scene(1, {{-6, -4}, {length + 6, height + 4}});
  s.materials[0].nu = 0;
  s.bodies = {body("bar", Rectangle{{0, 0}, {length, height}})};
  const auto shape = [](double t) { return t < 4 ? 0.25 * (1 - std::cos(0.5 * std::numbers::pi * t)) : 0; };
  for (const bool right : {false, true}) {
    Grip g;
    g.name = right ? "right" : "left";
    g.region = right ? Rectangle{{length, 0}, {length + 2, height}} : Rectangle{{-2, 0}, {0, height}};
    g.velocity[0] = TimeFunction{right ? way : -way, shape, ""};
    s.grips.push_back(g);
  }
  s.grid_damping = constant(5);
  s.end_time = 8;
  return s;
}

/// Of the stress in the middle third, relative to E ln(1 + 2 way / length).
double stress_error(double way) {
  const Scene s = gripped_bar(way);
  const ChosenSpace space;
  Simulation m(s, space);
  while (!m.finished())
    m.step();
  const auto& p = m.state.particles;
  double sum = 0;
  int count = 0;
  for (long i = 0; i < p.count(); ++i)
    if (std::abs(p.x[0][i] - length / 2) < length / 6) {
      sum += p.stress[0][i] * s.materials[0].density;
      ++count;
    }
  return sum / count / (s.materials[0].E * std::log1p(2 * way / length)) - 1;
}

// Of what a grip moves by past a grid line, the bar is longer, and softer, up to a tenth of a cell; beyond that it is
// shorter by what is left of the cell.
TEST(Grips, HoldABarAtItsEnds) {
  for (const auto& [way, limit] : {std::pair{0.01, 0.002}, {0.1, 0.02}, {0.3, 0.05}, {0.6, 0.05}})
    for (const double sign : {1., -1.}) {
      const double error = stress_error(sign * way);
      gates::report(fmt::format("bar of 20 cells between two grips that move {} cells {}: stress, less 1", way,
                                sign > 0 ? "apart" : "together"),
                    error, fmt::format("{}", limit));
      EXPECT_LT(std::abs(error), limit) << way;
    }
}

/// 20 x 12 cells, each 1 m, cut along the middle, and a grip at the left edge of the lower half that ends `over` the
/// crack.
Scene half_gripped(ShapeFunction shape, double over) {
  Scene s = empty_scene(1, {{-6, -10}, {length + 6, 10}});
  s.shape = shape;
  s.bodies = {body("block", Rectangle{{0, -6}, {length, 6}})};
  s.cracks = {crack("middle", {{0, 0}, {length, 0}})};
  s.contact.law = ContactLaw::ignored;
  Grip g;
  g.name = "hammer";
  g.region = Rectangle{{-4, -6}, {0, over}};
  g.velocity[0] = constant(0.1);
  s.grips = {g};
  s.end_time = 0.3;
  return s;
}

struct Halves {
  double largest[2] = {}, mean[2] = {};  ///< m/s, velocity of the particles above and below the crack, and that along x
};

Halves halves_moved(const Scene& s, double crack_at) {
  const ChosenSpace space;
  Simulation m(s, space);
  std::vector<int> half(static_cast<size_t>(m.state.particles.count()));  // by id
  const auto& p = m.state.particles;
  for (long i = 0; i < p.count(); ++i)
    half[static_cast<size_t>(p.id[i])] = p.x[1][i] < crack_at;
  while (!m.finished())
    m.step();
  Halves h;
  for (long i = 0; i < p.count(); ++i) {
    const int at = half[static_cast<size_t>(p.id[i])];
    h.largest[at] = std::max({h.largest[at], std::abs(p.v[0][i]), std::abs(p.v[1][i])});
    h.mean[at] += 2 * p.v[0][i] / static_cast<double>(p.count());
  }
  return h;
}

TEST(Grips, MoveTheFaceOnTheirOwnSideOfACrackAlone) {
  for (const ShapeFunction shape : {ShapeFunction::linear, ShapeFunction::ugimp, ShapeFunction::bspline})
    for (const auto& [over, at] : {std::pair{-0.5, 0.}, {0., 0.}, {0.3, 0.4}})
      for (const bool reversed : {false, true}) {
        Scene s = half_gripped(shape, over);
        s.cracks[0].points = {{0, at}, {length, at}};
        if (reversed)
          std::swap(s.cracks[0].points[0], s.cracks[0].points[1]);
        const Halves h = halves_moved(s, at);
        EXPECT_EQ(h.largest[0], 0) << name_of(shape) << ", up to " << over << ", crack at " << at;
        EXPECT_GT(h.mean[1], 0.01) << name_of(shape) << ", up to " << over << ", crack at " << at;
      }
}

TEST(Grips, MoveBothFacesOfABondedCrack) {
  Scene bonded = half_gripped(ShapeFunction::ugimp, 0), whole = bonded;
  bonded.contact.law = ContactLaw::bonded;
  whole.cracks.clear();
  const Halves a = halves_moved(bonded, 0), b = halves_moved(whole, 0);
  for (int half = 0; half < 2; ++half)
    EXPECT_NEAR(a.mean[half], b.mean[half], 1e-3 * b.mean[half]);
}

/// The halves of a block of 20 x 12 cells, pressed together, are pushed over each other by grips at their sides,
/// or the lower one is held by lines of nodes that end on the crack: what holds them back is the friction
/// coefficient times the load, 0.3 times the pressure times 20 m.
Scene shear_box(bool fixed_nodes, double at, double pressure) {
  Scene s = half_gripped(ShapeFunction::ugimp, 0);
  s.cracks[0].points = {{0, at}, {length, at}};
  s.contact.law = ContactLaw::coulomb;
  s.contact.friction = 0.3;
  s.grips.clear();
  const auto from = [](double start) { return [start](double t) { return std::clamp((t - start) / 4, 0., 1.); }; };
  for (const bool upper : {true, false})  // where both reach, the lower ones hold
    for (const bool right : {false, true}) {
      const std::string name = fmt::format("{} {}", upper ? "upper" : "lower", right ? "right" : "left");
      const double x = right ? length : -2;
      if (!upper && fixed_nodes) {
        const double line = right ? length : 0;
        s.fixed.push_back({name, {{line, -6}, {line, at}}, {constant(0), std::nullopt}});
        continue;
      }
      Grip g;
      g.name = name;
      g.region = Rectangle{{x, upper ? at : -6}, {x + 2, upper ? 6 : at}};
      g.velocity[0] = upper ? TimeFunction{0.04, from(4), ""} : constant(0);
      s.grips.push_back(g);
    }
  Grip floor;
  floor.name = "floor";
  floor.region = Rectangle{{0, -8}, {length, -6}};
  floor.velocity[1] = constant(0);
  s.grips.push_back(floor);
  Load top;
  top.name = "top";
  top.kind = Load::Kind::traction;
  top.edge = Load::Edge::top;
  top.region = Rectangle{{0, 5}, {length, 6}};
  top.value[1] = TimeFunction{-pressure, from(0), ""};
  s.loads = {top};
  s.grid_damping = constant(5);
  s.end_time = 14;
  return s;
}

void expect_friction(const char* held_by, bool fixed_nodes, double at, double pressure) {
  const Scene s = shear_box(fixed_nodes, at, pressure);
  const ChosenSpace space;
  Simulation m(s, space);
  double impulse = 0, since = 0;
  while (!m.finished()) {
    m.step();
    const Clock& c = m.state.clock;
    if (c.time < 10)
      continue;
    since += c.dt;
    for (const ConstraintOwner& o : m.state.constraints.owners)
      impulse -= o.name.starts_with("lower") ? c.dt * o.reaction.x : 0;
  }
  const double friction = impulse / since / (0.3 * pressure * length);
  gates::report(fmt::format("shear box, its lower half held by {}: force on it over friction times load", held_by),
                friction, "0.95 to 1.02");
  EXPECT_GT(friction, 0.95) << held_by;
  EXPECT_LT(friction, 1.02) << held_by;
}

// A crack that begins just above a row of a grip's particles sinks below it under the load.
TEST(Grips, ShearABlockAlongACrack) {
  expect_friction("grips", false, 0, 1e3);
  expect_friction("grips that the crack sinks past", false, 0.258, 3e3);
  expect_friction("nodes", true, 0, 1e3);
}

/// Two grips at the left edge, above and below the crack, close on it and come back: faces whose motion is given do not
/// act on each other, and no stress stays.
TEST(Grips, LeaveNothingWhereTheyPressedFacesTogether) {
  Scene s = half_gripped(ShapeFunction::ugimp, 0);
  s.contact.law = ContactLaw::frictionless;
  s.grips.clear();
  for (const bool upper : {false, true}) {
    Grip g;
    g.name = upper ? "upper" : "lower";
    g.region = upper ? Rectangle{{-2, 0}, {0, 2}} : Rectangle{{-2, -2}, {0, 0}};
    g.velocity[1] = TimeFunction{upper ? -0.01 : 0.01,
                                 [](double t) { return t < 8 ? std::sin(2 * std::numbers::pi * t / 8) : 0; }, ""};
    s.grips.push_back(g);
  }
  s.grid_damping = constant(5);
  s.end_time = 10;
  const ChosenSpace space;
  Simulation m(s, space);
  double most = 0, most_reaction = 0;
  while (!m.finished()) {
    m.step();
    m.take_stock();
    most = std::max(most, m.state.ledger.energy.strain);
    most_reaction = std::max(most_reaction, std::abs(m.state.constraints.owners[1].reaction.y));
  }
  const Energy& e = m.state.ledger.energy;
  gates::report("grips that closed on a crack: strain energy that stays, over the most", e.strain / most, "0.01");
  gates::report("and energy that grips caught", e.capture / most, "0 +-0.01");
  ASSERT_GT(most_reaction, 0);
  EXPECT_LT(e.strain, 0.01 * most);
  EXPECT_LT(std::abs(e.capture), 0.01 * most);
}

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
  Load top;
  top.name = "top";
  top.kind = Load::Kind::traction;
  top.edge = Load::Edge::top;
  top.region = Rectangle{{0, 9}, {length, 10}};
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
TEST(Grips, DoNotGiveWayToFacesThatPressOnThem) {
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

/// Lines of nodes on a crack, on either side of it, and across it: the fields that they hold are seen by what moves.
TEST(FixedNodes, HoldTheFacesOnWhoseSideTheyLie) {
  const auto moved = [](Rectangle box) {
    Scene s = half_gripped(ShapeFunction::ugimp, 0);
    s.grips.clear();
    s.fixed = {{"line", box, {constant(0.1), std::nullopt}}};
    const Halves h = halves_moved(s, 0);
    return std::pair{h.mean[0] > 0.003, h.mean[1] > 0.003};
  };
  EXPECT_EQ(moved({{0, -6}, {0, 0}}), std::pair(false, true));
  EXPECT_EQ(moved({{0, 0}, {0, 6}}), std::pair(true, false));
  EXPECT_EQ(moved({{0, -6}, {0, 6}}), std::pair(true, true));
  EXPECT_EQ(moved({{0, 0}, {length, 0}}), std::pair(true, true));
  EXPECT_EQ(moved({{0, 0}, {0, 0}}), std::pair(true, true));
}

}  // namespace
}  // namespace riven
