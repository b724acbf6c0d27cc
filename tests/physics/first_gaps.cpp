// Solids that start apart along a crack: they press on each other once they meet, wherever the crack is drawn between
// them, and not before.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/physics/scene_gates.hpp"
#include "tests/physics/scenes.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace test;

constexpr double side = 12;      // cells, each 1 m
constexpr double strain = 0.01;  // at the end

/// Where the crack is drawn: on the block, on the platen, or a part of the way up.
struct Drawn {
  const char* what;
  double part;
};

/// A block at rest, and a platen above it, `gap` cells away, that comes down by this and `strain` of the block's height
/// within 6 s.
Scene platen_above_block(double gap, double part) {
  Scene s = empty_scene(1, {{-4, -2}, {side + 4, side + 10}});
  s.materials[0].nu = 0;
  const Rectangle platen{{-1, side + gap}, {side + 1, side + gap + 3}};
  s.bodies = {body("block", Rectangle{{0, 0}, {side, side}}), body("platen", platen)};
  const double y = side + part * gap;
  s.cracks = {crack("border", {{-2, y}, {side + 2, y}})};
  s.contact = {ContactLaw::frictionless, 0, 0, 0};
  s.grips = {grip_at_rest("platen", platen)};
  const double way = gap + strain * side, time = 6;
  const auto pulse = [time](double t) { return t < time ? 1 - std::cos(2 * std::numbers::pi * t / time) : 0; };
  s.grips[0].velocity[1] = TimeFunction{-way / time, pulse, ""};
  s.fixed = {{"bottom", {{-4, -2}, {side + 4, 0}}, {std::nullopt, constant(0)}}};
  s.grid_damping = constant(8);
  s.end_time = 9;
  return s;
}

struct Pressed {
  double early =
      0;            ///< force on the block before the platen has come down by the gap, over that of the strain, at most
  double last = 0;  ///< and at the end
  double unbooked = 0;
};

Pressed press(const Scene& s, double gap) {
  const ChosenSpace space;
  Simulation m(s, space);
  const double force = s.materials[0].E * strain * side;
  Pressed r;
  double down = 0;
  while (!m.finished()) {
    m.step();
    const double held = std::abs(m.state.constraints.owners.front().reaction.y) / force;
    down -= m.state.clock.dt * (*s.grips[0].velocity[1])(m.state.clock.time);
    if (down < gap - 0.02)
      r.early = std::max(r.early, held);
    r.last = held;
  }
  m.take_stock();
  r.unbooked = m.state.ledger.energy.relative_error();
  return r;
}

// A crack at a distance from both moves with neither until they meet.
TEST(FirstGaps, CloseWhereAPlatenMeetsABlock) {
  for (const double gap : {0.5, 1.2, 3.7})
    for (const Drawn& drawn : {Drawn{"on the block", 0}, {"between", 0.4}, {"on the platen", 1}})
      for (const CrackMotion motion : {CrackMotion::surfaces, CrackMotion::center_of_mass}) {
        Scene s = platen_above_block(gap, drawn.part);
        s.crack_motion = motion;
        const Pressed r = press(s, gap);
        gates::report(fmt::format("gap of {} cells, crack drawn {}: force over that of the strain", gap, drawn.what),
                      r.last, "1 +-2 %");
        gates::report("and before they meet, at most", r.early, "0.01");
        EXPECT_NEAR(r.last, 1, 0.02) << gap << ' ' << drawn.what;
        EXPECT_LT(r.early, 0.01) << gap << ' ' << drawn.what;
        EXPECT_LT(std::abs(r.unbooked), 0.01) << gap << ' ' << drawn.what;
      }
}

