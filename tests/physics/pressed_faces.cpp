// Closed faces in a solid that expands and in noise: a wave that passes through shut faces is that of a whole solid,
// and with FLIP, whose noise takes faces apart for a step at a time, a block that slides feels Coulomb's friction.
#include "kernels/pressed_faces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>

#include "tests/physics/scene_gates.hpp"
#include "tests/physics/scenes.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace test;
using gates::report;

constexpr double mm = 1e-3, us = 1e-6, pulse = 17.2 * us;

TimeFunction shaped(double value, std::function<double(double)> shape) {
  return {value, std::move(shape), ""};
}

Energy last_energies(const Scene& s) {
  const ChosenSpace space;
  Simulation m(s, space);
  while (!m.finished())
    m.step();
  m.take_stock();
  return m.state.ledger.energy;
}

TEST(PressedFaces, KeepWhatGoesAlongWithTheSolidAboutThem) {
  const PairImpulse none{0, 0}, by_law{0.5, 0.1};
  constexpr bool slides = false, sticks = true, whole = true;
  const auto held = [](PairImpulse law, double pressed, bool stick, Vec2 u, Vec2 w, bool all = false) {
    const PairImpulse r = hold(law, pressed, stick, all, {2, 2}, u, w);
    return Vec2{r.lambda, r.tau};
  };
  const auto same = [](Vec2 a, Vec2 b) { return norm(a - b) < 1e-15; };
  // faces part (u_n < 0) as the solid expands (w_n < 0): all of that is kept, or no more than the solid's share
  EXPECT_TRUE(same(held(none, 9, slides, {-1, 3}, {-4, 0}), {-2, 0}));
  EXPECT_TRUE(same(held(none, 9, slides, {-4, 3}, {-1, 9}), {-2, 0}));
  // and by no more than they pressed with
  EXPECT_TRUE(same(held(none, 0.3, slides, {-4, 3}, {-1, 9}), {-0.3, 0}));
  // a solid that shrinks or is at rest keeps nothing
  EXPECT_TRUE(same(held(none, 9, slides, {-1, 0}, {0, 0}), {0, 0}));
  EXPECT_TRUE(same(held(none, 9, slides, {-1, 0}, {2, 0}), {0, 0}));
  // or, without friction and with FLIP, all, up to the impulse that they pressed with
  EXPECT_TRUE(same(held(none, 9, slides, {-4, 3}, {-1, 9}, whole), {-8, 0}));
  EXPECT_TRUE(same(held(none, 0.3, slides, {-4, 3}, {0, 0}, whole), {-0.3, 0}));
  // faces that close are for their law
  EXPECT_TRUE(same(held(by_law, 9, slides, {1, 1}, {-3, 3}), {0.5, 0.1}));
  // along the crack where they stick
  EXPECT_TRUE(same(held(none, 9, sticks, {-1, 3}, {-4, 1}), {-2, 2}));
  EXPECT_TRUE(same(held(none, 9, sticks, {-1, 3}, {-4, -1}), {-2, 0}));
  EXPECT_TRUE(same(held(none, 0.5, sticks, {-1, -3}, {-4, -1}), {-0.5, -0.5}));
}

/// A column that a pulse of pressure runs up, with a crack across it or without.
Scene column(std::optional<ContactSettings> contact, double crack_at, Transfer transfer) {
  Scene s = empty_scene(mm, {{-2 * mm, -54 * mm}, {2 * mm, 104 * mm}});
  s.end_time = 90 * us;
  s.materials = {{"solid", LawKind::linear_elastic, 1e9, 0.3, 1000}};
  s.transfer = transfer;
  s.order = 2;
  s.bodies = {body("column", Rectangle{{-2 * mm, -50 * mm}, {2 * mm, 100 * mm}})};
  for (const double side : {-1., 1.}) {
    SymmetryPlane plane;
    plane.axis = 0;
    plane.position = side * 2 * mm;
    plane.solid = side < 0 ? +1 : -1;
    s.symmetry.push_back(plane);
  }
  Load push = traction_on(Load::Edge::bottom, Rectangle{{-2 * mm, -50 * mm}, {2 * mm, -49 * mm}});
  push.name = "pulse";
  push.value[1] =
      shaped(1e5, [](double t) { return t < pulse ? std::pow(std::sin(std::numbers::pi * t / pulse), 2) : 0; });
  s.loads = {push};
  if (contact) {
    s.contact = *contact;
    s.cracks = {crack("cut", {{-2 * mm, crack_at}, {2 * mm, crack_at}})};
  }
  return s;
}

