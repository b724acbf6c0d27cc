// J of a centre crack under pressure, alone and with a crack across (Nairn and Aimene, "Modeling multiple crack
// propagation in the material point method by J-integral methods accounting for other cracks intersecting the J
// contour", section 3.3), against converged finite elements with frictionless contact.
//
// The tests that run by default take cells of 1 mm. Those at the resolution of the shipped scenes, a quarter of an hour
// in all, are printed by
//   test_physics --gtest_also_run_disabled_tests --gtest_filter='PressureTables*'
#include "tests/physics/plates.hpp"

namespace riven {
namespace {

using namespace gates;

constexpr double alone = 1396.6;  // J/m^2
const std::string coarse = "grid.cell=1 mm";

void expect_crack_alone(const std::vector<std::string>& settings, std::initializer_list<int> contours, double limit) {
  Plate plate("cn_pressure", settings);
  print("crack under pressure", plate.hold());
  for (const int contour : contours)
    expect_J(fmt::format("crack under pressure, {} cells", contour), plate.tip(contour).J, alone, limit);
}

TEST(PressureGates, CrackAlone) {
  expect_crack_alone({coarse}, {4, 8, 16}, 0.03);
}

TEST(PressureTables, DISABLED_CrackAlone) {
  expect_crack_alone({}, {4, 16}, 0.02);
}

Plate plate_with_V(double b, std::vector<std::string> settings) {
  settings.push_back(fmt::format("crack.V.origin.0={} mm", b));
  return Plate("cn_pressure_h_and_v", settings);
}

std::string name_of(double b) {
  return fmt::format("pressure, V at b/w = {:.2f}", b / 50);
}

/// V crosses the crack inside the contour, where the opening jumps: without eq. 12 (and the faces of V) J is the jump
/// times the pressure too large.
void expect_jump_left_out(Plate& plate, const std::string& what, int contour, double reference, double limit) {
  expect_J(fmt::format("{}, {} cells around the crossing", what, contour), plate.tip(contour).J, reference, limit);
  const double naive = plate.tip(contour, JMethod::pijc).J / reference;
  report(
      fmt::format("{}, {} cells: J with all of eq. 11 and without the faces of V, over its reference", what, contour),
      naive, "above 1.5");
  EXPECT_GT(naive, 1.5);
}

TEST(PressureGates, CrackAcross) {
  Plate plate = plate_with_V(15, {coarse});
  const std::string what = name_of(15);
  print(what, plate.hold());
  expect_J(what + ", 4 cells", plate.tip(4).J, 1175.517, 0.05);
  expect_jump_left_out(plate, what, 24, 1175.517, 0.05);
}

TEST(PressureTables, DISABLED_CrackAcross) {
  for (const auto& [b, reference] :
       {std::pair{15., 1175.517}, {20., 806.8854}, {30., 1711.34}, {35., 1478.469}, {40., 1427.911}}) {
    Plate plate = plate_with_V(b, {});
    print(name_of(b), plate.hold());
    expect_J(name_of(b) + ", 2 mm", plate.tip(4).J, reference, 0.05);
    expect_J(name_of(b) + ", 8 mm", plate.tip(16).J, reference, 0.05);
    if (b == 20)
      expect_jump_left_out(plate, name_of(b), 24, reference, 0.05);
  }
}

/// 2 mm from the crossing: 8 mm hold it, 2 mm do not. What is left out is four times as much as what remains, and known
/// to 1.5 % on these cells, so that the integral by 8 mm is 6.5 % beyond that by 2 mm; J, which is that of the
/// interaction integral there, is 1.7 % below.
TEST(PressureTables, DISABLED_CrossingNearTheTip) {
  Plate plate = plate_with_V(23, {});
  print(name_of(23), plate.hold());
  expect_jump_left_out(plate, name_of(23), 16, plate.tip(4).J, 0.03);
  const Tip tip = plate.tip(16);
  report(name_of(23) + ", K_II over K_I, by the opening up to V", tip.K_II / tip.K_I, "0.01");
  EXPECT_TRUE(tip.crossed);
  EXPECT_GT(tip.K_I, 0);
  EXPECT_LT(std::abs(tip.K_II / tip.K_I), 0.01);
}

/// A pressure from the side presses V shut, and friction lets it bear the shear that would move its faces: the crack
/// takes less notice of it, on either side. Beside J of the crack alone under the same pressure from the side, which
/// makes it shorter, by itself a change of 1 to 3 %.
TEST(PressureTables, DISABLED_SidePressureAndFrictionHideTheCrackAcross) {
  const std::vector<std::string> pressed{"load.side.traction_x.value=-10 MPa", "contact.law=coulomb",
                                         "contact.friction=0.6"};
  Scene without_V = shipped("cn_pressure_h_and_v", pressed);
  without_V.cracks.pop_back();
  without_V.probes.clear();
  Plate plate_alone(without_V);
  print("crack under pressure, pressed from the side", plate_alone.hold());
  const double J = plate_alone.tip(4).J;
  report("crack under pressure, pressed from the side: J over that of the crack not pressed, less 1", J / alone - 1,
         "0.05");
  EXPECT_NEAR(J, alone, 0.05 * alone);
  for (const auto& [b, free] : {std::pair{15., 1175.517}, {20., 806.8854}, {30., 1711.34}, {35., 1478.469}}) {
    Plate plate = plate_with_V(b, pressed);
    const std::string what = name_of(b) + ", pressed from the side with friction";
    print(what, plate.hold());
    const double influence = plate.tip(4).J / J - 1, before = free / alone - 1;
    report(what + ": J over that of the crack alone, less 1", influence, fmt::format("within half of {:.3f}", before));
    EXPECT_LT(std::abs(influence), 0.5 * std::abs(before)) << what;
  }
}

}  // namespace
}  // namespace riven
