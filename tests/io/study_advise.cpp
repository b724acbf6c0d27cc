// Advice from coarse runs: the cells that a scene could have, laws of error and cost of known order, and what follows.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "core/error.hpp"
#include "io/read_scene.hpp"
#include "io/study/advise.hpp"
#include "tests/program.hpp"

namespace riven::study {
namespace {

std::vector<double> cells_of(const std::vector<Rung>& rungs) {
  std::vector<double> cells;
  for (const Rung& r : rungs)
    cells.push_back(std::round(1e6 * r.cell) / 1e3);
  return cells;
}

Scene shipped(const std::string& name, const std::vector<std::string>& set = {}) {
  return read_scene(RIVEN_SOURCE_DIR "/cases/scenes/" + name + ".toml", set);
}

/// A plate of 50 by 100 mm with grips of 1 mm, 2 x 2 particles in a cell: cells that divide the plate, and hold a row
/// or more of the grips.
TEST(AdviseCells, LeaveEdgesBetweenParticles) {
  const std::vector<Rung> r = rungs(shipped("sent"));
  EXPECT_EQ(cells_of(r), (std::vector<double>{2, 1, 0.5, 0.4, 0.333, 0.25, 0.2, 0.167, 0.125, 0.1, 0.083, 0.063}));
  for (const Rung& rung : r)
    EXPECT_NO_THROW(shipped("sent", rung.set)) << rung.cell;
  EXPECT_NEAR(r[1].work / r[0].work, 8, 1e-9);
}

/// Symmetry planes stay on grid lines, and the grid stays around what was in it.
TEST(AdviseCells, KeepSymmetryPlanes) {
  const Scene own = shipped("dcb_half");
  for (const Rung& rung : rungs(own)) {
    const Scene s = shipped("dcb_half", rung.set);
    for (const SymmetryPlane& p : s.symmetry) {
      const double lines = (p.position - (p.axis == 0 ? s.grid.lower.x : s.grid.lower.y)) / s.cell;
      EXPECT_NEAR(lines, std::round(lines), 1e-6);
    }
    EXPECT_LE(s.grid.lower.x, own.grid.lower.x + 1e-12);
    EXPECT_GE(s.grid.upper.y, own.grid.upper.y - 1e-12);
  }
}

TEST(AdviseCells, ClimbFromWhatStillShowsTheCrack) {
  const Scene s = shipped("sent");
  const std::vector<Rung> ladder = choose_ladder(s, rungs(s));
  EXPECT_EQ(cells_of(ladder), (std::vector<double>{2, 1, 0.5}));
  const Scene none = shipped("sent", {"body.plate.rectangle.upper.0=50.013 mm"});
  EXPECT_THROW(choose_ladder(none, rungs(none)), Error);
}

/// Histories whose error is known: J(t) = t (1 + a h^p) and a small K that is wrong by as much as it is large.
class AdviseLaws : public testing::Test {
 protected:
  std::vector<std::string> histories(double a, double p, const std::vector<Rung>& ladder) const {
    std::vector<std::string> files;
    for (const Rung& r : ladder) {
      files.push_back((folder_ / fmt::format("{}.csv", r.cell)).string());
      std::ofstream out(files.back());
      out.precision(17);
      out << "time [s],tip J [J/m^2],tip K_I [Pa m^0.5],tip K_II [Pa m^0.5],none [Pa m^0.5]\n";
      for (int n = 0; n <= 40; ++n) {
        const double t = 0.025 * n;
        out << t << ',' << t * (1 + a * std::pow(r.cell, p)) << ",100," << 0.1 * r.cell << ',' << 1e-14 * r.cell
            << '\n';
      }
    }
    return files;
  }
  const sample::Folder folder_;
  const std::vector<Rung> ladder_{{4, {}, 1}, {2, {}, 8}, {0.8, {}, 125}};
  const std::vector<std::string> columns_{"tip J", "tip K_I", "tip K_II", "none"};
};

TEST_F(AdviseLaws, FindOrderAndFactor) {
  for (const double p : {0.7, 1., 2.}) {
    const std::vector<ErrorLaw> laws = fit_errors(ladder_, histories(0.01, p, ladder_), columns_);
    ASSERT_EQ(laws.size(), 2u) << "K_I and what is 0 do not change from cell to cell";
    EXPECT_EQ(laws[0].column, "tip J");
    EXPECT_TRUE(laws[0].sure);
    EXPECT_NEAR(laws[0].order, p, 1e-6);
    // the mean over the last quarter, 0.875, over the largest
    EXPECT_NEAR(laws[0].error(0.5), 0.01 * std::pow(0.5, p) * 0.88 / (1 + 0.01 * std::pow(0.8, p)), 2e-5);
    EXPECT_EQ(laws[1].column, "tip K_II");
    EXPECT_NEAR(laws[1].error(1), 0.1 / 100, 1e-6) << "small beside K_I";
  }
}

/// Where the runs drift apart the estimate is of first order, of the larger distance, and not sure.
TEST_F(AdviseLaws, AreCarefulWhereNothingConverges) {
  const std::vector<ErrorLaw> laws = fit_errors(ladder_, histories(-0.04, -0.5, ladder_), {"tip J"});
  ASSERT_EQ(laws.size(), 1u);
  EXPECT_FALSE(laws[0].sure);
  EXPECT_TRUE(std::isnan(laws[0].measured));
  EXPECT_EQ(laws[0].order, 1);
  EXPECT_GT(laws[0].error(0.8), 0.5 * 0.04 * (std::pow(0.8, -0.5) - std::pow(2, -0.5)));
}

Record record(long particles, long steps, double seconds, long memory) {
  Record r;
  r.status = "done";
  r.particles = particles;
  r.steps = steps;
  r.wall = {seconds};
  r.memory = memory;
  return r;
}

TEST(AdviseCosts, GrowWithStepsAndParticles) {
  const auto run = [](long n, long steps) {
    return record(n, steps, 1e-5 * static_cast<double>(steps) + 4e-8 * static_cast<double>(n * steps),
                  20000000 + 300 * n);
  };
  const CostLaw c = fit_costs({run(100, 50), run(400, 100), run(1600, 200)});
  EXPECT_NEAR(c.per_step, 1e-5, 1e-12);
  EXPECT_NEAR(c.per_work, 4e-8, 1e-15);
  EXPECT_NEAR(c.per_particle, 300, 1e-9);
  // a noisy small run does not make the large one free
  const CostLaw noisy = fit_costs({run(100, 50), record(400, 100, 9, 1), run(1600, 200)});
  EXPECT_GT(noisy.per_step + 1e4 * noisy.per_work, 0);
}

TEST(AdviseChoice, IsTheLargestCellWithinTheTolerance) {
  const std::vector<Rung> all{{8, {}, 1}, {4, {}, 8}, {2, {}, 64}, {1, {}, 512}, {0.5, {}, 4096}, {0.25, {}, 32768}};
  const std::vector<Rung> ladder{all[1], all[2], all[3]};
  const std::vector<Record> records{record(100, 50, 1, 1000), record(400, 100, 4, 4000), record(1600, 200, 30, 16000)};
  ErrorLaw law{"J", 1, 0.02, 1, true};
  const Advice a = advise(all, ladder, records, {law}, 0.02);
  EXPECT_EQ(a.rung.cell, 0.5) << "1 leaves no margin";
  EXPECT_TRUE(a.reached);
  EXPECT_TRUE(a.sure);
  EXPECT_DOUBLE_EQ(a.error, 0.01);
  EXPECT_NEAR(a.memory, 64000, 1);
  EXPECT_FALSE(advise(all, ladder, records, {law}, 0.001).reached);
  EXPECT_EQ(advise(all, ladder, records, {law}, 0.001).rung.cell, 0.25);
  EXPECT_EQ(advise(all, ladder, records, {law}, 10).rung.cell, 4) << "nothing is known of coarser cells";
  law.sure = false;
  EXPECT_FALSE(advise(all, ladder, records, {law}, 0.02).sure);
}

TEST(AdviseCommand, RefusesWhatIsWrong) {
  const sample::Folder folder;
  EXPECT_EQ(riven("advise sent", folder).code, 2);
  EXPECT_EQ(riven("advise sent --within -1", folder).code, 2);
  EXPECT_NE(riven("advise snet --within 2%", folder).errors.find("'sent'"), std::string::npos);
  EXPECT_EQ(riven("advise sent --within 2% --set grid.cel=1", folder).code, 2);
}

}  // namespace
}  // namespace riven::study