struct Energies {
  double kept = 0;     ///< kinetic and strain energy over the work done
  double contact = 0;  ///< what contact took, over the work done
};

Energies run(const Scene& scene) {
  const ChosenSpace space;
  Simulation m(scene, space);
  while (!m.finished())
    m.step();
  const Energy& e = m.state.ledger.energy;
  return {(e.kinetic + e.strain) / e.external_work, e.contact / e.external_work};
}

// The pulse is 20 cells long and has left the crack behind. The control finds contact by velocity alone, which keeps
// nothing.
TEST(PressedFaces, LetAWavePassAsIfTheSolidWereWhole) {
  for (const Transfer transfer : {Transfer::flip, Transfer::fmpm}) {
    const Energies whole = run(column({}, 0, transfer));
    double control = 0;
    for (const ContactLaw law : {ContactLaw::frictionless, ContactLaw::coulomb, ContactLaw::stick})
      for (const double at : {0., 0.25 * mm, 0.5 * mm}) {
        SCOPED_TRACE(testing::Message() << name_of(transfer) << " " << name_of(law) << " " << at);
        const Scene scene = column(ContactSettings{law, 0.3, 0, 0}, at, transfer);
        const Energies cut = run(scene);
        EXPECT_NEAR(cut.kept, whole.kept, 0.008);
        EXPECT_NEAR(cut.contact, 0, 0.003);
        if (law != ContactLaw::frictionless)
          continue;
        Scene by_velocity = scene;
        by_velocity.contact_rules.detection = ContactDetection::velocity;
        control = std::min(control, run(by_velocity).contact);
      }
    report(std::string("wave through shut faces, ") + std::string(name_of(transfer)) +
               ", control: what contact by velocity takes of the work",
           control, "less than -0.03");
    EXPECT_LT(control, -0.03);
  }
}

/// A block of 40 x 5 cells slides down a slope of 18 degrees by its own weight, which comes up within a tenth of the
/// time: friction takes mu cot(slope) of the work of the weight, 0.923 for a coefficient of 0.3. With FLIP noise lifts
/// nodes of the block off the slope for a step at a time, so that it takes less. Held along the crack, too, in the
/// stages without forces, as far as the solid goes on, it takes 0.65; held altogether contact makes energy, which ends
/// the run.
TEST(PressedFaces, SlideWithFlipAsFrictionHasIt) {
  constexpr double friction = 0.3, slope = 18 * std::numbers::pi / 180, gravity = 1000;
  Scene s = empty_scene(mm, {{-4 * mm, -12 * mm}, {84 * mm, 12 * mm}});
  s.end_time = 3e-3;
  s.materials = {{"solid", LawKind::linear_elastic, 1e9, 0.3, 1000}};
  s.bodies = {body("base", Rectangle{{0, -8 * mm}, {80 * mm, 0}}),
              body("block", Rectangle{{10 * mm, 0}, {50 * mm, 5 * mm}})};
  FixedNodes bottom;
  bottom.name = "bottom";
  bottom.box = {{0, -12 * mm}, {80 * mm, -8 * mm}};
  bottom.velocity[0] = bottom.velocity[1] = constant(0);
  s.fixed = {bottom};
  const auto ramp = [](double t) { return std::min(t / 0.2e-3, 1.); };
  Load weight;
  weight.name = "weight";
  weight.kind = Load::Kind::acceleration;
  weight.region = Rectangle{{0, -8 * mm}, {80 * mm, 5 * mm}};
  weight.value[0] = shaped(gravity * std::sin(slope), ramp);
  weight.value[1] = shaped(-gravity * std::cos(slope), ramp);
  s.loads = {weight};
  s.contact = {ContactLaw::coulomb, friction, 0, 0};
  s.cracks = {crack("joint", {{-2 * mm, 0}, {82 * mm, 0}})};
  const Energy e = last_energies(s);
  const double taken = e.contact / e.external_work;
  report("block on a slope with FLIP: what friction takes of the work (0.923)", taken, "0.7 to 1");
  EXPECT_GT(taken, 0.7);
  EXPECT_LT(taken, 1);
}

