#include "io/doubts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "core/fracture/growth.hpp"
#include "io/check_scene.hpp"
#include "tests/physics/scene_gates.hpp"

namespace riven {
namespace {

/// A plate of steel, 40 cells of 1 mm, pulled by a grip, with a crack from its edge.
Scene sound_scene() {
  Scene s;
  s.name = "plate";
  s.cell = 1e-3;
  s.grid = {{-5e-3, -5e-3}, {45e-3, 45e-3}};
  s.end_time = 1e-4;
  s.materials = {{"steel", LawKind::linear_elastic, 210e9, 0.3, 7850}};
  Body plate;
  plate.name = "plate";
  plate.region = Rectangle{{0, 0}, {40e-3, 40e-3}};
  s.bodies = {plate};
  Grip top;
  top.name = "top";
  top.region = Rectangle{{0, 40e-3}, {40e-3, 41e-3}};
  top.velocity[1] = TimeFunction{1, {}, ""};
  s.grips = {top};
  CrackLine edge;
  edge.name = "edge";
  edge.points = {{-1e-3, 20e-3}, {12e-3, 20e-3}};
  s.cracks = {edge};
  s.fracture.asked = true;
  return s;
}

/// Does the scene pass its checks with one doubt, of this part?
void expect_doubt(const Scene& s, const std::string& part, const std::string& what) {
  check_scene(s);
  const std::vector<Doubt> list = doubts(s);
  ASSERT_EQ(list.size(), 1) << part;
  EXPECT_EQ(list[0].place, part);
  EXPECT_NE(list[0].what.find(what), std::string::npos) << list[0].what;
  EXPECT_FALSE(list[0].hint.empty());
}

TEST(Doubts, LeaveSoundScenesAlone) {
  EXPECT_TRUE(doubts(sound_scene()).empty());
  for (const char* name : {"sent", "ten_cracks", "many_cracks", "dent"})
    EXPECT_TRUE(doubts(gates::shipped(name)).empty()) << name;
}

TEST(Doubts, NameMaterialsThatNoSolidIsMadeOf) {
  Scene s = sound_scene();
  s.materials[0].density = 7.85e6;
  expect_doubt(s, "material steel", "density");
  EXPECT_EQ(doubts(gates::shipped("beam_impact")).size(), 1);  // an impactor of 367 g, as small as it is
  s.materials[0].density = 7.85;
  expect_doubt(s, "material steel", "faster than in diamond");
}

TEST(Doubts, NameBodiesFasterThanTheirWaves) {
  Scene s = sound_scene();
  s.bodies[0].velocity = {3e3, 4e3};
  EXPECT_TRUE(doubts(s).empty());
  s.bodies[0].velocity = {4e3, 4e3};  // waves run at 5172 m/s
  expect_doubt(s, "body plate", "faster than its waves");
}

TEST(Doubts, NameBodiesThatSpinAndStrainByThat) {
  Scene s = sound_scene();
  s.bodies[0].spin = -0.2 / s.end_time;
  expect_doubt(s, "body plate", "strain at its borders");
  s.stress_update = StressUpdate::usl;
  EXPECT_TRUE(doubts(s).empty());
  s.stress_update = StressUpdate::usavg;
  s.affine = true;
  EXPECT_TRUE(doubts(s).empty());
  s.affine = false;
  s.bodies[0].spin = 0.05 / s.end_time;
  EXPECT_TRUE(doubts(s).empty());
}

TEST(Doubts, NameBodiesThatFlyOnGradients) {
  Scene s = sound_scene();
  s.affine = true;
  s.bodies[0].velocity = {40 * s.cell / s.end_time, 0};
  expect_doubt(s, "body plate", "it flies 40 cells");
  s.stress_update = StressUpdate::usl;
  EXPECT_TRUE(doubts(s).empty());
  s.stress_update = StressUpdate::usavg;
  s.transfer = Transfer::fmpm;
  s.order = 1;
  EXPECT_TRUE(doubts(s).empty());
  s.transfer = Transfer::flip;
  s.shape = ShapeFunction::bspline;
  EXPECT_TRUE(doubts(s).empty());
  s.shape = ShapeFunction::ugimp;
  s.bodies[0].velocity = {20 * s.cell / s.end_time, 0};
  EXPECT_TRUE(doubts(s).empty());
}

TEST(Doubts, NameInterfacesThatFmpmLetsGive) {
  Scene s = sound_scene();
  s.contact = {ContactLaw::interface, 0, 1e12, 1e12};
  EXPECT_TRUE(doubts(s).empty());
  s.transfer = Transfer::fmpm;
  expect_doubt(s, "crack edge", "an interface gives way");
  s.affine = true;
  EXPECT_TRUE(doubts(s).empty());
}

TEST(Doubts, NameGrowthOnFlip) {
  Scene s = sound_scene();
  s.growth = GrowthRule{};
  s.growth->toughness = 100;
  expect_doubt(s, "crack edge", "noise");
  s.transfer = Transfer::xpic;
  EXPECT_TRUE(doubts(s).empty());
  s.transfer = Transfer::flip;
  s.cracks[0].grows = false;
  EXPECT_TRUE(doubts(s).empty());
}

TEST(Doubts, NameHighOrdersWithStressLast) {
  Scene s = sound_scene();
  s.transfer = Transfer::fmpm;
  s.stress_update = StressUpdate::usl;
  s.order = 2;
  EXPECT_TRUE(doubts(s).empty());
  s.order = 4;
  expect_doubt(s, "solver.stress_update", "free corners");
  s.shape = ShapeFunction::bspline;
  EXPECT_TRUE(doubts(s).empty());
}

TEST(Doubts, NameTipsNextToTheEndOfTheSolid) {
  Scene s = sound_scene();
  Vec2& tip = s.cracks[0].points.back();
  tip = {tip.x, 40e-3 - 2.1 * s.cell};
  EXPECT_TRUE(doubts(s).empty());
  tip.y = 40e-3 - 1.4 * s.cell;
  s.fracture.asked = false;
  EXPECT_TRUE(doubts(s).empty());
  s.fracture.asked = true;
  expect_doubt(s, "crack edge", "less than 1.5 cells from the last tip");
  s.bodies[0].holes = {Disk{{tip.x, tip.y - 1.5 * s.cell}, 0.9 * s.cell}};
  expect_doubt(s, "crack edge", "less than 0.75 cells from the last tip");
}

TEST(Doubts, NameToughnessesThatNoCrackGoesBy) {
  Scene s = sound_scene();
  s.transfer = Transfer::fmpm;
  s.materials[0].K_Ic = 1e6;
  expect_doubt(s, "material steel", "no crack grows by its K_Ic");
  s.growth = GrowthRule{};
  EXPECT_TRUE(doubts(s).empty());
  s.growth->toughness = 2e6;
  expect_doubt(s, "material steel", "no crack grows by its K_Ic");
  s.growth->toughness = 0;
  s.materials[0].J_Ic = 100;
  expect_doubt(s, "material steel", "no crack grows by its J_Ic");
}

TEST(Doubts, NameCracksThatMayOutrunSurfaceWaves) {
  Scene s = sound_scene();
  s.growth = GrowthRule{};
  s.growth->toughness = 100;
  s.transfer = Transfer::fmpm;
  const double rayleigh = rayleigh_speed(s.materials[0], s.plane);
  s.growth->speed_limit = 0.99 * rayleigh;
  EXPECT_TRUE(doubts(s).empty());
  s.growth->speed_limit = 1.01 * rayleigh;
  expect_doubt(s, "growth.speed_limit", "Rayleigh");
  s.growth->direction = GrowthDirection::self_similar;  // sliding cracks may run faster
  EXPECT_TRUE(doubts(s).empty());
}

TEST(Doubts, NameGripsThatHoldNothing) {
  Scene s = sound_scene();
  s.grips[0].region = Rectangle{{0, 42e-3}, {40e-3, 43e-3}};
  expect_doubt(s, "grip top", "away from all bodies");
  s.grips[0].velocity[1] = TimeFunction{-15, {}, ""};  // by 1.5 mm, to the plate
  EXPECT_TRUE(doubts(s).empty());
}

// Points of the shared edge lie in both of them, or in none, by rounding.
TEST(Doubts, AreNoneOfBodiesThatShareASlantedEdgeWithACrackAlongIt) {
  Scene s = sound_scene();
  s.grid = {{-25e-3, -25e-3}, {45e-3, 45e-3}};
  s.grips.clear();
  s.fracture.asked = false;
  Body other = s.bodies[0];
  other.name = "other";
  s.bodies[0].region = Polygon{{{0, 0}, {10e-3, 10e-3}, {0, 20e-3}, {-10e-3, 10e-3}}};
  other.region = Polygon{{{0, 0}, {10e-3, -10e-3}, {20e-3, 0}, {10e-3, 10e-3}}};
  s.bodies.push_back(other);
  s.cracks[0].points = {{-2e-3, -2e-3}, {12e-3, 12e-3}};
  check_scene(s);
  s.bodies.pop_back();
  for (const auto& [from, to] : {std::pair{Vec2{-12e-3, 8e-3}, Vec2{2e-3, 22e-3}}, {{12e-3, 8e-3}, {-2e-3, 22e-3}}}) {
    s.cracks[0].points = {from, to};  // along its upper edges
    check_scene(s);
  }
  other.region = Polygon{{{0, 0}, {10e-3, -10e-3}, {20e-3, 0}, {9e-3, 11e-3}}};
  s.bodies.push_back(other);
  EXPECT_THROW(check_scene(s), Error) << "they overlap by up to a cell";
}

// Detection by displacement knows them.
TEST(Doubts, NameGapsAlongACrackThatDetectionDoesNotKnow) {
  Scene s = sound_scene();
  s.fracture.asked = false;
  Body upper = s.bodies[0];
  upper.name = "upper";
  const auto with_gap = [&](double gap) {
    s.bodies.resize(1);
    s.bodies[0].region = Rectangle{{0, 0}, {40e-3, 20e-3}};
    upper.region = Rectangle{{0, 20e-3 + gap}, {40e-3, 40e-3}};
    s.bodies.push_back(upper);
    s.cracks[0].points = {{-2e-3, 20e-3}, {42e-3, 20e-3}};
    return s;
  };
  EXPECT_TRUE(doubts(with_gap(0.5e-3)).empty());
  s.contact_rules.detection = ContactDetection::velocity;
  expect_doubt(with_gap(0.5e-3), "crack edge", "a gap of up to 0.5 mm lies between solids");
  for (const double none : {0., 3e-3})
    EXPECT_TRUE(doubts(with_gap(none)).empty()) << none << ": shut, and far apart";
  s.contact.law = ContactLaw::ignored;
  EXPECT_TRUE(doubts(with_gap(0.5e-3)).empty()) << "no contact";
}

// Along a border turned by 30 degrees: on it, a tenth of a cell inside of the lower body, twice, and too short.
TEST(Doubts, NameCracksThatDoNotPartTwoBodies) {
  const auto at = [](double along, double up) {
    return Vec2{20e-3 + 0.5e-3 * (std::sqrt(3.) * along - up), 20e-3 + 0.5e-3 * (along + std::sqrt(3.) * up)};
  };
  const auto scene = [&](double gap, double from, double depth) {
    Scene s = sound_scene();
    s.fracture.asked = false;
    s.grips.clear();
    Body upper = s.bodies[0];
    upper.name = "upper";
    s.bodies[0].region = Polygon{{at(-12, -6), at(12, -6), at(12, 0), at(-12, 0)}};
    upper.region = Polygon{{at(-12, gap), at(12, gap), at(12, 6), at(-12, 6)}};
    s.bodies.push_back(upper);
    s.cracks[0].points = {at(from, -depth), at(14, -depth)};
    return s;
  };
  EXPECT_TRUE(doubts(scene(0, -14, 0)).empty());
  EXPECT_TRUE(doubts(scene(0.5, -14, 0)).empty());
  expect_doubt(scene(0.5, -14, 0.1), "crack edge", "a little inside of a body");
  expect_doubt(scene(0, -11.6, 0), "crack edge", "less than a cell before the border of two bodies does");
  expect_doubt(scene(1.5, -11.6, 0), "crack edge", "less than a cell before the border of two bodies does");
  EXPECT_TRUE(doubts(scene(0, -9, 0)).empty()) << "a tip on the border";
  Scene two = scene(0.5, -14, 0);
  two.cracks.push_back(two.cracks[0]);
  two.cracks[1].name = "again";
  two.cracks[1].points = {at(-14, 0.5), at(14, 0.5)};
  expect_doubt(two, "crack again", "along the same gap between solids as crack edge");
}

TEST(Doubts, NameGripsThatReachJustPastACrack) {
  Scene s = sound_scene();
  Grip side;
  side.name = "side";
  side.velocity[1] = TimeFunction{1, {}, ""};
  const auto from = [&](double lower) {
    side.region = Rectangle{{-2e-3, lower}, {0, 30e-3}};
    s.grips[1] = side;
    return s;
  };
  s.grips.push_back(side);
  expect_doubt(from(19.4e-3), "grip side", "past crack edge");
  s.cracks[0].contact = ContactSettings{ContactLaw::bonded, 0, 0, 0};
  EXPECT_TRUE(doubts(from(19.4e-3)).empty()) << "nothing parts";
  s.cracks[0].contact.reset();
  for (const double sound : {20e-3, 17e-3})
    EXPECT_TRUE(doubts(from(sound)).empty()) << sound;
  s.cracks[0].points[0].x = 0;  // at the edge of the plate, and of the grip
  expect_doubt(from(19.4e-3), "grip side", "past crack edge");
}

TEST(Doubts, NameHolesBetweenParticles) {
  Scene s = sound_scene();
  s.bodies[0].holes = {Rectangle{{30.3e-3, 30e-3}, {30.6e-3, 34e-3}}};
  expect_doubt(s, "body plate", "between particles");
  s.bodies[0].holes = {Rectangle{{30e-3, 30e-3}, {32e-3, 34e-3}}};
  EXPECT_TRUE(doubts(s).empty());
}

/// A saw cut of one and of two cells that leads to a crack, from above and from the left, and a crack along it.
TEST(Doubts, NameNotchesThatTheGridDoesNotSee) {
  for (const int axis : {0, 1})
    for (const double width : {1e-3, 1.5e-3, 2e-3, 3e-3}) {
      Scene s = sound_scene();
      const auto turn = [&](Vec2 x) { return axis == 0 ? x : Vec2{x.y, x.x}; };
      s.grips.clear();
      s.cracks[0].points = {turn({10e-3, 20e-3}), turn({20e-3, 20e-3})};
      s.bodies[0].holes = {Rectangle{turn({-1e-3, 20e-3 - width / 2}), turn({10e-3, 20e-3 + width / 2})}};
      if (width < 2e-3)
        expect_doubt(s, "body plate", "less than two cells wide");
      else
        EXPECT_TRUE(doubts(s).empty()) << doubts(s)[0].what;
      s.cracks[0].points[0] = turn({-1e-3, 20e-3});
      EXPECT_TRUE(doubts(s).empty()) << width;
    }
  Scene s = sound_scene();
  s.bodies[0].holes = {Disk{{20e-3, 30e-3}, 5e-3}, Disk{{30e-3, 10e-3}, 0.75e-3}};
  EXPECT_TRUE(doubts(s).empty()) << "narrow at its ends alone";
}

TEST(Doubts, NameBodiesWhoseParticlesAreNotWhatWasDrawn) {
  Scene s = sound_scene();
  s.bodies[0].region = Rectangle{{0, 0}, {40e-3, 40.1e-3}};
  EXPECT_TRUE(doubts(s).empty());
  s.grips.clear();
  s.fracture.asked = false;
  s.bodies[0].region = Rectangle{{0, 19e-3}, {40e-3, 22.2e-3}};  // six rows of half a millimetre
  expect_doubt(s, "body plate", "6 % less");
  s.bodies[0].region = Rectangle{{0.25e-3, 19.25e-3}, {40.25e-3, 22.25e-3}};  // its edges through particles
  EXPECT_TRUE(doubts(s).empty());
  s.bodies[0].region = Disk{{20e-3, 20e-3}, 5e-3};
  s.cracks.clear();
  EXPECT_TRUE(doubts(s).empty());
  s.bodies[0].region = Polygon{{{0, 0}, {0.9e-3, 0}, {0, 1e-3}}};
  expect_doubt(s, "body plate", "than what was drawn");
}

TEST(Doubts, NameCracksTooShortToOpen) {
  Scene s = sound_scene();
  s.cracks[0].points = {{19.5e-3, 20.5e-3}, {20.5e-3, 20.5e-3}};
  expect_doubt(s, "crack edge", "may not open");
  s.cracks[0].points = {{19e-3, 20.5e-3}, {21.5e-3, 20.5e-3}};
  EXPECT_TRUE(doubts(s).empty());
}

/// The sound scene pulled at its top.
Scene pulled_scene() {
  Scene s = sound_scene();
  s.grips.clear();
  Load pull;
  pull.name = "pull";
  pull.kind = Load::Kind::traction;
  pull.edge = Load::Edge::top;
  pull.region = Rectangle{{0, 0}, {40e-3, 40e-3}};
  pull.value[1] = TimeFunction{1e6, {}, ""};
  s.loads = {pull};
  return s;
}

/// 1 MPa takes the plate of 40 x 40 mm away from where it was, unless something holds it or pulls it back.
TEST(Doubts, NameLoadsThatDoNotBalance) {
  Scene s = pulled_scene();
  s.end_time = 2e-3;
  expect_doubt(s, "load pull", "nothing holds the bodies along y");
  s.end_time = 1e-5;
  EXPECT_TRUE(doubts(s).empty());
  s.end_time = 2e-3;
  s.symmetry = {{1, 0, 1}};
  EXPECT_TRUE(doubts(s).empty());
  s.symmetry = {{0, 0, 1}};
  expect_doubt(s, "load pull", "along y");
  s.symmetry.clear();
  s.loads.push_back(s.loads[0]);
  s.loads[1].name = "hold";
  s.loads[1].edge = Load::Edge::bottom;
  s.loads[1].value[1] = TimeFunction{-1e6, {}, ""};
  EXPECT_TRUE(doubts(s).empty());
  s.loads[1].kind = Load::Kind::force;
  s.loads[1].value[1] = TimeFunction{-1e6 * 40e-3 * s.thickness, {}, ""};
  EXPECT_TRUE(doubts(s).empty());
  s.loads[1].value[1].value *= 0.5;
  expect_doubt(s, "load pull", "do not balance");
}

TEST(Doubts, NameTractionsOnObliqueEdgesAndInHoles) {
  Scene s = pulled_scene();
  s.symmetry = {{1, 0, 1}};
  EXPECT_TRUE(doubts(s).empty());
  s.bodies[0].holes = {Disk{{30e-3, 30e-3}, 4e-3}};
  expect_doubt(s, "load pull", "in a hole of body plate");
  s.loads[0].region = Rectangle{{0, 35e-3}, {40e-3, 40e-3}};
  EXPECT_TRUE(doubts(s).empty());
  s.bodies[0].region = Polygon{{{0, 0}, {40e-3, 0}, {40e-3, 30e-3}, {0, 40e-3}}};
  expect_doubt(s, "load pull", "projection");
}

/// E G / strength^2 of 10 mm and of 2.5 mm.
TEST(Doubts, NameCohesiveZonesTooShortForTheCells) {
  for (const double strength : {145e6, 290e6}) {
    Scene s = sound_scene();
    s.cracks[0].points.back().x = 41e-3;
    s.fracture.asked = false;
    TractionSettings& t = s.cracks[0].traction.emplace();
    t.kind = TractionKind::triangular;
    t.strength = t.shear_strength = strength;
    t.toughness = t.shear_toughness = 1e3;
    EXPECT_TRUE(doubts(s).empty());  // it gives way everywhere at once
    t.region = Rectangle{{12e-3, 0}, {41e-3, 40e-3}};
    if (strength > 200e6)
      expect_doubt(s, "crack edge", "cohesive zone");
    else
      EXPECT_TRUE(doubts(s).empty());
  }
}

TEST(Doubts, NameTheSmallestContour) {
  Scene s = sound_scene();
  s.fracture.contour = 2;
  expect_doubt(s, "fracture.contour", "2 cells");
  s.fracture.asked = false;
  EXPECT_TRUE(doubts(s).empty());
}

TEST(Doubts, NameTipsBesideAnotherThickness) {
  Scene s = sound_scene();
  s.bodies[0].region = Rectangle{{0, 0}, {14.5e-3, 40e-3}};
  s.bodies.push_back(s.bodies[0]);
  s.bodies[1].name = "rib";
  s.bodies[1].region = Rectangle{{14.5e-3, 0}, {40e-3, 40e-3}};
  EXPECT_TRUE(doubts(s).empty());
  s.bodies[1].thickness = 3 * s.thickness;
  expect_doubt(s, "crack edge", "takes in body rib");
}

/// Glass begins 2.5 cells ahead of the tip, and 4 cells.
TEST(Doubts, NameTipsBesideAnotherMaterial) {
  for (const double begins : {14.5e-3, 16e-3}) {
    Scene s = sound_scene();
    s.materials.push_back({"glass", LawKind::linear_elastic, 70e9, 0.22, 2500});
    s.bodies[0].region = Rectangle{{0, 0}, {begins, 40e-3}};
    s.bodies.push_back(s.bodies[0]);
    s.bodies[1].name = "pane";
    s.bodies[1].material = 1;
    s.bodies[1].region = Rectangle{{begins, 0}, {40e-3, 40e-3}};
    if (begins < 15e-3) {
      expect_doubt(s, "crack edge", "takes in material glass");
      continue;
    }
    EXPECT_TRUE(doubts(s).empty());
    s.readings = {{"large", s.fracture}};
    s.readings[0].rules.contour = 12;
    expect_doubt(s, "crack edge", "takes in material glass");
  }
}

}  // namespace
}  // namespace riven
