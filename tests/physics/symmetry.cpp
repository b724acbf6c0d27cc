// What must not change when a scene is described otherwise: its cracks in another order or from the other end, half of
// it beside a plane of symmetry, or its mirror image.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/state/tractions.hpp"
#include "tests/physics/scene_gates.hpp"
#include "tests/physics/scenes.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace test;

/// A square of 24 cells of 1 m whose cracks bear a pressure of 0.2 % of Young's modulus, and come to rest.
Scene pressed(Rectangle plate) {
  Scene s = empty_scene(1, {plate.lower - Vec2{4, 4}, plate.upper + Vec2{4, 4}});
  s.bodies = {body("plate", plate)};
  s.grid_damping = TimeFunction{5, {}, ""};
  s.fracture.asked = true;
  s.end_time = 4;
  s.output.history_every = 0.5;
  return s;
}

CrackLine under_pressure(const char* name, std::vector<Vec2> points) {
  CrackLine c = crack(name, std::move(points));
  c.traction.emplace();
  c.traction->pressure = TimeFunction{2e3, [](double t) { return std::min(1., t / 2); }, ""};
  return c;
}

void run(Simulation& m) {
  while (!m.finished())
    m.step();
}

/// Openings of the faces of two cracks where they meet, and at the points next to there.
struct Joint {
  double ends[2], next[2], J;
  explicit Joint(const Scene& s, int left, int right) {
    const ChosenSpace space;
    Simulation m(s, space);
    run(m);
    const Cracks& c = m.state.cracks;
    for (const int k : {0, 1}) {
      ends[k] = face_opening(c, c.end_point(k ? right : left, !k)).normal;
      next[k] = face_opening(c, c.next_to_end(k ? right : left, !k)).normal;
    }
    J = m.state.tips[0].J;
  }
};

TEST(TwoCracksEndToEnd, AreAsOne) {
  const Vec2 mouth{-1.5, 12.4}, joint{8.117, 12.9}, tip{13.2, 14.6};
  const CrackLine left = under_pressure("left", {mouth, joint}), right = under_pressure("right", {joint, tip});
  Scene s = pressed({{0, 0}, {24, 24}});
  s.cracks = {left, right};
  const Joint one_way(s, 0, 1);
  s.cracks = {right, left};
  const Joint other_way(s, 1, 0);
  s.cracks = {under_pressure("one", {mouth, joint, tip})};
  const ChosenSpace space;
  Simulation m(s, space);
  run(m);

  gates::report("two cracks end to end, J over that of one, less 1", one_way.J / m.state.tips[0].J - 1, "0.005");
  gates::report("two cracks end to end, J of one order over that of the other, less 1", one_way.J / other_way.J - 1,
                "0.001");
  EXPECT_NEAR(one_way.J, m.state.tips[0].J, 5e-3 * m.state.tips[0].J);
  EXPECT_NEAR(one_way.J, other_way.J, 1e-3 * one_way.J);
  for (const Joint* at : {&one_way, &other_way})
    for (const int k : {0, 1}) {
      gates::report("two cracks end to end, opening where they meet over that next to there", at->ends[k] / at->next[k],
                    "1 +-0.2");
      EXPECT_NEAR(at->ends[k], at->next[k], 0.2 * at->next[k]) << k;
    }
}

/// Each tip's bridge alone loses energy if anything; two of them have to agree on the nodes that they share.
TEST(TipsThatShareNodes, MakeNoEnergyInAnyOrder) {
  const CrackLine left = under_pressure("left", {{-1.5, 12.5}, {12.25, 12.5}});
  const CrackLine right = under_pressure("right", {{25.5, 11.5}, {11.75, 11.5}});
  double J[2] = {};
  for (const bool swapped : {false, true}) {
    Scene s = pressed({{0, 0}, {24, 24}});
    s.contact.law = ContactLaw::ignored;  // what is booked as contact is what bridges take
    s.cracks = swapped ? std::vector{right, left} : std::vector{left, right};
    const ChosenSpace space;
    Simulation m(s, space);
    run(m);
    m.take_stock();
    const Energy& e = m.state.ledger.energy;
    gates::report("tips that share nodes, energy taken over the strain energy", e.contact / e.strain, "+-1e-6");
    EXPECT_NEAR(e.contact, 0, 1e-6 * e.strain);
    J[swapped] = m.state.tips[swapped].J;
  }
  gates::report("tips that share nodes, J in one order of cracks over that in the other, less 1", J[1] / J[0] - 1,
                "1e-4");
  EXPECT_NEAR(J[1], J[0], 1e-4 * J[0]);
}

TEST(PressureOnAPart, IsTheSameFromEitherEnd) {
  for (const double begins : {6.3, 6.6, 7.25}) {
    double J[2] = {};
    for (const bool reversed : {false, true}) {
      std::vector<Vec2> points{{-1.5, 12}, {8.25, 12}};
      if (reversed)
        std::swap(points[0], points[1]);
      Scene s = pressed({{0, 0}, {24, 24}});
      s.cracks = {under_pressure("edge", points)};
      s.cracks[0].traction->region = Rectangle{{begins, 0}, {24, 24}};
      const ChosenSpace space;
      Simulation m(s, space);
      run(m);
      J[reversed] = m.state.tips[0].J;
    }
    gates::report("pressure on a part, J from one end over that from the other, less 1", J[1] / J[0] - 1, "1e-6");
    EXPECT_GT(J[0], 0);
    EXPECT_NEAR(J[1], J[0], 1e-6 * J[0]) << begins;
  }
}