/// A disk of `radius` cells between two platens that close on it, each by `way` cells.
Scene disk_between_platens(double radius, double way, bool along_disk) {
  Scene s = empty_scene(1, {{-radius - 4, -radius - 6}, {radius + 4, radius + 6}});
  s.bodies = {body("disk", Disk{{0, 0}, radius})};
  for (const double sign : {1., -1.}) {
    const Rectangle platen{{-6, std::min(sign * radius, sign * (radius + 3))},
                           {6, std::max(sign * radius, sign * (radius + 3))}};
    s.bodies.push_back(body(sign > 0 ? "top" : "bottom", platen));
    std::vector<Vec2> border;
    for (int k = -12; k <= 12; ++k) {
      const double angle = 0.5 * k / 12;
      border.push_back(along_disk ? radius * Vec2{std::sin(angle), sign * std::cos(angle)}
                                  : Vec2{7 * k / 12., sign * radius});
    }
    s.cracks.push_back(crack(sign > 0 ? "above" : "below", border));
    s.grips.push_back(grip_at_rest(sign > 0 ? "top" : "bottom", platen));
    s.grips.back().velocity[1] = TimeFunction{
        -sign * way / 8, [](double t) { return t < 8 ? 1 - std::cos(2 * std::numbers::pi * t / 8) : 0; }, ""};
  }
  s.contact = {ContactLaw::frictionless, 0, 0, 0};
  s.grid_damping = constant(4);
  s.end_time = 12;
  return s;
}

// The Brazilian test: in the middle of a disk between two forces P per thickness stresses are 2P/(pi D) along the line
// across and -6P/(pi D) along that of the forces.
TEST(FirstGaps, LetADiskTouchPlatensInAPoint) {
  const ChosenSpace space;
  constexpr double radius = 16;
  for (const bool along_disk : {false, true}) {
    const Scene s = disk_between_platens(radius, 0.2, along_disk);
    Simulation m(s, space);
    while (!m.finished())
      m.step();
    const auto& p = m.state.particles;
    Vec2 stress;
    int count = 0;
    for (long i = 0; i < p.count(); ++i)
      if (norm(Vec2{p.x[0][i], p.x[1][i]}) < 1.2) {
        stress += s.materials[0].density * Vec2{p.stress[0][i], p.stress[1][i]};
        ++count;
      }
    const double P = std::abs(m.state.constraints.owners.back().reaction.y), unit = P / (std::numbers::pi * radius);
    const Vec2 over = (1 / (count * unit)) * stress;
    const char* where = along_disk ? "the disk" : "the platens";
    gates::report(fmt::format("disk between platens, cracks along {}: stress across", where), over.x, "1 +-2 %");
    gates::report("and along the line of the forces", over.y, "-3 +-2 %");
    EXPECT_NEAR(over.x, 1, 0.02) << where;
    EXPECT_NEAR(over.y, -3, 0.06) << where;
  }
}

/// Of the particles of a body.
struct Motion {
  double momentum = 0;  ///< along x
  double kinetic = 0;
};
Motion motion_of(const Simulation& m, int body) {
  const auto& p = m.state.particles;
  Motion all;
  for (long i = 0; i < p.count(); ++i)
    if (p.body[i] == body) {
      all.momentum += p.mass[i] * p.v[0][i];
      all.kinetic += 0.5 * p.mass[i] * (p.v[0][i] * p.v[0][i] + p.v[1][i] * p.v[1][i]);
    }
  return all;
}

// Two equal bars, the crack on the one at rest: the other's momentum passes to it within 2 L/c from gap/v on.
TEST(FirstGaps, LetABarHitAnotherWhenItGetsThere) {
  constexpr double length = 20, gap = 3.3, speed = 0.3;
  Scene s = empty_scene(1, {{-27, -2}, {32, 6}});
  s.materials[0].nu = 0;
  s.bodies = {body("rests", Rectangle{{0, 0}, {length, 4}}), body("flies", Rectangle{{-length - gap, 0}, {-gap, 4}})};
  s.bodies[1].velocity = {speed, 0};
  s.cracks = {crack("end", {{0, -1}, {0, 5}})};
  s.contact = {ContactLaw::frictionless, 0, 0, 0};
  const double c = std::sqrt(s.materials[0].E / s.materials[0].density), hit = gap / speed, passed = 2 * length / c;
  s.end_time = hit + 3 * passed;
  const ChosenSpace space;
  Simulation m(s, space);
  const double first = motion_of(m, 1).momentum;
  while (m.state.clock.time < hit - 0.02 * passed)
    m.step();
  const double before = motion_of(m, 0).momentum / first;
  while (m.state.clock.time < hit + 0.5 * passed)
    m.step();
  const double half_way = motion_of(m, 0).momentum / first;
  while (!m.finished())
    m.step();
  const double after = motion_of(m, 0).momentum / first, total = after + motion_of(m, 1).momentum / first;
  m.take_stock();
  gates::report("bar that flies 3.3 cells to another: momentum of that one just before, of all", before, "0");
  gates::report("and at half of the time of contact", half_way, "0.5 +-0.05");
  gates::report("and at the end", after, "1 +-0.06");
  EXPECT_EQ(before, 0);
  EXPECT_NEAR(half_way, 0.5, 0.05);
  EXPECT_NEAR(after, 1, 0.06);
  EXPECT_NEAR(total, 1, 1e-12);
  EXPECT_LT(std::abs(m.state.ledger.energy.relative_error()), 0.01);
}

