// Effects on demand: a scene without an effect runs no task of it and holds no array of it, before and after its first
// steps; with it, it does. That such scenes pay nothing inside the kernels either is what the performance gate counts.
#include <gtest/gtest.h>

#include <set>

#include "core/plan/explain.hpp"
#include "core/state/make_state.hpp"
#include "tests/physics/scenes.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace test;

/// A block that flies, with order-one FLIP and one stress update: nothing but the plain step.
Scene plain() {
  Scene s = empty_scene(1. / 8, {{-0.5, -0.5}, {1.5, 1.5}});
  s.bodies = {body("block", Rectangle{{0, 0}, {1, 1}})};
  s.bodies[0].velocity = {0.1, 0};
  s.stress_update = StressUpdate::usl;
  s.contact.law = ContactLaw::ignored;
  return s;
}

Scene cracked() {
  Scene s = plain();
  s.cracks = {crack("edge", {{-0.1, 0.5}, {0.5, 0.5}})};
  return s;
}

Scene with_tips() {
  Scene s = cracked();
  s.fracture.asked = true;
  return s;
}

Scene cut_in_two() {
  Scene s = plain();
  s.bodies = {body("lower", Rectangle{{0, 0}, {1, 0.5}}), body("upper", Rectangle{{0, 0.5}, {1, 1}})};
  s.cracks = {crack("border", {{-0.1, 0.5}, {1.1, 0.5}})};
  s.contact.law = ContactLaw::frictionless;
  return s;
}

struct EffectCase {
  const char* name;  ///< as in explain()
  const char* task;  ///< as tasks name their effect; empty where the effect is part of the plain step
  Scene (*without)();
  void (*add)(Scene&);
  std::vector<std::string> arrays;  ///< that belong to it, as list_arrays names them
};

void PrintTo(const EffectCase& c, std::ostream* out) {
  *out << c.name;
}

const EffectCase effects[] = {
    {"cracks",
     "cracks",
     plain,
     [](Scene& s) { s = cracked(); },
     {"particles: crack fields", "particles: crossing memory", "cracks: points", "cracks: motion", "cracks: crossings",
      "cracks: cells and nodes"}},
    {"contact",
     "contact",
     cracked,
     [](Scene& s) { s.contact.law = ContactLaw::frictionless; },
     {"particles: first position"}},
    {"first gaps",
     "",
     cut_in_two,
     [](Scene& s) {
       s.bodies[1].region = Rectangle{{0, 0.7}, {1, 1.2}};
     },
     {"particles: closed position"}},
    {"J",
     "J",
     cracked,
     [](Scene& s) { s = with_tips(); },
     {"particles: deformation gradient", "particles: first position"}},
    {"growth",
     "growth",
     with_tips,
     [](Scene& s) {
       s.growth = GrowthRule{};
       s.growth->toughness = 1e9;
     },
     {}},
    {"tractions",
     "tractions",
     cracked,
     [](Scene& s) {
       s.cracks[0].traction = TractionSettings{};
       s.cracks[0].traction->pressure = constant(1);
     },
     {}},
    {"boundary",
     "boundary",
     plain,
     [](Scene& s) {
       s.symmetry = {{0, -0.5, +1}};
     },
     {}},
    {"loads",
     "loads",
     plain,
     [](Scene& s) {
       Load load;
       load.kind = Load::Kind::force;
       load.region = s.bodies[0].region;
       load.value[0] = constant(1);
       s.loads = {load};
     },
     {}},
    {"body force", "body force", plain, [](Scene& s) { s.body_force[0] = constant(1); }, {}},
    {"grid damping", "grid damping", plain, [](Scene& s) { s.grid_damping = constant(1); }, {}},
    {"particle damping", "particle damping", plain, [](Scene& s) { s.particle_damping = constant(1); }, {}},
    {"gradients of velocity", "", plain, [](Scene& s) { s.affine = true; }, {"particles: velocity gradient"}},
    {"higher orders",
     "higher orders",
     plain,
     [](Scene& s) {
       s.transfer = Transfer::fmpm;
       s.order = 2;
     },
     {"grid: higher orders"}},
    {"watched energy", "watched energy", plain, [](Scene& s) { s.cfl = 1.1; }, {}},
    {"second extrapolation",
     "",
     plain,
     [](Scene& s) { s.stress_update = StressUpdate::musl; },
     {"grid: second extrapolation"}},
    {"deformation gradient",
     "",
     plain,
     [](Scene& s) { s.materials[0].law = LawKind::neo_hookean; },
     {"particles: deformation gradient"}},
    {"first positions",
     "",
     plain,
     [](Scene& s) {
       Probe p;
       p.kind = Probe::Kind::displacement;
       s.probes = {p};
     },
     {"particles: first position"}},
};

