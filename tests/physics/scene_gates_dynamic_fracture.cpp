// Stress intensities of cracks that waves meet, held against finite elements and a closed form (Y. Guo and J.A. Nairn,
// "Calculation of J-integral and stress intensity factors using the material point method", sections 4.2 to 4.4).
#include <numbers>

#include "tests/physics/tip_history.hpp"

namespace riven {
namespace {

using namespace gates;

constexpr double us = 1e-6;
double K_I(const Tip& t) {
  return t.K_I;
}
double K_II(const Tip& t) {
  return t.K_II;
}

/// Largest and root-mean-square of a difference over times.
struct Difference {
  double most = 0, at = 0, squares = 0;
  int count = 0;
  void add(double t, double d) {
    if (std::abs(d) > most) {
      most = std::abs(d);
      at = t;
    }
    squares += d * d;
    ++count;
  }
  double rms() const { return std::sqrt(squares / count); }
};

/// First time after `from` at which a curve passes a value.
double passes(const Curve& c, double value, double from, double to) {
  double t = from;
  while (t < to && c(t) < value)
    t += 1e-3 * us;
  return t;
}

FractureRules rules(int contour, AreaTerm area) {
  FractureRules r;
  r.asked = true;
  r.contour = contour;
  r.area = area;
  return r;
}

// The reference is K_I / (sigma sqrt(pi a)) of explicit finite elements (cells of 0.05 mm, interaction integral). Both
// curves are running means over 0.2 us; the wave's arrival, from 2.6 to 3.0 us, is held by its time alone.
TEST(CctDynamic, FollowsFiniteElements) {
  const Curve expected = reference("cct_dynamic.csv");
  Scene scene = shipped("cct_dynamic", {"solver.time=11.8 us"});
  const double scale = 400e6 * std::sqrt(std::numbers::pi * 2.4e-3);
  const auto history = run_with(scene, {rules(4, AreaTerm::never), rules(20, AreaTerm::always)});
  double peak = 0;
  for (double t = 5 * us; t < 8 * us; t += 0.01 * us)
    peak = std::max(peak, expected.mean(t, 0.2 * us));
  for (size_t k = 0; k < 2; ++k)
    for (size_t tip = 0; tip < 2; ++tip) {
      const Curve found = curve(history[k], tip, [=](const Tip& t) { return t.K_I / scale; });
      Difference d;
      for (double t = 0.2 * us; t <= 11.5 * us; t += 0.02 * us)
        if (t < 2.6 * us || t > 3 * us)
          d.add(t, found.mean(t, 0.2 * us) - expected.mean(t, 0.2 * us));
      const double late = passes(found, found(3 * us) / 2, 2.4 * us, 3.5 * us) -
                          passes(expected, expected(3 * us) / 2, 2.4 * us, 3.5 * us);
      const char* what = k == 0 ? "4 cells" : "20 cells with area term";
      report(fmt::format("CCT tip {}, {}, rms of K_I over the peak", tip, what), d.rms() / peak, "0.03");
      report(fmt::format("CCT tip {}, {}, largest, at {:.2f} us", tip, what, d.at / us), d.most / peak, "0.06");
      report(fmt::format("CCT tip {}, {}, passes half its value at 3 us late by, us", tip, what), late / us, "0.08");
      EXPECT_LT(d.rms(), 0.03 * peak);
      EXPECT_LT(d.most, 0.06 * peak);
      EXPECT_LT(std::abs(late), 0.08 * us);
    }
}

// K_I = 2 s sqrt(c_d t (1 - 2 nu) / pi) / (1 - nu), t after the arrival, with s = 800 MPa of two waves.
TEST(FreundStrip, FollowsTheClosedForm) {
  Scene scene = shipped("freund_strip");
  const PlaneElasticity solid(scene.materials[0], Plane::strain);
  const double arrival = 20e-3 / solid.dilatational_speed;
  Curve expected;
  for (double t = 0; t < 6 * us; t += 0.001 * us)
    expected.add(
        t, 2 * 800e6 * std::sqrt(solid.dilatational_speed * std::max(0.0, t - arrival) * 0.4 / std::numbers::pi) / 0.7);
  const auto history =
      run_with(scene, {rules(4, AreaTerm::never), rules(20, AreaTerm::always), rules(20, AreaTerm::never)});
  const char* names[3] = {"4 cells", "20 cells with area term", "20 cells without"};
  double worst[3];
  for (size_t k = 0; k < 3; ++k) {
    const Curve found = curve(history[k], 0, K_I);
    Difference d;
    for (double t = arrival + 0.5 * us; t <= arrival + 2.5 * us; t += 0.02 * us)
      d.add(t, found.mean(t, 0.2 * us) / expected.mean(t, 0.2 * us) - 1);
    worst[k] = d.most;
    report(fmt::format("Freund, {}, largest error from 0.5 to 2.5 us", names[k]), d.most,
           k < 2 ? "0.03" : "more than 0.1: the control");
  }
  EXPECT_LT(worst[0], 0.03);
  EXPECT_LT(worst[1], 0.03);
  EXPECT_GT(worst[2], 0.1);
}

// First extreme of K_II by explicit finite elements: -37.8 MPa m^0.5.
TEST(Denp, HasTheFirstExtremeOfModeTwoAndItsAreaTerm) {
  Scene scene = shipped("denp", {"solver.time=32 us"});
  const auto history =
      run_with(scene, {rules(4, AreaTerm::never), rules(20, AreaTerm::always), rules(20, AreaTerm::never)});
  const Curve found = curve(history[0], 0, K_II);
  double least = 0;
  for (double t = 20 * us; t < 31.5 * us; t += 0.1 * us)
    least = std::min(least, found(t));
  const PlaneElasticity solid(scene.materials[0], Plane::strain);
  const auto K_of_J = [&](const Tip& t) { return std::copysign(std::sqrt(solid.E * std::abs(t.J)), t.J); };
  const Curve small = curve(history[0], 0, K_of_J), large = curve(history[1], 0, K_of_J),
              without = curve(history[2], 0, K_of_J);
  Difference with_area, without_area;
  for (double t = 12 * us; t < 31.5 * us; t += 0.1 * us) {
    with_area.add(t, large(t) / small(t) - 1);
    without_area.add(t, without(t) / small(t) - 1);
  }
  report("DENP, first extreme of K_II, MPa m^0.5", 1e-6 * least, "-37.8 +- 5 %");
  report("DENP, 20 cells with area term against 4, after 12 us", with_area.most, "0.06");
  report("DENP, 20 cells without it", without_area.most, "more than 0.15: the control");
  EXPECT_NEAR(least, -37.8e6, 0.05 * 37.8e6);
  EXPECT_LT(with_area.most, 0.06);
  EXPECT_GT(without_area.most, 0.15);
}

// Section 4.4: K_I of cells of 0.25, 0.5 and 1 mm stays together, that of 2 mm does not. Running means over 0.2 us.
TEST(SentDynamic, HardlyDependsOnTheCell) {
  const auto K = [](const char* cell) {
    Scene scene = shipped("sent_dynamic", {fmt::format("grid.cell={}", cell)});
    return curve(run_tips(scene), 0, K_I);
  };
  const Curve fine = K("0.25 mm");
  double peak = 0;
  for (double t = 5 * us; t < 13 * us; t += 0.01 * us)
    peak = std::max(peak, fine.mean(t, 0.2 * us));
  report("SENT dynamic, peak of K_I over sigma sqrt(pi a)", peak / (400e6 * std::sqrt(std::numbers::pi * 5e-3)),
         "none");
  double rms[3], largest[3];
  const char* cells[3] = {"0.5 mm", "1 mm", "2 mm"};
  for (int k = 0; k < 3; ++k) {
    const Curve found = K(cells[k]);
    Difference d;
    double own = 0;
    for (double t = 2.5 * us; t < 13.5 * us; t += 0.02 * us) {
      d.add(t, found.mean(t, 0.2 * us) - fine.mean(t, 0.2 * us));
      own = std::max(own, found.mean(t, 0.2 * us));
    }
    rms[k] = d.rms() / peak;
    largest[k] = d.most / peak;
    report(fmt::format("SENT dynamic, {} cells against 0.25 mm, peak", cells[k]), own / peak - 1,
           k < 2 ? "0.04" : "none");
    report(fmt::format("SENT dynamic, {} cells, largest, at {:.2f} us", cells[k], d.at / us), largest[k],
           k < 2 ? "none" : "more than 0.1: visibly off");
    report(fmt::format("SENT dynamic, {} cells, rms", cells[k]), rms[k], k < 2 ? "0.04" : "none");
    if (k < 2) {
      EXPECT_NEAR(own, peak, 0.04 * peak) << cells[k];
    }
  }
  EXPECT_LT(rms[0], 0.04);
  EXPECT_LT(rms[1], 0.04);
  EXPECT_GT(largest[2], 0.1);
}

}  // namespace
}  // namespace riven