// Two bars that fly into each other, their border anywhere in a cell.
TEST(PressedFaces, KeepTheEnergyOfASharpImpact) {
  for (const ContactLaw law : {ContactLaw::frictionless, ContactLaw::stick})
    for (const double border : {0., 0.25, 0.5, 0.75}) {
      Scene s = empty_scene(1, {{-14, -2}, {15, 6}});
      s.materials[0].nu = 0;
      s.bodies = {body("left", Rectangle{{border - 10, 0}, {border, 4}}),
                  body("right", Rectangle{{border, 0}, {border + 10, 4}})};
      s.bodies[0].velocity = {0.1, 0};
      s.bodies[1].velocity = {-0.1, 0};
      s.cracks = {crack("border", {{border, -1}, {border, 5}})};
      s.contact = {law, 0, 0, 0};
      s.end_time = 1;
      const Energy e = last_energies(s);
      report(
          fmt::format("sharp impact across a border at {} cells: energy at the end over that at first, less 1", border),
          (e.kinetic + e.strain) / e.largest - 1, "-0.005 to 0");
      EXPECT_LT(e.kinetic + e.strain, e.largest * (1 + 1e-6));
      EXPECT_GT(e.kinetic + e.strain, e.largest * 0.995);
      EXPECT_LT(std::abs(e.contact), 0.005 * e.largest);
    }
}

// A bar that is pressed and then held, a crack across it that is shut: 4000 steps at rest. Held together once the
// series of higher orders was summed, its faces had made a fifth of the energy with FMPM(4) after 3000 of them.
TEST(PressedFaces, MakeNoEnergyAtRestWithAnyOrder) {
  for (const Transfer transfer : {Transfer::xpic, Transfer::fmpm})
    for (const int order : {2, 4, 6})
      for (const double nu : {0., 0.33}) {
        Scene s = empty_scene(0.5 * mm, {{-3 * mm, -2 * mm}, {13 * mm, 6 * mm}});
        s.end_time = 1e-3;
        s.plane = Plane::stress;
        s.materials = {{"solid", LawKind::linear_elastic, 3e9, nu, 1000}};
        s.transfer = transfer;
        s.order = order;
        s.bodies = {body("bar", Rectangle{{0, 0}, {10 * mm, 4 * mm}})};
        for (const double side : {-1., 1.}) {
          Grip g;
          g.name = side > 0 ? "right" : "left";
          g.region = side > 0 ? Rectangle{{10 * mm, 0}, {10.5 * mm, 4 * mm}} : Rectangle{{-0.5 * mm, 0}, {0, 4 * mm}};
          g.velocity[0] =
              shaped(-0.25 * side, [](double t) { return t < 120 * us ? std::min(t / (50 * us), 1.) : 0.; });
          s.grips.push_back(g);
        }
        s.cracks = {crack("cut", {{5.1 * mm, -1 * mm}, {5.1 * mm, 5 * mm}})};
        const Energy e = last_energies(s);
        const std::string what =
            fmt::format("bar pressed across a crack, {}({}), nu {}: ", name_of(transfer), order, nu);
        report(what + "energy over the work, less 1", (e.kinetic + e.strain) / e.external_work - 1, "-0.03 to 0.006");
        report(what + "what contact makes over it", -e.contact / e.external_work, "0.006");
        EXPECT_LT(e.kinetic + e.strain, 1.006 * e.external_work);
        EXPECT_GT(e.kinetic + e.strain, 0.97 * e.external_work);
        EXPECT_LT(-e.contact, 0.006 * e.external_work);
      }
}

}  // namespace
}  // namespace riven
