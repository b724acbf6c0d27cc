// J and K of the plates of Nairn and Aimene, "Modeling multiple crack propagation in the material point method by
// J-integral methods accounting for other cracks intersecting the J contour", sections 3.1, 3.2 and 3.4, against
// converged finite elements.
//
// The tests that run by default take cells of 1 mm, where a case of the paper has at least five of them between crack
// and crack; but the strip, whose J tells how long a crack is to the grid, those of the shipped scene. The tables at
// the resolution of the shipped scenes, half an hour in all, are printed by
//   test_physics --gtest_also_run_disabled_tests --gtest_filter='FractureTables*'
#include <memory>

#include "tests/physics/plates.hpp"

namespace riven {
namespace {

using namespace gates;

const std::string coarse = "grid.cell=1 mm";
constexpr double mm = 1e-3;

// ---- one edge crack ------------------------------------------------------------------------------------------

void expect_edge_crack(Plate& plate, const std::vector<std::pair<int, double>>& contours) {
  constexpr double alone = 13403.1;  // J/m^2
  print("edge crack", plate.hold());
  for (const auto& [contour, limit] : contours) {
    const Tip tip = plate.tip(contour);
    const std::string what = fmt::format("edge crack, contour of {} cells", contour);
    expect_J(what, tip.J, alone, limit);
    report(what + ": K_II over K_I", tip.K_II / tip.K_I, "0.01");
    report(what + ": K_I by the interaction integral over sqrt(J E), less 1", tip.M_I / std::sqrt(tip.J * 2.5e9) - 1,
           "0.02");
    EXPECT_LT(std::abs(tip.K_II / tip.K_I), 0.01);
    EXPECT_LT(std::abs(tip.M_II / tip.K_I), 0.01);
    EXPECT_LT(std::abs(tip.M_I / std::sqrt(tip.J * 2.5e9) - 1), 0.02);
  }
}

TEST(FractureGates, EdgeCrackAlone) {
  Plate plate("sent", {coarse});
  expect_edge_crack(plate, {{4, 0.04}, {8, 0.02}, {16, 0.02}});
}

TEST(FractureTables, DISABLED_EdgeCrackAlone) {
  Plate plate("sent");
  expect_edge_crack(plate, {{4, 0.025}, {8, 0.015}, {16, 0.015}});
}

// ---- a crack across its way ----------------------------------------------------------------------------------

/// J where the faces of V, at x = b, pass through each other, and where they meet without friction.
struct Crossing {
  double b;                   ///< mm
  double free, frictionless;  ///< J/m^2
};
constexpr Crossing crossings[] = {{10, 13218.28, 13122.44}, {15, 11579.00, 11471.77}, {20, 7110.633, 7110.633},
                                  {23, 3033.076, 3033.076}, {27, 12770.64, 12770.64}, {30, 12771.87, 12771.87},
                                  {35, 13708.21, 13708.21}, {40, 13853.72, 13853.72}};

std::unique_ptr<Plate> plate_with_V(double b, std::vector<std::string> settings) {
  settings.push_back(fmt::format("crack.V.origin.0={} mm", b));
  return std::make_unique<Plate>("sent_h_and_v", settings);
}

/// Every point within 5 % of its reference with 4 cells and 6 % with 16, root mean square at most 3 %.
void expect_crossings(const std::vector<Crossing>& cases, const std::vector<std::string>& settings, bool meet,
                      double near, double far, double rms) {
  double squares[2] = {0, 0};
  for (const Crossing& c : cases) {
    const auto plate = plate_with_V(c.b, settings);
    const std::string what = fmt::format("V at b/w = {:.2f}, {}", c.b / 50, meet ? "frictionless" : "no contact");
    print(what, plate->hold());
    const double reference = meet ? c.frictionless : c.free;
    const double J[2] = {plate->tip(4).J, plate->tip(16).J};
    expect_J(what + ", 4 cells", J[0], reference, near);
    expect_J(what + ", 16 cells", J[1], reference, far);
    for (int k : {0, 1})
      squares[k] += std::pow(J[k] / reference - 1, 2) / static_cast<double>(cases.size());
    const double least = plate->least_opening(1) / mm;
    report(what + ": least opening of V, mm", least, meet ? "-0.02" : "none");
    if (meet) {
      EXPECT_GT(least, -0.02) << what;
    } else {
      EXPECT_LT(least, -0.02) << what << ": overlap is what contact prevents";
    }
  }
  for (int k : {0, 1}) {
    report(fmt::format("H and V: root mean square, {} cells", k == 0 ? 4 : 16), std::sqrt(squares[k]),
           fmt::format("{}", rms));
    EXPECT_LT(std::sqrt(squares[k]), rms);
  }
}

TEST(FractureGates, CrackAcross) {
  expect_crossings({crossings[1], crossings[2], crossings[5]}, {coarse}, true, 0.05, 0.06, 0.05);
}

TEST(FractureTables, DISABLED_CrackAcross) {
  expect_crossings({std::begin(crossings), std::end(crossings)}, {}, true, 0.05, 0.06, 0.03);
  expect_crossings({crossings[0], crossings[1]}, {"contact.law=ignored"}, false, 0.05, 0.06, 0.03);
}

TEST(FractureTables, DISABLED_CrackAcrossOnQuarterMillimetreCells) {
  expect_crossings({crossings[3], crossings[4]}, {"grid.cell=0.25 mm"}, true, 0.025, 0.025, 0.025);
}

/// The references are those of small strains. Finite elements of the same plate at finite strains, with the same law,
/// give 0.989 of them without V and 0.965, 0.961, 1.016, 1.004 and 0.993 at b/w = 0.4, 0.46, 0.54, 0.6 and 0.7 under
/// the whole load. Under a tenth of it they give the references within 0.2 % (without V, at 0.54 and 0.6), so that a
/// tenth shows what is the method's own error.
void expect_crossings_at_small_load(std::vector<Crossing> small, std::vector<std::string> settings, double most,
                                    double rms) {
  for (Crossing& c : small)
    c = {c.b, 0.01 * c.free, 0.01 * c.frictionless};
  settings.insert(settings.end(), {"grip.top.velocity_y.value=0.3849 m/s", "grip.bottom.velocity_y.value=-0.3849 m/s"});
  expect_crossings(small, settings, true, most, most, rms);
}

/// 0.46 is off by 3.0 %, all others by at most 1.0 %.
TEST(FractureTables, DISABLED_CrackAcrossAtSmallLoad) {
  expect_crossings_at_small_load({std::begin(crossings), std::end(crossings)}, {}, 0.035, 0.015);
}

TEST(FractureTables, DISABLED_CrackAcrossAtSmallLoadOnQuarterMillimetreCells) {
  expect_crossings_at_small_load({crossings[3], crossings[4]}, {"grid.cell=0.25 mm"}, 0.025, 0.025);
}

/// Without the faces of V, J is too low where V is ahead of the tip (eq. 13) and too high where it is behind (eq. 14),
/// the more so the larger the contour.
void expect_errors_without_faces(const std::vector<std::string>& settings, int step) {
  for (const Crossing& c : {crossings[3], crossings[4]}) {
    const auto plate = plate_with_V(c.b, settings);
    plate->hold();
    double before = 0;
    for (const int contour : {2 * step, 3 * step, 4 * step}) {
      const double whole = plate->tip(contour, JMethod::fijc).J,
                   error = plate->tip(contour, JMethod::pijc).J / whole - 1;
      report(fmt::format("V at b/w = {:.2f}, {} cells: J without its faces over J, less 1", c.b / 50, contour), error,
             c.b > 25 ? "below 0, falling" : "above 0, rising");
      EXPECT_LT((c.b > 25 ? 1 : -1) * (error - before), 0);
      before = error;
    }
  }
}

TEST(FractureGates, FacesLeftOutAreMissed) {
  expect_errors_without_faces({coarse}, 6);
}

TEST(FractureTables, DISABLED_FacesLeftOutAreMissed) {
  expect_errors_without_faces({}, 8);
}

// ---- a crack along the whole plate -----------------------------------------------------------------------------

/// J of the strip with the tip, whatever part of the other strip is in the contour. By eq. 13 and the strip's energy
/// along its edge (finite elements of four nodes, graded to 0.02 mm at the tip) 0.917 and 0.743 of it are left for
/// contours of 8 and 16 mm without the faces of V; the paper's 0.943 and 0.773 are its run's.
TEST(FractureGates, Strip) {
  Plate plate("strip_patch");
  print("strip", plate.hold());
  for (const int contour : {4, 8, 16, 32})
    expect_J(fmt::format("strip, {} cells", contour), plate.tip(contour).J, 13286.7, 0.04);
  for (const auto& [contour, left] : {std::pair{16, 0.917}, {32, 0.743}}) {
    const double J = plate.tip(contour, JMethod::pijc).J / 13286.7;
    report(fmt::format("strip, {} cells, without the faces: J over its reference", contour), J,
           fmt::format("{} +- 0.02", left));
    EXPECT_NEAR(J, left, 0.02);
  }
}

/// The same at a tenth of the load: ends that move by 0.05 mm leave the ligament where it was on the grid, while 0.5 mm
/// move it by 0.4 mm.
void expect_strip_at_small_load(const std::vector<std::string>& settings, double limit) {
  std::vector<std::string> all = settings;
  all.insert(all.end(), {"grip.top.velocity_y.value=0.3849 m/s", "grip.bottom.velocity_y.value=-0.3849 m/s"});
  Plate plate("strip_patch", all);
  print("strip, a tenth of the load", plate.hold());
  for (const int contour : {4, 8, 16, 32})
    expect_J(fmt::format("strip, a tenth of the load, {} cells", contour), plate.tip(contour).J, 132.867, limit);
  for (const auto& [contour, left] : {std::pair{16, 0.917}, {32, 0.743}}) {
    const double J = plate.tip(contour, JMethod::pijc).J / 132.867;
    report(fmt::format("strip, a tenth of the load, {} cells, without the faces: J over its reference", contour), J,
           fmt::format("{} +- 0.02", left));
    EXPECT_NEAR(J, left, 0.02);
  }
}

TEST(FractureTables, DISABLED_StripAtSmallLoad) {
  expect_strip_at_small_load({}, 0.04);
}

TEST(FractureTables, DISABLED_StripBehindTheTip) {
  Plate plate("strip_patch", {"crack.V.origin.0=30 mm"});
  print("strip, V behind the tip", plate.hold());
  for (const int contour : {4, 8, 16, 32})
    expect_J(fmt::format("strip, V behind the tip, {} cells", contour), plate.tip(contour).J, 2694.6, 0.06);
}

// ---- two tips in one contour -----------------------------------------------------------------------------------

/// The same J for all contours; without adaptation next to nothing of it once both tips are inside.
void expect_same_for_all_contours(Plate& plate) {
  plate.hold();
  const double J = plate.tip(4).J;
  for (int contour = 4; contour <= 20; contour += 2)
    expect_J(fmt::format("two tips, {} cells", contour), plate.tip(contour).J, J, 0.03);
  for (int contour = 14; contour <= 20; contour += 2) {
    const double all = plate.tip(contour, JMethod::fijc).J / J;
    report(fmt::format("two tips, {} cells around both, J over that by 4 cells", contour), all, "0.05");
    EXPECT_LT(std::abs(all), 0.05);
  }
}

/// Six cells between the tips, as the scene has.
TEST(FractureGates, TwoTips) {
  Plate plate("dent", {coarse, "crack.left.points.1.0=22 mm", "crack.right.points.0.0=28 mm"});
  expect_same_for_all_contours(plate);
}

TEST(FractureTables, DISABLED_TwoTips) {
  Plate plate("dent");
  expect_same_for_all_contours(plate);
  const double J = plate.tip(4).J;
  report("two tips, 4 cells: J / (J/m^2)", J, "20279 - 3 % to 21954 + 4 %");
  EXPECT_GT(J, 0.97 * 20279);
  EXPECT_LT(J, 1.04 * 21954);
}

void expect_two_tips_on_quarter_millimetre_cells(std::vector<std::string> settings, double reference) {
  settings.emplace_back("grid.cell=0.25 mm");
  Plate plate("dent", settings);
  print("two tips", plate.hold());
  for (const int contour : {4, 8, 16})
    expect_J(fmt::format("two tips, cells of 0.25 mm, {} cells", contour), plate.tip(contour).J, reference, 0.03);
}

TEST(FractureTables, DISABLED_TwoTipsOnQuarterMillimetreCells) {
  expect_two_tips_on_quarter_millimetre_cells({}, 20279);
}

/// A tenth of the load, as the reference is one of small strains: off by 1.5, 1.1 and 1.0 %, where the whole load,
/// which moves each end by 0.5 mm above a ligament of 3 mm, gives 4.0, 2.7 and 2.3 %.
TEST(FractureTables, DISABLED_TwoTipsAtSmallLoadOnQuarterMillimetreCells) {
  expect_two_tips_on_quarter_millimetre_cells(
      {"grip.top.velocity_y.value=0.3849 m/s", "grip.bottom.velocity_y.value=-0.3849 m/s"}, 202.79);
}

}  // namespace
}  // namespace riven
