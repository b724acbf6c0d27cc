// K_I and K_II of cracks that bend near their tips, and of those that another crack crosses there.
//
// References are of the same cracks in a wide plate, by displacement discontinuities that are constant on 40, 80 and
// 160 pieces of each straight part, denser towards its ends, and carried on to none (the last step is as large as the
// difference of the last two); directions are by segments of half a cell, each in that of the greatest hoop stress. The
// plate here is a disk of five times the crack's half length, which makes K of the straight crack 4 % larger and that
// of the bent ones much the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/physics/scene_gates.hpp"
#include "tests/physics/scenes.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace test;

constexpr double mm = 1e-3, MPa = 1e6, degree = std::numbers::pi / 180, half = 2 * mm, cell = 0.25 * mm;

/// Stresses along and across the straight part of the first crack, and shear.
struct Pull {
  double along, across, shear;
};

/// A disk of 20 mm in plane stress under stresses that rise for a time of `ramp`, turned by `angle` with all that is in
/// it, until it rests.
Scene disk_under(Pull pull, double angle, std::vector<CrackLine> lines, double ramp = 70e-6) {
  constexpr double radius = 5 * half, far = radius + 3 * cell;
  const double c = std::cos(angle), s = std::sin(angle);
  Scene scene = empty_scene(cell, {{-far, -far}, {far, far}});
  scene.materials = {{"plate", LawKind::linear_elastic, 2.5e9, 0.33, 1200}};
  scene.plane = Plane::stress;
  scene.transfer = Transfer::fmpm;
  scene.order = 2;
  scene.bodies = {body("disk", Disk{{0, 0}, radius})};
  for (CrackLine& line : lines)
    for (Vec2& x : line.points)
      x = {c * x.x - s * x.y, s * x.x + c * x.y};
  scene.cracks = std::move(lines);
  const double twist = 2 * c * s * pull.shear;
  const double xx = c * c * pull.along + s * s * pull.across - twist;
  const double yy = s * s * pull.along + c * c * pull.across + twist;
  const double xy = c * s * (pull.along - pull.across) + (c * c - s * s) * pull.shear;
  for (const Load::Edge edge : {Load::Edge::left, Load::Edge::right, Load::Edge::bottom, Load::Edge::top}) {
    const bool across = edge == Load::Edge::bottom || edge == Load::Edge::top;
    const double sign = edge == Load::Edge::right || edge == Load::Edge::top ? 1 : -1;
    Load load = traction_on(edge, Rectangle{{-far, -far}, {far, far}});
    const auto rise = [ramp](double t) { return std::min(t / ramp, 1.0); };
    load.value[0] = TimeFunction{sign * (across ? xy : xx), rise, ""};
    load.value[1] = TimeFunction{sign * (across ? yy : xy), rise, ""};
    scene.loads.push_back(load);
  }
  scene.grid_damping = constant(80e3);
  scene.end_time = 110e-6;
  scene.fracture.asked = true;
  return scene;
}

/// The same disk with a pressure of 8 MPa in all cracks instead: K are those under as much tension from all sides.
Scene disk_with_pressure(double angle, std::vector<CrackLine> lines) {
  constexpr double ramp = 70e-6;
  TractionSettings pressure;
  pressure.pressure = {8 * MPa,
                       [](double t) { return t < ramp ? 0.5 * (1 - std::cos(std::numbers::pi * t / ramp)) : 1; }, ""};
  for (CrackLine& line : lines)
    line.traction = pressure;
  Scene scene = disk_under({0, 0, 0}, angle, std::move(lines));
  scene.loads.clear();
  scene.contact.law = ContactLaw::frictionless;
  return scene;
}

/// The last tip of the first crack at the end.
Tip tip_of(const Scene& given, int contour) {
  const ChosenSpace space;
  Scene scene = given;
  scene.fracture.contour = contour;
  Simulation m(scene, space);
  while (!m.finished())
    m.step();
  for (const Tip& tip : m.state.tips)
    if (tip.crack == 0 && tip.last)
      return tip;
  return {};
}
StressIntensity K_of(const Tip& tip) {
  return {tip.K_I, tip.K_II};
}