// A body that flies past over the end of a crack along another one, half a cell above it.
TEST(FirstGaps, LetABodyFlyPastWithoutTouching) {
  Scene s = empty_scene(1, {{-20, -4}, {40, 16}});
  s.bodies = {body("rests", Rectangle{{0, 0}, {14, 6}}), body("flies", Rectangle{{-12, 6.5}, {-2, 12.5}})};
  s.bodies[1].velocity = {1, 0};
  s.cracks = {crack("border", {{-3, 6}, {17, 6}})};
  s.contact = {ContactLaw::frictionless, 0, 0, 0};
  s.end_time = 28;
  const ChosenSpace space;
  Simulation m(s, space);
  const double first = motion_of(m, 1).momentum;
  while (!m.finished())
    m.step();
  const double taken = motion_of(m, 0).momentum / first;
  gates::report("body that flies past: momentum that it left to the other, of its own", taken, "0 +-1e-9");
  EXPECT_NEAR(taken, 0, 1e-9);
  EXPECT_LT(m.state.ledger.energy.strain, 1e-9 * m.state.ledger.energy.largest);
}

// Beside the corner of a block that is turned on the grid a crack goes with the block, not with the platen that comes
// down on it, and stops a third of a cell above it.
TEST(FirstGaps, LeaveATurnedBlockAloneUntilThePlatenIsThere) {
  Scene s = empty_scene(1, {{-18, -10}, {22, 28}});
  const double c = 0.8, n = 0.6;  // 36.87 degrees
  const auto at = [&](double along, double up) { return Vec2{c * along - n * up, n * along + c * up}; };
  const auto box = [&](double from, double to, double low, double high) {
    return Polygon{{at(from, low), at(to, low), at(to, high), at(from, high)}};
  };
  const Polygon base = box(-2, 14, -3, 0), platen = box(-2, 14, 13, 16);
  s.bodies = {body("block", box(0, 12, 0, 12)), body("base", base), body("platen", platen)};
  s.cracks = {crack("foot", {at(-3, 0), at(15, 0)}), crack("head", {at(-1, 12), at(13, 12)})};
  s.contact = {ContactLaw::frictionless, 0, 0, 0};
  s.grips = {grip_at_rest("base", base), grip_at_rest("platen", platen)};
  const auto pulse = [](double t) { return t < 6 ? 1 - std::cos(2 * std::numbers::pi * t / 6) : 0; };
  s.grips[1].velocity[0] = TimeFunction{n * 0.67 / 6, pulse, ""};
  s.grips[1].velocity[1] = TimeFunction{-c * 0.67 / 6, pulse, ""};
  s.grid_damping = constant(8);
  s.end_time = 8;
  const ChosenSpace space;
  Simulation m(s, space);
  double most = 0;
  while (!m.finished()) {
    m.step();
    most = std::max(most, norm(m.state.constraints.owners.front().reaction));
  }
  const double force = most / (s.materials[0].E * strain * side);
  gates::report("turned block under a platen that stops before it: force over that of 1 %, at most", force, "1e-3");
  EXPECT_LT(force, 1e-3);
}

}  // namespace
}  // namespace riven
