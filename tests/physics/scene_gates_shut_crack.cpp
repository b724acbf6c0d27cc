// A slanted crack that is pressed shut and slides: J and K with and without friction.
//
// In a wide plate under compression p, a crack of length 2 a at 45 degrees bears p/2 across it and p/2 along it; faces
// with friction mu take mu p/2 of the latter up, and K_I = 0, K_II = (1 - mu) (p/2) sqrt(pi a) (J.B. Walsh, J. Geophys.
// Res. 70 (1965) 399-411). The width of the plate makes the same of all, so that J falls by (1 - mu)^2 exactly.
#include <numbers>

#include "tests/physics/plates.hpp"

namespace riven {
namespace {

using namespace gates;

constexpr double mm = 1e-3, p = 1e6, E = 2500e6;

double rise(double time) {
  return time < ramp ? 0.5 * (1 - std::cos(std::numbers::pi * time / ramp)) : 1;
}

/// `a`: half the crack's length.
Scene pressed_plate(double friction, double a) {
  Scene s =
      shipped("sent", {"grid.cell=1 mm", "grid.lower=[\"-34 mm\", \"-56 mm\"]", "grid.upper=[\"54 mm\", \"56 mm\"]",
                       "contact.law=coulomb", fmt::format("contact.friction={}", friction)});
  s.grips.clear();
  s.grid_damping = TimeFunction{60e3, {}, ""};  // 1/s, all along: friction would hold what overshoots
  s.bodies[0].region = Rectangle{{-30 * mm, -30 * mm}, {30 * mm, 30 * mm}};
  const Vec2 t = std::sqrt(0.5) * Vec2{1, 1};
  s.cracks[0].points = {-a * t, a * t};
  for (const double side : {-1., 1.}) {
    Load load;
    load.name = side > 0 ? "top" : "bottom";
    load.region = side > 0 ? Rectangle{{-30 * mm, 28 * mm}, {30 * mm, 30 * mm}}
                           : Rectangle{{-30 * mm, -30 * mm}, {30 * mm, -28 * mm}};
    load.value[1] = TimeFunction{-side * p * 60 * mm * s.thickness, rise, ""};
    s.loads.push_back(load);
  }
  return s;
}

/// J, K_I and K_II over some steps: nodes along faces without friction take turns in bearing the pressure, step by
/// step, and K_I of one step is off by up to 7 % of K_II to either side.
Tip mean_tip(Plate& plate, int contour, JMethod method = JMethod::fijc_adaptive) {
  constexpr int steps = 40;
  Tip mean;
  for (int k = 0; k < steps; ++k) {
    const Tip now = plate.tip(contour, method);
    mean.J += now.J / steps;
    mean.M_I += now.M_I / steps;
    mean.M_II += now.M_II / steps;
  }
  return mean;
}

TEST(ShutCrack, SlidesAgainstItsFriction) {
  constexpr double friction = 0.3, a = 8 * mm, K_II = 0.5 * p * 0.158533;  // sqrt(pi a)
  double J_free = 0;
  for (const double mu : {0., friction}) {
    Plate plate(pressed_plate(mu, a));
    print("shut crack", plate.hold());
    for (const int contour : {4, 8, 12}) {
      const Tip tip = mean_tip(plate, contour);
      const double J = mean_tip(plate, contour, JMethod::fijc).J;  // by its own integral
      const double share = (1 - mu) * K_II;
      const std::string what = fmt::format("shut crack, friction {}, {} cells", mu, contour);
      report(what + ": K_II over that of a wide plate", std::abs(tip.M_II) / share, "none");
      report(what + ": K_I over it", tip.M_I / share, "0.05");
      report(what + ": sqrt(J E) over K_II", std::sqrt(J * E) / std::abs(tip.M_II), "1 +- 0.04");
      EXPECT_NEAR(tip.M_I, 0, 0.05 * share);
      EXPECT_NEAR(std::sqrt(J * E), std::abs(tip.M_II), 0.04 * std::abs(tip.M_II));
    }
    const double J = mean_tip(plate, 8).J;
    if (mu == 0) {
      J_free = J;
    } else {
      report("shut crack: J with friction over that without", J / J_free, "(1 - mu)^2 = 0.49 +- 5 %");
      EXPECT_NEAR(J / J_free, (1 - mu) * (1 - mu), 0.05 * (1 - mu) * (1 - mu));
    }
  }
}

/// With 10 cells along half the crack, and beside a large coefficient, too, where little of K_II is left.
TEST(ShutCrack, SlidesAsFarAsItsFrictionLetsIt) {
  constexpr double a = 10 * mm;
  const auto K_II = [&](double mu) {
    Plate plate(pressed_plate(mu, a));
    plate.hold();
    return std::abs(mean_tip(plate, 8).M_II);
  };
  const double free = K_II(0);
  for (const double mu : {0.1, 0.3, 0.5, 0.7}) {
    const double K = K_II(mu) / free / (1 - mu);
    report(fmt::format("shut crack of 20 cells, friction {}: K_II over (1 - mu) times that without", mu), K,
           "1 +- 0.06");
    EXPECT_NEAR(K, 1, 0.06) << mu;
  }
}

/// Faces that are held may bear less than they could, and what they do bear is to be found wherever the tip lies
/// between nodes: on one, and at 0.3 cells from one.
TEST(ShutCrack, HoldsWhatItsFrictionBearsWhereverItsTipLies) {
  constexpr double friction = 0.3;
  for (const double along : {5.3 * mm, 6 * mm}) {
    double K_II[2] = {};
    for (const double mu : {0., friction}) {
      Plate plate(pressed_plate(mu, std::sqrt(2.) * along));
      print("held crack", plate.hold());
      K_II[mu > 0] = std::abs(mean_tip(plate, 8).M_II);
    }
    report(fmt::format("held crack, tip {:.1f} cells from a node: K_II over that without friction", along / mm),
           K_II[1] / K_II[0], "1 - mu = 0.7 +- 5 %");
    EXPECT_NEAR(K_II[1] / K_II[0], 1 - friction, 0.05 * (1 - friction));
  }
}

/// A pressure P between the faces bears a part of what presses on them, and friction is that of the rest:
/// K_II = (p/2 - mu (p/2 - P)) sqrt(pi a). A pressure of 0 changes nothing.
TEST(ShutCrack, BearsFrictionBesideAPressure) {
  constexpr double friction = 0.6, a = 8 * mm;
  const auto K_II = [&](double mu, double P) {
    Scene s = pressed_plate(mu, a);
    s.cracks[0].traction = TractionSettings{};
    s.cracks[0].traction->pressure = {P, rise, ""};
    Plate plate(s);
    plate.hold();
    return std::abs(mean_tip(plate, 8).M_II);
  };
  const double free = K_II(0, 0);
  for (const double P : {0., 0.2 * p}) {
    const double share = 1 - friction * (1 - 2 * P / p), K = K_II(friction, P) / free / share;
    report(fmt::format("shut crack, friction 0.6, pressure {} p: K_II over what friction leaves", P / p), K,
           "1 +- 0.06");
    EXPECT_NEAR(K, 1, 0.06) << P;
  }
}

/// Waves open and shut a crack, whose faces bounce and seldom all touch at once. K_I is never less than 0 by that;
/// where faces may overlap it is.
TEST(ShutCrack, HasNoNegativeKIInWaves) {
  constexpr double a = 8 * mm, K = 0.5 * p * 0.158533, period = 0.1e-3;  // sqrt(pi a)
  for (const ContactLaw law : {ContactLaw::frictionless, ContactLaw::ignored}) {
    Scene s = pressed_plate(0, a);
    s.contact.law = law;
    s.grid_damping = {};
    for (const size_t end : {0, 1})
      s.loads[end].value[1].shape = [](double t) { return -std::sin(2 * std::numbers::pi * t / period); };
    Plate plate(s);
    double least = 0, most = 0;
    for (int k = 0; k < 400; ++k) {
      const double K_I = plate.tip(4).K_I;
      least = std::min(least, K_I);
      most = std::max(most, K_I);
    }
    const bool apart = law == ContactLaw::frictionless;
    report(fmt::format("crack in waves, faces {}: least K_I over that of the load", apart ? "kept apart" : "overlap"),
           least / K, apart ? "0" : "below -0.5");
    EXPECT_GT(most, 0.5 * K);
    if (apart)
      EXPECT_EQ(least, 0);
    else
      EXPECT_LT(least, -0.5 * K);
  }
}

/// What is pressed straight onto a crack, be it by waves, does nothing to it: J is the difference of energies that are
/// large beside it, and K are not to have their size by that.
TEST(ShutCrack, HasNoKUnderWhatPressesStraightOnIt) {
  constexpr double a = 8 * mm, K = p * 0.158533;  // sqrt(pi a)
  Scene s = pressed_plate(0, a);
  s.grid_damping = {};
  s.cracks[0].points = {{-a, 0.1 * mm}, {a, 0.1 * mm}};
  for (const size_t end : {0, 1})
    s.loads[end].value[1].shape = [](double t) { return std::min(1.0, t / (0.1 * ramp)); };
  Plate plate(s);
  double most = 0, most_J = 0, by_integral = 0;
  for (int k = 0; k < 400; ++k) {
    const Tip tip = plate.tip(4);
    EXPECT_EQ(tip.K_I, 0);
    most = std::max(most, std::abs(tip.K_II));
    most_J = std::max(most_J, std::abs(tip.J));
    by_integral = std::max(by_integral, std::abs(plate.tip(4, JMethod::fijc).J));
  }
  report("crack under what presses straight on it: root of most J by its own integral", std::sqrt(by_integral * E) / K,
         "none");
  report("crack under what presses straight on it: most K_II over p sqrt(pi a)", most / K, "0.02");
  report("crack under what presses straight on it: root of most J", std::sqrt(most_J * E) / K, "0.02");
  EXPECT_LT(most, 0.02 * K);
  EXPECT_LT(std::sqrt(most_J * E), 0.02 * K);
}

/// A pressure within that is less than what presses the faces together opens nothing, and the crack slides as without.
TEST(ShutCrack, StaysShutUnderLittlePressure) {
  constexpr double a = 8 * mm;
  double K_II[2] = {};
  for (const double share : {0., 0.2}) {
    Scene s = pressed_plate(0, a);
    if (share > 0) {
      TractionSettings inside;
      inside.pressure = {share * p, rise, ""};
      s.cracks[0].traction = inside;
    }
    Plate plate(s);
    print("crack under pressure that stays shut", plate.hold());
    const Tip tip = mean_tip(plate, 8, JMethod::fijc);
    K_II[share > 0] = std::abs(tip.M_II);
    report(fmt::format("shut crack, {:.0f} % of the load within: K_I over K_II", 100 * share),
           tip.M_I / std::abs(tip.M_II), "0.05");
    report(fmt::format("shut crack, {:.0f} % of the load within: sqrt(J E) over K_II", 100 * share),
           std::sqrt(tip.J * E) / std::abs(tip.M_II), "1 +- 0.04");
    EXPECT_NEAR(tip.M_I, 0, 0.05 * std::abs(tip.M_II));
    EXPECT_NEAR(std::sqrt(tip.J * E), std::abs(tip.M_II), 0.04 * std::abs(tip.M_II));
  }
  report("shut crack, 20 % of the load within: K_II over that without", K_II[1] / K_II[0], "1 +- 0.04");
  EXPECT_NEAR(K_II[1] / K_II[0], 1, 0.04);
}

/// Wings on the ends of a crack, along the pressure, open as it slides. With the pressed faces behind the bend, and the
/// stresses beside its corner, in the contour J of those of 4 mm would be 0.42 times (6 cells) to -1.8 times (12 cells)
/// what it is: that by 8 cells half as large, all before the bend. Those of 1 mm, a cell, have no room for such a
/// contour and take the smallest; 4 cells a quarter as large say what they release.
TEST(ShutCrack, DrivesItsWings) {
  constexpr double a = 8 * mm, J_long = 1.120, J_short = 2.426;  // J/m^2
  const auto winged = [&](double length) {
    Scene s = pressed_plate(0, a);
    const Vec2 corner = s.cracks[0].points[1], tip = corner + length * Vec2{-0.44629, 0.89489};
    s.cracks[0].points = {-tip, -corner, corner, tip};
    return s;
  };
  Plate plate(winged(4 * mm)), small(winged(1 * mm));
  print("wings of 4 mm", plate.hold());
  print("wings of 1 mm", small.hold());
  for (const int contour : {4, 6, 12}) {
    const double J = mean_tip(plate, contour).J;
    report(fmt::format("wings of 4 mm, {} cells: J over that by smaller cells", contour), J / J_long, "1 +- 0.05");
    report(fmt::format("wings of 1 mm, {} cells: J over that by smaller cells", contour),
           mean_tip(small, contour).J / J_short, "none");
    EXPECT_NEAR(J, J_long, 0.05 * J_long);
  }
  EXPECT_EQ(plate.simulation().fracture.bent, 0);
  EXPECT_GT(small.simulation().fracture.bent, 0);
}

}  // namespace
}  // namespace riven