/// Degrees: 0 in mode I, 90 in mode II.
double phase(StressIntensity K) {
  return std::atan2(K.II, K.I) / degree;
}
double size(StressIntensity K) {
  return std::hypot(K.I, K.II);
}

/// A crack with an arm of so many cells at either end, turned by so many degrees.
CrackLine kinked(double cells, double turn) {
  const Vec2 arm = cells * cell * Vec2{std::cos(turn * degree), std::sin(turn * degree)}, end{half, 0};
  return crack("kinked", {-end - arm, -end, end, end + arm});
}

/// Parts of so many cells that a crack goes on by at its last end, each in a direction of so many degrees.
CrackLine with_tail(std::vector<std::pair<double, double>> parts) {
  std::vector<Vec2> points{{-half, 0}, {half, 0}};
  for (const auto& [cells, direction] : parts)
    points.push_back(points.back() + cells * cell * Vec2{std::cos(direction * degree), std::sin(direction * degree)});
  return crack("bent", points);
}

/// A bent crack under a pull, with its references.
struct Bent {
  const char* what;
  CrackLine line;
  Pull pull;
  double angle;                 ///< degrees, of the grid
  double phase, over_straight;  ///< K over that of the straight crack
};

/// `disk_with`: a disk with these cracks.
template <class DiskWith>
void expect_J_and_K(const Bent& bent, std::initializer_list<int> contours, const DiskWith& disk_with) {
  const Tip straight = tip_of(disk_with({crack("straight", {{-half, 0}, {half, 0}})}), 8);
  for (const int contour : contours) {
    const Tip tip = tip_of(disk_with({bent.line}), contour);
    const StressIntensity K = K_of(tip);
    const double over = size(K) / size(K_of(straight)), over_by_J = std::sqrt(tip.J / straight.J);
    const auto what = fmt::format("{}, contour of {}", bent.what, contour);
    gates::report(what + ": atan K_II / K_I less its reference, degrees", phase(K) - bent.phase, "1.5");
    gates::report(what + ": K over that of the straight crack, over its reference, less 1",
                  over / bent.over_straight - 1, "0.03");
    gates::report(what + ": the same by the root of J", over_by_J / bent.over_straight - 1, "0.03");
    EXPECT_NEAR(phase(K), bent.phase, 1.5);
    EXPECT_NEAR(over, bent.over_straight, 0.03 * bent.over_straight);
    EXPECT_NEAR(over_by_J, bent.over_straight, 0.03 * bent.over_straight);
  }
}

void expect_J_and_K(const Bent& bent, std::initializer_list<int> contours) {
  const Pull pull{bent.pull.along * MPa, bent.pull.across * MPa, bent.pull.shear * MPa};
  expect_J_and_K(bent, contours,
                 [&](std::vector<CrackLine> lines) { return disk_under(pull, bent.angle * degree, std::move(lines)); });
}

// By the opening of the faces, across the bend, the phases are off by 7, 10, 5 and 5 degrees, and J is as if K were
// 0.81 and 0.96 of what it is in the first two.
TEST(BentCracks, HaveTheirJAndK) {
  expect_J_and_K({"arm of 0.6 cells", kinked(0.6, -53), {0, 0, 5}, 17, 19.95, 1.202}, {4, 8});
  expect_J_and_K({"arm of 2 cells", kinked(2, -53), {5, 5, 5}, 17, 0.3, 1.458}, {4, 8});
  expect_J_and_K({"arm of 1.5 cells", kinked(1.5, 30), {5, 5, 0}, 0, 12.6, 1.027}, {4, 8});
}

// The crack comes back towards its tip within the larger contour, which is to leave that out: J is 33 % low otherwise.
// The disk is part of this reference and the next.
TEST(BentCracks, HaveThemWhereTheyComeBack) {
  expect_J_and_K({"hook", with_tail({{3, 60}, {4, 120}}), {8, 5, 0}, 0, 33.96, 0.871}, {4, 12});
}

