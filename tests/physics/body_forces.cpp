// J and K beside body forces, which make stresses along a crack that vary over its contours.
//
// A plate hangs by its upper edge, and a crack in it lies along the weight: sigma_yy = rho g (y - y_lower) is all that
// the weight makes, and leaves the crack as it is. So K by a tension across it is the same with the weight as without,
// at both tips, in contours of any size, and as little may depend on whether the weight is a body force or a load.
#include "kernels/body_forces.hpp"

#include "tests/physics/plates.hpp"

namespace riven {
namespace {

using namespace gates;

constexpr double mm = 1e-3, tension = 1e6, half = 30 * mm, a = 10 * mm;

/// `weight`: stress on the upper edge, Pa.
Scene hanging_plate(double weight, bool as_load) {
  Scene s =
      shipped("sent", {"grid.cell=1 mm", "grid.lower=[\"-34 mm\", \"-56 mm\"]", "grid.upper=[\"54 mm\", \"56 mm\"]"});
  s.grips.clear();
  s.grid_damping = TimeFunction{60e3, {}, ""};  // 1/s
  s.bodies[0].region = Rectangle{{-half, -half}, {half, half}};
  s.cracks[0].points = {{0, -a}, {0, a}};
  const auto rise = [](double t) { return t < ramp ? 0.5 * (1 - std::cos(std::numbers::pi * t / ramp)) : 1; };
  const auto pull = [&](const char* name, Rectangle edge, int axis, double stress) {
    Load load;
    load.name = name;
    load.region = edge;
    load.value[axis] = TimeFunction{stress * 2 * half * s.thickness, rise, ""};
    s.loads.push_back(load);
  };
  pull("left", {{-half, -half}, {-half + 1 * mm, half}}, 0, -tension);
  pull("right", {{half - 1 * mm, -half}, {half, half}}, 0, tension);
  if (weight == 0)
    return s;
  pull("top", {{-half, half - 0.5 * mm}, {half, half}}, 1, weight);
  const TimeFunction fall{-weight / (2 * half * s.materials[0].density), rise, ""};
  if (as_load) {
    Load load;
    load.name = "weight";
    load.kind = Load::Kind::acceleration;
    load.region = s.bodies[0].region;
    load.value[1] = fall;
    s.loads.push_back(load);
  } else {
    s.body_force[1] = fall;
  }
  return s;
}

TEST(BodyForces, LeaveACrackAlongThemAlone) {
  Plate plain(hanging_plate(0, false)), heavy(hanging_plate(6 * tension, false)),
      loaded(hanging_plate(6 * tension, true));
  print("plate without weight", plain.hold());
  print("with weight", heavy.hold());
  print("with weight as a load", loaded.hold());
  for (const int contour : {4, 8, 16})
    for (const size_t tip : {0, 1}) {
      const Tip without = plain.tip(contour, JMethod::fijc_adaptive, tip),
                with = heavy.tip(contour, JMethod::fijc_adaptive, tip),
                by_load = loaded.tip(contour, JMethod::fijc_adaptive, tip);
      const std::string what =
          fmt::format("crack along the weight, {} tip, {} cells", tip == 0 ? "lower" : "upper", contour);
      report(what + ": J over that without", with.J / without.J, "1 +- 0.02");
      report(what + ": M_I over that without", with.M_I / without.M_I, "1 +- 0.01");
      EXPECT_NEAR(with.J, without.J, 0.02 * without.J);
      EXPECT_NEAR(with.M_I, without.M_I, 0.01 * without.M_I);
      EXPECT_NEAR(with.M_II, 0, 0.01 * without.M_I);
      EXPECT_NEAR(by_load.J, with.J, 1e-6 * with.J);
      EXPECT_NEAR(by_load.M_I, with.M_I, 1e-6 * with.M_I);
    }
}

/// Behind a bend the known fields change sign across the crack, and so does their work on what acts in between.
TEST(BodyForces, ActOnBothSidesOfABend) {
  constexpr double h = 1 * mm, arm = 3 * h;
  Scene s = hanging_plate(6 * tension, false);
  const Vec2 bend{0, a - arm}, aside{arm * std::numbers::sqrt2 / 2, arm * std::numbers::sqrt2 / 2};
  s.cracks[0].points = {{0, -a}, bend, bend + aside};
  Plate plate(s);
  print("with weight", plate.hold());
  const Tip near = plate.tip(4, JMethod::fijc_adaptive, 1);
  for (const int contour : {8, 16}) {
    const Tip far = plate.tip(contour, JMethod::fijc_adaptive, 1);
    const std::string what = fmt::format("kinked crack in a plate with weight, {} cells", contour);
    report(what + ": M_I over that by 4 cells", far.M_I / near.M_I, "1 +- 0.02");
    report(what + ": M_II less that by 4 cells, over M_I", (far.M_II - near.M_II) / near.M_I, "0 +- 0.02");
    EXPECT_NEAR(far.M_I, near.M_I, 0.02 * near.M_I);
    EXPECT_NEAR(far.M_II, near.M_II, 0.02 * near.M_I);
  }
}

/// What falls freely bears no weight: inertia and body force cancel, in small contours, too.
TEST(BodyForces, AreNothingToACrackThatFallsWithThem) {
  constexpr int steps = 600, last = 100;
  double J[2][2] = {}, M_I[2][2] = {};
  for (const bool falls : {false, true}) {
    Scene s = hanging_plate(falls ? 2 * tension : 0, false);
    if (falls)
      s.loads.pop_back();  // what it hangs by
    s.grid_damping = {};
    s.fracture.area = AreaTerm::always;  // both are pulled at once, and ring
    Plate plate(s);
    for (int step = 0; step < steps; ++step)
      for (const size_t end : {0, 1}) {
        const Tip tip = plate.tip(4, JMethod::fijc_adaptive, end);
        if (step >= steps - last) {
          J[falls][end] += tip.J / last;
          M_I[falls][end] += tip.M_I / last;
        }
      }
    EXPECT_EQ(plate.simulation().state.ledger.momentum.impulse.y < 0, falls);
  }
  for (const size_t end : {0, 1}) {
    const std::string what = fmt::format("crack in a plate that falls, {} tip", end == 0 ? "lower" : "upper");
    report(what + ": J over that of one at rest", J[1][end] / J[0][end], "1 +- 0.01");
    report(what + ": M_I over that of one at rest", M_I[1][end] / M_I[0][end], "1 +- 0.01");
    EXPECT_NEAR(J[1][end], J[0][end], 0.01 * J[0][end]);
    EXPECT_NEAR(M_I[1][end], M_I[0][end], 0.01 * M_I[0][end]);
  }
}

/// What acts on the solid around one tip is no matter at another.
TEST(BodyForces, ActAtTheTipsThatTheyAreNear) {
  Scene s = hanging_plate(0, false);
  Plate far(s);
  const std::vector<Vec2> tips{{0, -a}, {0, a}};
  far.tip(4);
  const BodyForces none = body_forces_near(far.simulation(), tips, 4 * mm);
  EXPECT_FALSE(none.act_at(0) || none.act_at(1));
  Load load;
  load.name = "upper";
  load.kind = Load::Kind::acceleration;
  load.region = Rectangle{{-2 * mm, a - 2 * mm}, {2 * mm, a + 2 * mm}};
  load.value[0] = TimeFunction{7, {}, ""};
  s.loads.push_back(load);
  Plate near(s);
  near.tip(4);
  const BodyForces some = body_forces_near(near.simulation(), tips, 4 * mm);
  EXPECT_FALSE(some.act_at(0));
  EXPECT_TRUE(some.act_at(1));
  ASSERT_EQ(some.some.size(), 64U);
  EXPECT_NEAR(some.on(some.some[0].first).x, 7, 1e-12);
  EXPECT_EQ(some.on(some.some[0].first - 1).x, 0);
}

}  // namespace
}  // namespace riven
