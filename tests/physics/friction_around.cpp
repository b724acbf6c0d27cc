// A slanted crack under a pressure all around and a shear that comes later: friction that can bear the shear holds it
// as if there were no crack, and friction that cannot leaves it K_II = (1 - mu sigma / tau) times that of free faces,
// with sigma what presses and tau what shears along it (J.B. Walsh, J. Geophys. Res. 70 (1965) 399-411).
#include "kernels/friction_around.hpp"

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

constexpr double mm = 1e-3, us = 1e-6, MPa = 1e6;

double risen(double t, double over) {
  return 0.5 - 0.5 * std::cos(std::numbers::pi * std::clamp(t / over, 0., 1.));
}

/// Cells of 1 mm.
Scene pressed_and_sheared(double pressure, double shear, double mu, Transfer transfer, std::vector<Vec2> points) {
  const double half = 20 * mm;
  Scene s = empty_scene(mm, {{-24 * mm, -24 * mm}, {24 * mm, 24 * mm}});
  s.materials = {{"plate", LawKind::linear_elastic, 2.5e9, 0.33, 1200}};
  s.thickness = 1 * mm;
  s.transfer = transfer;
  s.order = transfer == Transfer::fmpm ? 2 : 1;
  s.bodies = {body("plate", Rectangle{{-half, -half}, {half, half}})};
  s.cracks = {crack("slanted", std::move(points))};
  s.contact = {mu > 0 ? ContactLaw::coulomb : ContactLaw::frictionless, mu, 0, 0};
  for (const Load::Edge edge : {Load::Edge::left, Load::Edge::right, Load::Edge::bottom, Load::Edge::top}) {
    Load l = traction_on(edge, Rectangle{{-half, -half}, {half, half}});
    l.name = fmt::format("edge {}", static_cast<int>(edge));
    const bool upright = edge == Load::Edge::left || edge == Load::Edge::right;
    const double out = edge == Load::Edge::left || edge == Load::Edge::bottom ? -1 : 1;
    l.value[upright ? 0 : 1] = TimeFunction{-out * pressure, [](double t) { return risen(t, 200 * us); }, ""};
    l.value[upright ? 1 : 0] = TimeFunction{out * shear, [](double t) { return risen(t - 300 * us, 200 * us); }, ""};
    s.loads.push_back(l);
  }
  s.grid_damping = constant(40e3);
  s.end_time = 1000 * us;
  s.fracture.asked = true;
  return s;
}

/// |K_II| of both tips at the end, Pa m^0.5.
struct Ends {
  double first, last;
};
Ends at_the_end(const Scene& s) {
  const ChosenSpace space;
  Simulation m(s, space);
  while (!m.finished())
    m.step();
  return {std::abs(m.state.tips[0].K_II), std::abs(m.state.tips[1].K_II)};
}

TEST(FrictionAround, HoldsACrackAsIfThereWereNone) {
  const std::vector<Vec2> points{{-12 * mm, -3.3 * mm}, {12 * mm, 4.1 * mm}};
  for (const Transfer transfer : {Transfer::flip, Transfer::fmpm}) {
    const auto K_II = [&](double mu) {
      return at_the_end(pressed_and_sheared(10 * MPa, 3 * MPa, mu, transfer, points));
    };
    const Ends held = K_II(0.6), free = K_II(0);
    const double left = std::max(held.first / free.first, held.last / free.last);
    gates::report(std::string("crack that friction holds, ") + (transfer == Transfer::flip ? "FLIP" : "FMPM(2)") +
                      ": K_II over that without friction",
                  left, "0.04");
    EXPECT_LT(left, 0.04);
    EXPECT_GT(std::min(free.first, free.last), 0.5e6);
  }
}

/// The largest difference of a component of the particles' stress from that of a plate without cracks, over its
/// pressure. Friction of 0.6 bears twice what shears any plane there.
double off_without_cracks(const std::vector<std::vector<Vec2>>& cracks, Transfer transfer, ContactLaw law) {
  const double pressure = 10 * MPa, shear = 3 * MPa;
  Scene s = pressed_and_sheared(pressure, shear, 0.6, transfer, cracks[0]);
  for (size_t k = 1; k < cracks.size(); ++k)
    s.cracks.push_back(crack(fmt::format("crack {}", k).c_str(), cracks[k]));
  s.contact.law = law;
  s.fracture.asked = false;
  s.grid_damping = constant(120e3);
  s.end_time = 700 * us;
  const ChosenSpace space;
  Simulation m(s, space);
  while (!m.finished())
    m.step();
  const double without[3] = {-pressure, -pressure, shear};
  double off = 0;
  for (size_t c = 0; c < 3; ++c)
    for (const double stress : m.state.particles.stress[c])
      off = std::max(off, std::abs(s.materials[0].density * stress - without[c]));
  return off / pressure;
}