// What a pressure does on bent faces has its part in J and in the interaction integrals. By the opening, and by
// tractions along the crack alone, the phases were off by 15, 0 and 2.5 degrees, and the root of J by 11, 16 and 9 % by
// 12 cells.
TEST(BentCracks, HaveThemUnderPressure) {
  for (const Bent& bent :
       {Bent{"pressed arm of half a cell", with_tail({{0.5, 40}}), {}, 0, 19.86, 0.898},
        Bent{"pressed arm of 4 cells", with_tail({{4, 60}}), {}, 17, 25.52, 0.896},
        Bent{"pressed arc",
             with_tail({{1.2, 10}, {1.2, 20}, {1.2, 30}, {1.2, 40}, {1.2, 50}, {1.2, 60}, {1.2, 70}}),
             {},
             17,
             32.60,
             0.962}})
    expect_J_and_K(bent, {4, 12}, [&](std::vector<CrackLine> lines) {
      return disk_with_pressure(bent.angle * degree, std::move(lines));
    });
}

// The arm is pressed together while the crack behind the bend is open: K_I is nothing, whatever the stresses next to
// the tip, which are known no better than to a fraction of what the tip makes of them. The phase is 16 degrees off by
// these.
TEST(BentCracks, HaveThemWhereTheirArmIsPressedTogether) {
  expect_J_and_K({"pressed arm of 5 cells", with_tail({{5, 50}}), {-12, 6, 5}, 17, 90, 1.239}, {4, 8});
}

// Up to 2.5 cells long it is not resolved: by two cells K is 13 to 41 % too large.
TEST(BentCracks, WarnWhereAPressedArmIsShort) {
  for (const auto& [cells, told] : {std::pair{2.0, true}, {5.0, false}}) {
    const ChosenSpace space;
    const Scene s = disk_under({-8 * MPa, 6 * MPa, 5 * MPa}, 17 * degree, {with_tail({{cells, 75}})});
    Simulation m(s, space);
    while (!m.finished())
      m.step();
    EXPECT_EQ(m.fracture.bent > 0, told) << cells << " cells";
  }
}

// Directions of a crack that kinks and turns on across the pull, segment by segment. By the opening they swung by 10
// degrees, for 3 cells to one side and 3 to the other.
TEST(BentCracks, GrowInTheirDirection) {
  const std::vector<double> directions{-53.1, -55.3, -54.1, -53.6, -53.0, -52.4,
                                       -51.9, -51.5, -51.1, -50.8, -50.5, -50.2};
  for (const double angle : {0.0, 17 * degree}) {
    Scene scene =
        disk_under({10 * MPa, 10 * MPa, 10 * MPa}, angle, {crack("straight", {{-half, 0}, {half, 0}})}, 400e-6);
    scene.grid_damping = constant(20e3);
    scene.end_time = 400e-6;
    scene.fracture.contour = 8;
    scene.growth.emplace().toughness = 0.885 * MPa;  // Pa m^0.5
    scene.growth->speed_limit = 100;
    const ChosenSpace space;
    Simulation m(scene, space);
    const auto last = [&]() -> const Tip& {
      return *std::find_if(m.state.tips.begin(), m.state.tips.end(), [](const Tip& tip) { return tip.last; });
    };
    while (!m.finished() && last().length < 6.2 * cell)
      m.step();
    ASSERT_GE(last().length, 6 * cell);
    const Cracks& c = m.state.cracks;
    double sum = 0, worst = 0;
    std::vector<Vec2> path{c.plane0[c.end_point(0, true)]};
    for (int k = c.end_point(0, true) - 1; norm(c.plane0[k]) > 1.02 * half; --k)
      path.push_back(c.plane0[k]);
    path.push_back(half * Vec2{std::cos(angle), std::sin(angle)});
    std::reverse(path.begin(), path.end());
    // where the path is after so many lengths of half a cell
    const auto at = [&](size_t halves) {
      double left = 0.5 * cell * static_cast<double>(halves);
      size_t k = 0;
      while (k + 2 < path.size() && left > norm(path[k + 1] - path[k])) {
        left -= norm(path[k + 1] - path[k]);
        ++k;
      }
      return path[k] + (left / norm(path[k + 1] - path[k])) * (path[k + 1] - path[k]);
    };
    for (size_t k = 0; k < directions.size(); ++k) {
      const Vec2 way = at(k + 1) - at(k);
      const double off = (std::atan2(way.y, way.x) - angle) / degree - directions[k];
      sum += off * off;
      worst = std::max(worst, std::fabs(off));
    }
    const double rms = std::sqrt(sum / static_cast<double>(directions.size()));
    gates::report(fmt::format("kinked crack, grid turned by {:.0f} degrees: its direction off its reference, degrees, "
                              "root mean square",
                              angle / degree),
                  rms, "3");
    gates::report("and at most", worst, "8");
    EXPECT_LT(rms, 3);
    EXPECT_LT(worst, 8);
  }
}

