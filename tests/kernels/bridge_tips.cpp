// What bridging a tip does to the velocities of the nodes around it.
#include "kernels/bridge_tips.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "kernels/crack_step.hpp"
#include "kernels/particle_to_grid.hpp"
#include "tests/physics/scenes.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

/// A square with a crack that ends in it, its particles with velocities of no order, and the momenta of its nodes.
struct Square {
  explicit Square(Vec2 tip, double angle, std::vector<CrackLine> others = {}) : scene(make(tip, angle, others)) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> velocity(-1, 1);
    auto& p = m.state.particles;
    for (long i = 0; i < p.count(); ++i)
      for (int axis : {0, 1})
        p.v[axis][i] = velocity(random);
    hash_if_due(m);
    find_fields(m);
    clear_grid(m.space, m.state, true);
    particle_to_grid(m.space, m.plan, m.state, true, {});
    list_bridges(space, m.state, bridges);
    clear_impulses(m.state.fields, m.impulses);
  }
  void bridge() { bridge_tips(space, m.state, bridges, ContactStage::before, m.impulses); }
  static Scene make(Vec2 tip, double angle, const std::vector<CrackLine>& others) {
    Scene s = test::empty_scene(1, {{-10, -10}, {10, 10}});
    s.bodies = {test::body("square", Rectangle{{-8, -8}, {8, 8}})};
    s.cracks = {test::crack("target", {tip - 20 * Vec2{std::cos(angle), std::sin(angle)}, tip})};
    s.cracks.insert(s.cracks.end(), others.begin(), others.end());
    s.fracture.asked = true;
    return s;
  }
  Vec2 momentum(long slot) const { return {m.state.grid.q[4 * slot], m.state.grid.q[4 * slot + 1]}; }
  Vec2 velocity(long slot) const { return momentum(slot) * (1 / m.state.grid.mass[slot]); }
  Vec2 jump(const BridgedPair& p) const { return velocity(p.above) - velocity(p.below); }
  double energy() const {
    double sum = 0;
    for (long n = 0; n < m.state.grid.slots(); ++n)
      if (m.state.grid.mass[n] > 0)
        sum += 0.5 * dot(momentum(n), velocity(n));
    return sum;
  }

  const test::ChosenSpace space;
  Scene scene;
  Simulation m{scene, space};
  TipBridges bridges;
};

constexpr Vec2 places[] = {{0, 0}, {0.1, 0}, {0.5, 0}, {0.9, 0}, {0.3, 0.5}, {-0.2, 0.27}};

TEST(BridgeTips, LetNodesPartByAShareOfThoseBehind) {
  for (const Vec2 tip : places)
    for (const double angle : {0., 0.4, 2.5}) {
      Square s(tip, angle);
      ASSERT_EQ(s.bridges.of_tip.size(), 1);
      const TipBridge& bridge = s.bridges.of_tip[0];
      s.bridge();
      Vec2 behind;
      double mass = 0;
      int shares = 0;
      for (int k = 0; k < bridge.count; ++k) {
        const BridgedPair& p = bridge.pair[k];
        const double a = s.m.state.grid.mass[p.above], b = s.m.state.grid.mass[p.below], reduced = a * b / (a + b);
        shares += p.share >= 0;
        if (p.share < 0) {
          behind += reduced * s.jump(p);
          mass += reduced;
        }
      }
      ASSERT_GT(mass, 0);
      ASSERT_GT(shares, 0);
      for (int k = 0; k < bridge.count; ++k) {
        const BridgedPair& p = bridge.pair[k];
        if (p.share >= 0) {
          EXPECT_LT(norm(s.jump(p) - (p.share / mass) * behind), 1e-12);
          EXPECT_LT(p.share, 0.7);
        }
      }
    }
}

/// Faces that have moved apart feel less of the nodes beyond them, the more the further these are from them.
TEST(BridgeTips, LetNodesPartByWhatOpenFacesFeel) {
  const double opening = 0.3;  // half of it a cell behind the tip, in cells
  const Vec2 tip{0.1, 0};
  Square s(tip, 0);
  Cracks& c = s.m.state.cracks;
  for (int k = 0; k < c.points(); ++k) {
    const Vec2 up{0, opening * std::max(0., tip.x - c.plane[k].x)};
    c.upper[k] += up;
    c.lower[k] -= up;
  }
  list_bridges(s.space, s.m.state, s.bridges);
  const TipBridge& bridge = s.bridges.of_tip[0];
  s.bridge();
  const auto pair_at = [&](Vec2 x) -> const BridgedPair& {
    for (const BridgedPair& p : bridge.pair)
      if (norm(s.m.state.grid.lattice.position(p.node % s.m.state.grid.lattice.nx, p.node / s.m.state.grid.lattice.nx) -
               x) < 1e-9)
        return p;
    throw std::logic_error("no such node");
  };
  // nodes on the crack's line, 0.1 and 1.1 cells behind the tip
  const double near = 1 - opening * 0.1, far = 1 - opening * 1.1, shut = 0.66 * (1 - std::sqrt(1 - 0.5));
  EXPECT_NEAR(-pair_at({-1, 0}).share, far, 1e-12);
  EXPECT_NEAR(pair_at({0, 0}).share, shut / near, 1e-12);
  EXPECT_LT(norm(s.jump(pair_at({0, 0})) - shut * (far / near) * s.jump(pair_at({-1, 0}))), 1e-12);
}

TEST(BridgeTips, KeepMomentumAndLoseEnergyOnce) {
  for (const Vec2 tip : places)
    for (const double angle : {0., 0.4, 2.5}) {
      Square s(tip, angle);
      const Square before(tip, angle);
      s.bridge();
      for (int k = 0; k < s.bridges.of_tip[0].count; ++k) {
        const BridgedPair& p = s.bridges.of_tip[0].pair[k];
        const Vec2 was = before.momentum(p.above) + before.momentum(p.below);
        EXPECT_LT(norm(s.momentum(p.above) + s.momentum(p.below) - was), 1e-12 * norm(was) + 1e-15);
        for (const long slot : {p.above, p.below}) {
          const Vec2 noted = *ImpulseNotes(s.m.impulses, s.m.state.grid.lattice).at(p.flagged, slot);
          EXPECT_LT(norm(s.momentum(slot) - before.momentum(slot) - noted), 1e-12 * norm(was) + 1e-15);
        }
      }
      const double once = s.energy();
      EXPECT_LT(once, before.energy());
      s.bridge();
      EXPECT_NEAR(s.energy(), once, 1e-14 * before.energy());
    }
}

/// On the far side of another crack, too, the faces part as those on this side do.
TEST(BridgeTips, SeeBothSidesOfAnotherCrack) {
  Square alone({0.3, 0.1}, 0), crossed({0.3, 0.1}, 0, {test::crack("across", {{-1.3, -9}, {-1.3, 9}})});
  EXPECT_GT(crossed.bridges.of_tip[0].count, alone.bridges.of_tip[0].count);
}

TEST(BridgeTips, LeaveEndsOutsideOfSolidsAlone) {
  const Square s({12, 0.1}, 0);
  EXPECT_TRUE(s.bridges.of_tip.empty() || s.bridges.of_tip[0].count == 0);
}

}  // namespace
}  // namespace riven