/// Through (0.3, 0.2) mm, which lies a fifth of a cell beside it.
std::vector<Vec2> through_one_place(double degrees) {
  const Vec2 along{std::cos(degrees * std::numbers::pi / 180), std::sin(degrees * std::numbers::pi / 180)};
  const Vec2 place = Vec2{0.3 * mm, 0.2 * mm} + 0.2 * mm * turned(along);
  return {place - 11 * mm * along, place + 12 * mm * along};
}

TEST(FrictionAround, HoldsCracksThatCross) {
  const std::vector<Vec2> a = through_one_place(10), b = through_one_place(70), c = through_one_place(130);
  using Lines = std::vector<std::vector<Vec2>>;
  for (const Lines& cracks : {Lines{c}, Lines{a, b}, Lines{a, b, c}}) {
    const double off = off_without_cracks(cracks, Transfer::flip, ContactLaw::coulomb);
    gates::report(fmt::format("{} cracks through one place, held by friction, FLIP: stress off by, of the pressure",
                              cracks.size()),
                  off, "0.02");
    EXPECT_LT(off, 0.02);
  }
  for (const ContactLaw law : {ContactLaw::coulomb, ContactLaw::stick}) {
    const double off = off_without_cracks({a, b, c}, Transfer::fmpm, law);
    gates::report(fmt::format("3 cracks through one place, {}, FMPM(2): stress off by, of the pressure",
                              law == ContactLaw::stick ? "stuck" : "held by friction"),
                  off, "0.2");
    EXPECT_LT(off, 0.2);
  }
}

TEST(FrictionAround, LeavesACrackItsShareOfTheShear) {
  constexpr double degrees = 17, slant = degrees * std::numbers::pi / 180, mu = 0.3;
  const double pressure = 6 * MPa, shear = 8 * MPa;
  const Vec2 along = 12 * mm * Vec2{std::cos(slant), std::sin(slant)}, up{0, 0.4 * mm};
  const std::vector<Vec2> points{up - along, up + along};
  const double sigma = pressure + shear * std::sin(2 * slant), tau = shear * std::cos(2 * slant);
  const auto K_II = [&](double friction) {
    return at_the_end(pressed_and_sheared(pressure, shear, friction, Transfer::fmpm, points));
  };
  const Ends rubbing = K_II(mu), free = K_II(0);
  for (const double share : {rubbing.first / free.first, rubbing.last / free.last}) {
    gates::report("crack that slides against its friction: K_II over that without, over 1 - mu sigma / tau",
                  share / (1 - mu * sigma / tau), "1 +- 0.13");
    EXPECT_NEAR(share / (1 - mu * sigma / tau), 1, 0.13);
  }
}

TEST(FrictionAround, BearsNoMoreThanItsStairsExplain) {
  const double mu = 0.3, pressed = 2;
  double around = 1;
  const auto borne = [&](double to_stick, Stairs s) {
    return held_along_stairs(mu, around, s).within(to_stick, pressed);
  };
  EXPECT_EQ(borne(0.5, {0, 0}), 0.5);
  EXPECT_NEAR(borne(9, {0, 0}), 2 * mu * pressed, 1e-15);
  EXPECT_NEAR(borne(-9, {0, 0}), -2 * mu * pressed, 1e-15);
  // up the stairs they bear more by the slope, and down no more than on the level
  EXPECT_NEAR(borne(9, {0, 1}), (1 + 4 * mu) * pressed, 1e-15);
  EXPECT_NEAR(borne(-9, {0, 1}), -4 * mu * pressed, 1e-15);
  EXPECT_NEAR(borne(-9, {-0.5, 0}), -(0.5 + 2.5 * mu) * pressed, 1e-15);
  // and what is pressed less than the faces around bears as much as these
  around = 0.3;
  EXPECT_NEAR(borne(9, {0, 0}), 2 * mu * pressed, 1e-15);
  around = 3;
  EXPECT_NEAR(borne(9, {0, 0}), 6 * mu * pressed, 1e-15);
}

}  // namespace
}  // namespace riven