// A crack that ends on another one within the contour. By its opening the phase of the second is 5.6 degrees off, and J
// by the larger contour up to 5 % in its root.
TEST(CrossedCracks, HaveThemWhereTheyEndOnOthers) {
  const Pull pull{6 * MPa, 10 * MPa, 3 * MPa};
  const double angle = 17 * degree;
  const Tip straight = tip_of(disk_under(pull, angle, {crack("straight", {{-half, 0}, {half, 0}})}), 8);
  struct Case {
    double cells, host, phase, over_straight;  ///< length of the crack, degrees of the other one
  };
  for (const Case& c : {Case{4, 90, 16.32, 0.5015}, Case{3, 60, 17.87, 0.4666}}) {
    const Vec2 arm = 6 * cell * Vec2{std::cos(c.host * degree), std::sin(c.host * degree)};
    const Scene scene =
        disk_under(pull, angle, {crack("on", {{0, 0}, {c.cells * cell, 0}}), crack("host", {-1 * arm, {0, 0}, arm})});
    for (const int contour : {4, 8}) {
      const Tip tip = tip_of(scene, contour);
      const auto what = fmt::format("crack of {} cells that ends on another one, contour of {}", c.cells, contour);
      const double off = phase(K_of(tip)) - c.phase, over = std::sqrt(tip.J / straight.J) / c.over_straight - 1;
      gates::report(what + ": atan K_II / K_I less its reference, degrees", off, "2");
      gates::report(what + ": root of J over that of the straight crack, over its reference, less 1", over, "0.03");
      EXPECT_NEAR(off, 0, 2);
      EXPECT_NEAR(over, 0, 0.03);
    }
  }
}

// The same with a pressure in both, and where they cross. What it does on the faces of the other one was missed: the
// root of J was 28 % too large where they cross, and 46 and 4 % where the one ends on the other. (By 4 cells, which end
// short of the crossing, the first is 4.7 % too large still, and by 10 the second is 3.4 % too small.)
TEST(CrossedCracks, HaveThemUnderPressure) {
  const CrackLine whole = crack("whole", {{-half, 0}, {half, 0}});
  struct Case {
    const char* what;
    CrackLine line;
    Vec2 place;           ///< where it meets the other one
    double angle, other;  ///< degrees, of the grid and of the other crack
    double phase, over_straight;
  };
  for (const Case& c :
       {Case{"crossed 2.4 cells behind the tip", whole, {1.4 * mm, 0}, 0, 90, 0, 0.590},
        Case{"of 3 cells from another one", crack("on", {{0, 0}, {3 * cell, 0}}), {}, 17, 90, 0, 0.302},
        Case{"of 4 cells from a slanted one", crack("on", {{0, 0}, {cell * 4, 0}}), {}, 17, 60, 12.37, 0.385}}) {
    const Vec2 arm = 6 * cell * Vec2{std::cos(c.other * degree), std::sin(c.other * degree)};
    const Tip straight = tip_of(disk_with_pressure(c.angle * degree, {whole}), 8);
    const Scene scene =
        disk_with_pressure(c.angle * degree, {c.line, crack("other", {c.place - arm, c.place, c.place + arm})});
    const Tip tip = tip_of(scene, 8);
    const auto what = fmt::format("crack under pressure, {}", c.what);
    const double off = phase(K_of(tip)) - c.phase, over = std::sqrt(tip.J / straight.J) / c.over_straight - 1;
    gates::report(what + ": atan K_II / K_I less its reference, degrees", off, "2");
    gates::report(what + ": root of J over that of the straight crack, over its reference, less 1", over, "0.03");
    EXPECT_NEAR(off, 0, 2);
    EXPECT_NEAR(over, 0, 0.03);
  }
}