class Effects : public testing::TestWithParam<EffectCase> {
 protected:
  static std::set<std::string> tasks(const Simulation& m) {
    std::set<std::string> list;
    for (const Task& t : m.tasks)
      list.insert(t.effect);
    return list;
  }
  static std::set<std::string> arrays(const Simulation& m) {
    std::set<std::string> list;
    for (const ArrayReport& a : list_arrays(m.state))
      list.insert(a.name);
    return list;
  }
  static bool on(const Scene& s, const std::string& name) {
    const std::vector<EffectNote> notes = explain(s, make_plan(s));
    const auto note = std::find_if(notes.begin(), notes.end(), [&](const EffectNote& n) { return n.name == name; });
    EXPECT_NE(note, notes.end()) << name;
    EXPECT_FALSE(note->why.empty());
    return note->on;
  }
};

TEST_P(Effects, HaveNoTaskAndNoArrayWhereTheyAreNotAsked) {
  const EffectCase& c = GetParam();
  const Scene without = c.without();
  Scene with = without;
  c.add(with);
  EXPECT_FALSE(on(without, c.name));
  EXPECT_TRUE(on(with, c.name));
  const ChosenSpace space;
  Simulation a(without, space), b(with, space);
  for (int steps = 0; steps < 2; ++steps) {
    if (*c.task) {
      EXPECT_FALSE(tasks(a).contains(c.task));
      EXPECT_TRUE(tasks(b).contains(c.task));
    }
    const auto extent = [](const Simulation& m) {
      return m.tasks.size() + m.plan.keeps_F() + m.plan.first_positions() + m.plan.first_gaps + m.plan.affine;
    };
    EXPECT_GT(extent(b), extent(a));
    for (const std::string& name : c.arrays) {
      EXPECT_FALSE(arrays(a).contains(name)) << name;
      EXPECT_TRUE(steps == 0 || arrays(b).contains(name)) << name;
    }
    a.step();
    b.step();
  }
}

INSTANTIATE_TEST_SUITE_P(All, Effects, testing::ValuesIn(effects), [](const auto& param) {
  std::string name = param.param.name;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
});

/// What the state holds beside the arrays of list_arrays.
TEST(EffectsOfThePlainStep, HoldNothingElse) {
  const Scene s = plain();
  const ChosenSpace space;
  Simulation m(s, space);
  for (int n = 0; n < 3; ++n)
    m.step();
  EXPECT_TRUE(make_plan(s).effects().empty());
  EXPECT_EQ(m.state.cracks.points(), 0);
  EXPECT_TRUE(m.state.tips.empty());
  EXPECT_TRUE(m.state.readings.empty());
  EXPECT_TRUE(m.state.events.empty());
  EXPECT_TRUE(m.state.loads.position.empty());
  EXPECT_TRUE(m.state.constraints.owners.empty());
  EXPECT_TRUE(m.contact_sums.touched.empty());
  EXPECT_TRUE(m.bridges.of_tip.empty());
  EXPECT_TRUE(m.point_forces.empty());
  for (const Task& t : m.tasks)
    EXPECT_EQ(t.effect, "") << t.label;
  std::set<std::string> held;
  for (const ArrayReport& a : list_arrays(m.state))
    held.insert(a.name);
  EXPECT_EQ(held, (std::set<std::string>{"particles: position", "particles: velocity", "particles: det F",
                                         "particles: stress", "particles: mass", "particles: body", "particles: id",
                                         "grid: mass", "grid: momentum and force"}));
}

}  // namespace
}  // namespace riven
