// Grips that end on a crack, and fixed nodes there: what they move, what friction they feel, and what energy they take.
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

constexpr double length = 20;  // cells, each 1 m

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
  Load top = traction_on(Load::Edge::top, Rectangle{{0, 5}, {length, 6}});
  top.name = "top";
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
                friction, "0.99 to 1.01");
  EXPECT_GT(friction, 0.99) << held_by;
  EXPECT_LT(friction, 1.01) << held_by;
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

/// A block of 20 x 12 cells that hangs between grips at either end of its lower half and bears a load on top: how far
/// its middle sinks (m), and the energy that nothing accounts for, over the largest.
struct Sag {
  double down = 0, unbooked = 0;
};
Sag sag_between_grips(bool cut, Transfer transfer) {
  Scene s = half_gripped(ShapeFunction::ugimp, 0);
  s.transfer = transfer;
  s.order = 2;
  s.contact.law = ContactLaw::stick;
  if (!cut)
    s.cracks.clear();
  s.grips = {grip_at_rest("left", Rectangle{{-2, -6}, {0, 0}}),
             grip_at_rest("right", Rectangle{{length, -6}, {length + 2, 0}})};
  Load top = traction_on(Load::Edge::top, Rectangle{{0, 5}, {length, 6}});
  top.name = "top";
  top.value[1] = TimeFunction{-1e-3 * s.materials[0].E, [](double t) { return std::min(t / 3, 1.); }, ""};
  s.loads = {top};
  s.grid_damping = constant(2);
  s.end_time = 10;
  const ChosenSpace space;
  Simulation m(s, space);
  const auto height = [&] {
    double sum = 0;
    int count = 0;
    for (long i = 0; i < m.state.particles.count(); ++i)
      if (std::abs(m.state.particles.x[0][i] - length / 2) < 2) {
        sum += m.state.particles.x[1][i];
        ++count;
      }
    return sum / count;
  };
  const double first = height();
  while (!m.finished())
    m.step();
  m.take_stock();
  return {first - height(), m.state.ledger.energy.relative_error()};
}

// Faces that stick make one block of two, and give and take no energy, beside grips that hold one of them, too.
TEST(Grips, HoldABlockOfTwoThatStickAsAWholeOne) {
  for (const Transfer transfer : {Transfer::flip, Transfer::xpic}) {
    const Sag whole = sag_between_grips(false, transfer), cut = sag_between_grips(true, transfer);
    gates::report("two halves that stick, the lower one between grips: sag over that of a whole block, less 1",
                  cut.down / whole.down - 1, "0.005");
    gates::report("and energy that nothing accounts for", cut.unbooked, "1e-4");
    ASSERT_GT(whole.down, 0);
    EXPECT_NEAR(cut.down / whole.down, 1, 0.005);
    EXPECT_LT(std::abs(cut.unbooked), 1e-4);
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