/// A contour may not take in what lies beyond the plane.
TEST(SymmetryPlane, LeavesJAlone) {
  Scene s = pressed({{0, -12}, {24, 12}});
  s.end_time = 12;
  s.symmetry = {{0, 0, +1}};
  s.cracks = {under_pressure("centre", {{-2, 0}, {8, 0}})};
  s.fracture.contour = 12;
  for (const int contour : {8, 14, 16, 18, 20}) {
    s.readings.push_back({"far", s.fracture});
    s.readings.back().rules.contour = contour;
  }
  const ChosenSpace space;
  Simulation m(s, space);
  run(m);
  const double J = m.state.tips[0].J;
  EXPECT_GT(J, 0);
  for (size_t k = 0; k < s.readings.size(); ++k) {
    const double far = m.state.readings[k][0].J;
    gates::report("tip 8 cells from a plane of symmetry, J with contours of 8 to 20 cells over that with 12, less 1",
                  far / J - 1, "0.002");
    EXPECT_NEAR(far, J, 0.002 * J) << s.readings[k].rules.contour;
  }
}

/// A neck two cells wide leaves no room for a contour: the crack takes the shorter way out of it.
TEST(CrackInANeck, LeavesItAsItsMirrorImageDoes) {
  for (const double off : {-0.06, 0.06}) {
    double side[2] = {};
    for (const int sign : {1, -1}) {
      const auto block = [&](Vec2 lower, Vec2 upper) {
        return Rectangle{{lower.x, sign > 0 ? lower.y : -upper.y}, {upper.x, sign > 0 ? upper.y : -lower.y}};
      };
      Scene s = empty_scene(1, {{-4, -16}, {44, 16}});
      s.transfer = Transfer::fmpm;
      s.bodies = {body("wide", block({0, -10}, {16, 10})), body("neck", block({16, -1}, {40, 1}))};
      for (const double end : {-1., 1.}) {
        Grip g;
        g.name = end > 0 ? "top" : "bottom";
        g.region = Rectangle{{0, end > 0 ? 10. : -11.}, {10, end > 0 ? 11. : -10.}};
        g.velocity[1] = constant(end * 0.18);
        s.grips.push_back(g);
      }
      s.cracks = {crack("edge", {{-1.5, sign * off}, {6.1, sign * off}})};
      s.growth.emplace();
      s.growth->criterion = GrowthCriterion::critical_j;
      s.growth->toughness = 8.2;
      s.growth->direction = GrowthDirection::self_similar;
      const ChosenSpace space;
      Simulation m(s, space);
      while (m.state.tips[0].open && m.state.clock.time < 5)
        m.step();
      ASSERT_FALSE(m.state.events.empty());
      ASSERT_EQ(m.state.events.back().kind, CrackEvent::Kind::exit);
      side[sign < 0] = m.state.events.back().place.y;
    }
    gates::report("crack in a neck, y where it leaves, m", side[0], "to the nearer side");
    EXPECT_NEAR(side[1], -side[0], 1e-9);
    EXPECT_GT(side[0] * off, 0);
  }
}

/// Beside a crack that a pressure opens, another one that is open next to its first tip and pressed shut three cells
/// behind it. What shuts is found along the crack, and not by which cells of the grid come first.
TEST(PartlyShutCrack, HasTheSameKInAllMirrorImages) {
  constexpr double width = 25, height = 23;
  const auto first_tip = [](double cell, bool in_x, bool in_y) {
    const auto place = [=](Vec2 x) { return Vec2{in_x ? width - x.x : x.x, in_y ? height - x.y : x.y}; };
    Scene s = empty_scene(cell, {{-4, -4}, {width + 4, height + 4}});
    s.bodies = {body("plate", Rectangle{{0, 0}, {width, height}})};
    CrackLine opens = crack("opens", {place({8.437, 12.72}), place({16.514, 15.635})});
    opens.traction.emplace();
    opens.traction->pressure = TimeFunction{2e3, [](double t) { return std::min(1., t / 0.25); }, ""};
    s.cracks = {opens, crack("shuts", {place({7.071, 14.567}), place({12.998, 14.736})})};
    s.fracture.asked = true;
    s.end_time = 0.53;
    s.output.history_every = 0.01;
    const ChosenSpace space;
    Simulation m(s, space);
    run(m);
    return m.state.tips[2];
  };
  const Tip fine = first_tip(0.25, false, false), plain = first_tip(1, false, false);
  const double K = std::hypot(fine.K_I, fine.K_II);
  gates::report("partly shut crack, K_I less that by cells a quarter as large, over its K", (plain.K_I - fine.K_I) / K,
                "0 +- 0.1");
  gates::report("and K_II", (plain.K_II - fine.K_II) / K, "0 +- 0.1");
  EXPECT_NEAR(plain.K_I, fine.K_I, 0.1 * K);
  EXPECT_NEAR(plain.K_II, fine.K_II, 0.1 * K);
  for (const bool in_x : {false, true})
    for (const bool in_y : {false, true}) {
      const Tip tip = first_tip(1, in_x, in_y);
      const double sign = in_x == in_y ? 1 : -1;
      EXPECT_NEAR(tip.K_I, plain.K_I, 1e-6 * K) << in_x << in_y;
      EXPECT_NEAR(tip.K_II, sign * plain.K_II, 1e-6 * K) << in_x << in_y;
      EXPECT_NEAR(tip.J, plain.J, 1e-6 * plain.J) << in_x << in_y;
    }
}

}  // namespace
}  // namespace riven
