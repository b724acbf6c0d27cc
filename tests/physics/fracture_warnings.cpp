// What goes wrong silently elsewhere: contours that leave the solid, tips that are none, cracks inside of a contour,
// cracks along grid lines and rows of particles.
#include "io/summarize.hpp"
#include "tests/physics/plates.hpp"

namespace riven {
namespace {

using namespace gates;

/// The edge crack on cells of 1 mm or 2 mm, a quarter of a ramp after the ends have come to rest.
std::vector<std::string> coarse(int cell, std::vector<std::string> more = {}) {
  more.insert(more.begin(),
              {fmt::format("grid.cell={} mm", cell), "grid.lower=[\"-4 mm\", \"-56 mm\"]",
               "grid.upper=[\"54 mm\", \"56 mm\"]", fmt::format("grip.top.rectangle.upper.1={} mm", 50 + cell),
               fmt::format("grip.bottom.rectangle.lower.1=-{} mm", 50 + cell)});
  return more;
}

bool warned(const Simulation& m, const std::string& what) {
  for (const Summary::Warning& w : summarize(m, 1).warnings)
    if (w.kind.find(what) != std::string::npos)
      return w.count > 0;
  return false;
}

/// 8 mm are left ahead of the tip: edges beyond the plate, or beyond the grid, are drawn in, and the count says so.
TEST(FractureWarnings, AContourThatLeavesTheSolidIsDrawnIn) {
  Plate plate("sent", coarse(1, {"crack.H.points.1.0=42 mm"}));
  plate.hold();
  const double J = plate.tip(8).J;
  EXPECT_EQ(plate.simulation().fracture.drawn_in, 0);
  EXPECT_FALSE(warned(plate.simulation(), "drawn in"));
  for (const int contour : {20, 40, 200}) {
    const Tip tip = plate.tip(contour);
    report(
        fmt::format("J by a contour of {} cells, drawn in to {:.0f} {:.0f} {:.0f} {:.0f}, over that by 8 cells, less 1",
                    contour, tip.reach[0], tip.reach[1], tip.reach[2], tip.reach[3]),
        tip.J / J - 1, "0.03");
    EXPECT_TRUE(tip.sound);
    EXPECT_LE(tip.reach[0], 8);
    EXPECT_NEAR(tip.J / J, 1, 0.03);
  }
  EXPECT_GT(plate.simulation().fracture.drawn_in, 0);
  EXPECT_TRUE(warned(plate.simulation(), "left the solid and was drawn in"));
  EXPECT_EQ(plate.simulation().fracture.unsound, 0);
}

/// A tip half a cell from the far edge has no room for a contour.
TEST(FractureWarnings, ATipAtAnEdgeHasNoSoundContour) {
  Plate plate("sent", coarse(2, {"crack.H.points.1.0=49 mm"}));
  const Tip tip = plate.tip(4);
  EXPECT_FALSE(tip.sound);
  EXPECT_TRUE(warned(plate.simulation(), "no J contour lies in the solid"));
}

/// A crack of 3 mm beside the way of the first one, all of it in the larger contours. They leave it out, or J is off.
TEST(FractureWarnings, ACrackInsideOfAContourIsLeftOut) {
  Scene scene = shipped("sent", coarse(1));
  CrackLine small;
  small.name = "small";
  small.points = {{0.0285, 0.003}, {0.0315, 0.003}};
  scene.cracks.push_back(small);
  Plate both(scene);
  both.hold();
  const Tip near = both.tip(4), left_out = both.tip(16), not_left_out = both.tip(16, JMethod::fijc);
  report("J by 16 cells, which would hold another crack, over that by 4 cells, less 1", left_out.J / near.J - 1,
         "0.04");
  report("the same with the other crack in the contour", not_left_out.J / near.J - 1, "at least 0.04 off");
  EXPECT_FALSE(near.adapted);
  EXPECT_TRUE(left_out.adapted);
  EXPECT_FALSE(not_left_out.adapted);
  EXPECT_NEAR(left_out.J / near.J, 1, 0.04);
  EXPECT_GT(std::abs(not_left_out.J / near.J - 1), 0.04);
}

/// What a crack has beyond another one, which it crosses or begins on, is not resolved up to 1.5 cells.
TEST(FractureWarnings, AShortPieceBeyondACrackAcrossIsNotResolved) {
  for (const bool crosses : {true, false})
    for (const auto& [cells, told] : {std::pair{0.6, true}, {1.4, true}, {1.7, false}}) {
      Scene scene = shipped("sent", coarse(1));
      CrackLine across;
      across.name = "across";
      const double x = 0.025 - 0.001 * cells;
      across.points = {{x, -0.004}, {x, 0.004}};
      if (!crosses)
        scene.cracks[0].points.front() = {x, 0};
      scene.cracks.push_back(across);
      Plate plate(scene);
      plate.hold();
      EXPECT_EQ(warned(plate.simulation(), "less than 1.5 cells behind a tip"), told)
          << cells << " cells beyond, " << crosses;
    }
}

/// A cell and a half before a grip, where the contour is drawn in, a tip may lie on a column of nodes, which are
/// bridged beside it: in the first steps, too, K is that of a tip next to these.
TEST(FractureWarnings, ATipMayLieOnAColumnOfNodes) {
  std::vector<std::vector<double>> K(2);
  for (const bool on : {true, false}) {
    const char* x = on ? "25 mm" : "25.1 mm";
    Plate plate("sent",
                coarse(1, {fmt::format("crack.H.points=[[\"-1 mm\", \"48.5 mm\"], [\"{}\", \"48.5 mm\"]]", x),
                           "fracture.area_integral=never"}));  // of waves that no cell resolves it makes more or less
    for (int n = 0; n < 6; ++n) {
      plate.simulation().step();
      K[on].push_back(plate.tip(4).M_I);
    }
  }
  for (size_t n = 0; n < K[0].size(); ++n)
    EXPECT_NEAR(K[1][n], K[0][n], 0.2 * std::abs(K[0][n])) << n;
}

/// A crack on a line of nodes, on a row of particles, and between the two.
TEST(FractureWarnings, ACrackMayLieOnNodesAndOnParticles) {
  std::vector<double> J;
  for (const double y : {0., 0.25, 0.4}) {
    const std::string at = fmt::format("{} mm", 2 * y);
    Plate plate("sent", coarse(2, {fmt::format("crack.H.points=[[\"-1 mm\", \"{}\"], [\"25 mm\", \"{}\"]]", at, at)}));
    plate.hold();
    J.push_back(plate.tip(8).J);
  }
  report("J of a crack on a row of particles over that of one on nodes, less 1", J[1] / J[0] - 1, "0.04");
  report("J of a crack beside a row of particles over that of one on nodes, less 1", J[2] / J[0] - 1, "0.04");
  EXPECT_NEAR(J[1] / J[0], 1, 0.04);
  EXPECT_NEAR(J[2] / J[0], 1, 0.04);
}

}  // namespace
}  // namespace riven