// By the opening up to the other crack the phases are off by 6 degrees in the first two; J by its own integral is 30 %
// high and 47 % low behind the cracks that are shut, the last two. The stuck one, whose stresses are as if it were not
// there, is off most: by 2.3 degrees, and by 3.7 % in the root of J.
TEST(CrossedCracks, HaveTheirJAndModes) {
  const Vec2 place{1.4 * mm, 0};
  const CrackLine crossed = crack("crossed", {{-half, 0}, {half, 0}});
  struct Case {
    const char* what;
    Pull pull;
    double angle, across, arm;  ///< degrees of the grid and of the crack across, and half of its length
    ContactLaw law;
    double phase, over_straight;  ///< K over that of the crack that nothing crosses
    double degrees = 2, limit = 0.03;
  };
  for (const Case& c : {Case{"slanted", {12, 10, 5}, 17, 50, 1 * mm, ContactLaw::frictionless, 23.8, 0.844},
                        Case{"open", {10, 10, 0}, 0, 50, 1 * mm, ContactLaw::frictionless, 17.9, 0.618},
                        Case{"shut", {-6, 10, 3}, 17, 90, 1.5 * mm, ContactLaw::frictionless, 13.9, 0.836},
                        Case{"stuck", {-10, 10, 3}, 17, 60, 1.5 * mm, ContactLaw::stick, 16.4, 0.999, 2.5, 0.04}}) {
    const Pull pull{c.pull.along * MPa, c.pull.across * MPa, c.pull.shear * MPa};
    const Vec2 arm = c.arm * Vec2{std::cos(c.across * degree), std::sin(c.across * degree)};
    const Tip straight = tip_of(disk_under(pull, c.angle * degree, {crossed}), 8);
    Scene scene = disk_under(pull, c.angle * degree, {crossed, crack("across", {place - arm, place + arm})});
    scene.contact.law = c.law;
    for (const int contour : {4, 8}) {
      const Tip tip = tip_of(scene, contour);
      const auto what = fmt::format("{} crack 2.4 cells behind the tip, contour of {}", c.what, contour);
      const double off = phase(K_of(tip)) - c.phase, over = std::sqrt(tip.J / straight.J) / c.over_straight - 1;
      gates::report(what + ": atan K_II / K_I less its reference, degrees", off, fmt::format("{}", c.degrees));
      gates::report(what + ": root of J over that of the crack alone, over its reference, less 1", over,
                    fmt::format("{}", c.limit));
      EXPECT_NEAR(off, 0, c.degrees);
      EXPECT_NEAR(over, 0, c.limit);
    }
  }
}

// At rest, J of a shut crack that slides goes on as it was. Its faces bear friction up to the tip though their normals,
// off by some hundredths, make of how far they slide a thousandth of a cell by which they were apart: J went up by
// half.
TEST(CrossedCracks, BearFrictionWhereTheySlide) {
  const Vec2 place{1.4 * mm, 0}, arm = 1.5 * mm * Vec2{std::cos(60 * degree), std::sin(60 * degree)};
  Scene scene = disk_under({-10 * MPa, 10 * MPa, 3 * MPa}, 17 * degree,
                           {crack("open", {{-half, 0}, {half, 0}}), crack("shut", {place - arm, place + arm})});
  scene.contact.law = ContactLaw::coulomb;
  scene.contact.friction = 0.5;
  scene.fracture.contour = 8;
  scene.end_time = 170e-6;
  const ChosenSpace space;
  Simulation m(scene, space);
  const Tip& tip = *std::find_if(m.state.tips.begin(), m.state.tips.end(),
                                 [](const Tip& one) { return one.crack == 1 && one.last; });
  double before = 0;
  while (!m.finished()) {
    m.step();
    if (before == 0 && m.state.clock.time > 140e-6)
      before = tip.J;
  }
  gates::report("shut crack that slides across an open one: J at rest over what it was, less 1", tip.J / before - 1,
                "0.03");
  EXPECT_GT(before, 50);
  EXPECT_NEAR(tip.J / before, 1, 0.03);
}

}  // namespace
}  // namespace riven
