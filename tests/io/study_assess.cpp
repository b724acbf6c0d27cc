// What runs with known results make of a study: errors, orders, references by extrapolation, what is recommended.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "io/study/write_study.hpp"
#include "tests/io/results_sample.hpp"

namespace riven::study {
namespace {

/// Two methods on cells of 4, 2 and 1 mm whose runs have the given results; NaN: the run failed. A second as long as
/// the cells are many.
class Assessing : public testing::Test {
 protected:
  Assessing() : store_(folder_ / "out") {
    study_.axes = {{"cell", {}, true}, {"method", {{"a", {}}, {"b", {}}}, false}};
    for (const double h : {4., 2., 1.})
      study_.axes[0].choices.push_back({fmt::format("{} mm", h), {}, 1e-3 * h});
    Result r;
    r.name = r.column = "J";
    r.targets = {Target{}};
    r.targets[0].reference = {Reference::Kind::value, "100", ""};
    study_.results = {r};
  }

  Assessment assess(const std::vector<double>& a, const std::vector<double>& b) {
    members_ = {};
    records_.clear();
    for (size_t h = 0; h < 3; ++h)
      for (const auto* values : {&a, &b}) {
        members_.members.push_back({{h, values == &b ? size_t{1} : size_t{0}}, members_.runs.size(), "", ""});
        add((*values)[h], std::pow(8., static_cast<double>(h)));
      }
    return study::assess(study_, members_, records_, store_);
  }

  void add(double value, double seconds) {
    members_.runs.push_back({"", {}, fmt::format("run {}", members_.runs.size()), 0, "", 0});
    Record r;
    r.status = std::isnan(value) ? "unstable" : "done";
    r.wall = {seconds};
    records_.push_back(r);
    std::filesystem::create_directories(store_.results(members_.runs.back()));
    std::ofstream((store_.results(members_.runs.back()) / "history.csv").string())
        << "time [s],J [J/m^2]\n0,0\n1," << value << "\n";
  }

  const sample::Folder folder_;
  const Store store_;
  Study study_;
  Members members_;
  std::vector<Record> records_;
};

TEST_F(Assessing, FindsOrdersOfErrorAndCost) {
  const Assessment s = assess({116, 104, 101}, {84, 92, 96});
  ASSERT_EQ(s.methods.size(), 2u);
  EXPECT_EQ(s.methods[0].label, "method a");
  EXPECT_EQ(s.methods[0].settings, (std::vector<size_t>{0, 2, 4}));
  const ResultReport& r = s.results[0];
  EXPECT_NEAR(r.fits[0].order, 2, 1e-12);
  EXPECT_NEAR(r.fits[1].order, 1, 1e-12);
  EXPECT_NEAR(r.fits[0].cost, 3, 1e-12);
  EXPECT_DOUBLE_EQ(r.points[2].error, 0.04);
  EXPECT_EQ(r.front, (std::vector<size_t>{0, 2, 4})) << "a and b cost the same, and are as bad with 4 mm";
}

/// With no other axis than the cell there is one method, which tables and pictures have a word for.
TEST_F(Assessing, NamesTheOnlyMethod) {
  study_.axes.pop_back();
  for (size_t h = 0; h < 3; ++h) {
    members_.members.push_back({{h}, h, "", ""});
    add(100 + std::pow(4., 2. - static_cast<double>(h)), 1);
  }
  const Assessment s = study::assess(study_, members_, records_, store_);
  ASSERT_EQ(s.methods.size(), 1u);
  EXPECT_EQ(s.methods[0].label, "as it is");
  EXPECT_EQ(s.settings[0].label, "cell 4 mm");
}

/// 4 mm is exact by chance: with 2 mm the method is off by 8 %.
TEST_F(Assessing, DoesNotRecommendWhatIsRightByChance) {
  const ResultReport r = assess({100, 108, 104}, {110, 106, 101}).results[0];
  EXPECT_EQ(r.points[0].error, 0);
  EXPECT_DOUBLE_EQ(r.settled[0].error, 0.08);
  EXPECT_EQ(cheapest(r.settled, 0.05), std::optional<size_t>(5));
  EXPECT_EQ(cheapest(r.settled, 0.07), std::optional<size_t>(3));
  EXPECT_EQ(cheapest(r.settled, 0.09), std::optional<size_t>(0));
}

TEST_F(Assessing, DoesNotRecommendWhatFailsOnFinerCells) {
  const ResultReport r = assess({101, NAN, 101}, {110, 106, 102}).results[0];
  EXPECT_TRUE(std::isnan(r.settled[0].error));
  EXPECT_EQ(cheapest(r.settled, 0.02), std::optional<size_t>(4)) << "nothing finer is known to fail";
  EXPECT_TRUE(std::isnan(r.taken[2].value));
}

/// Up to the first failure from the small end of the refined axis.
TEST_F(Assessing, FindsHowFarMethodsRunToTheirEnd) {
  const Assessment some = assess({NAN, 101, 101}, {110, NAN, 102});
  EXPECT_TRUE(some.methods[0].failed && some.methods[1].failed);
  EXPECT_EQ(some.methods[0].stands, std::optional<size_t>(2));
  EXPECT_EQ(some.methods[1].stands, std::optional<size_t>(5));
  const Assessment most = assess({101, 101, NAN}, {110, 101, 102});
  EXPECT_FALSE(most.methods[0].stands);
  EXPECT_EQ(most.methods[1].stands, std::optional<size_t>(1));
  EXPECT_FALSE(most.methods[1].failed);
}

/// One method tends to 100, the other to and fro: its finest run counts.
TEST_F(Assessing, ExtrapolatesWhereThereIsNoReference) {
  study_.results[0].targets[0].reference.kind = Reference::Kind::extrapolated;
  const ResultReport r = assess({116, 104, 101}, {90, 104, 96}).results[0];
  ASSERT_TRUE(r.limits.at(0));
  EXPECT_NEAR(r.limits[0]->value, 98, 1e-9);
  EXPECT_NEAR(r.limits[0]->spread, 2, 1e-9);
  EXPECT_NEAR(r.points[4].error, 3 / 98., 1e-9);
  EXPECT_NE(r.reference.find("1 could be extrapolated"), std::string::npos) << r.reference;
  const ResultReport none = assess({90, 104, 96}, {90, 104, 98}).results[0];
  EXPECT_NE(none.reference.find("none could be extrapolated"), std::string::npos) << none.reference;
  EXPECT_FALSE(assess({1, 2, NAN}, {1, 2, NAN}).results[0].limits[0]);
}

/// The methods are problems now, which one method solves on three cells.
class AssessingProblems : public Assessing {
 protected:
  AssessingProblems() {
    study_.axes[1] = {"load", {{"small", {"grip.velocity=1"}}, {"large", {"grip.velocity=2"}}}, false, true};
    study_.results[0].targets.resize(2, study_.results[0].targets[0]);
    study_.results[0].targets[1].reference.value = "200";
  }
};

TEST_F(AssessingProblems, CountTheLargestErrorAndTheTimeOfAll) {
  const Assessment s = assess({116, 104, 101}, {250, 190, 198});
  ASSERT_EQ(s.settings.size(), 3u);
  EXPECT_EQ(s.settings[1].label, "cell 2 mm");
  EXPECT_EQ(s.settings[1].members, (std::vector<size_t>{2, 3}));
  ASSERT_EQ(s.methods.size(), 1u);
  EXPECT_EQ(s.methods[0].settings, (std::vector<size_t>{0, 1, 2}));
  const ResultReport& r = s.results[0];
  EXPECT_DOUBLE_EQ(r.taken[4].error, 0.01);
  EXPECT_DOUBLE_EQ(r.points[0].error, 0.25);
  EXPECT_DOUBLE_EQ(r.points[1].error, 0.05);
  EXPECT_DOUBLE_EQ(r.points[2].error, 0.01);
  EXPECT_DOUBLE_EQ(r.points[1].cost, 16);
  EXPECT_EQ(cheapest(r.settled, 0.06), std::optional<size_t>(1));
  EXPECT_EQ(r.reference, "load small: 100; load large: 200");
  study_.results[0].targets[1].reference.value = "100";
  EXPECT_EQ(assess({1, 1, 1}, {1, 1, 1}).results[0].reference, "100");
  EXPECT_EQ(keys_of(study_, members_, s.settings[1]), std::vector<std::string>{}) << "the load is no part of it";
}

TEST_F(AssessingProblems, ASettingThatFailsInOneOfThemIsNotGood) {
  const Assessment s = assess({116, 104, 101}, {220, NAN, 198});
  EXPECT_TRUE(s.methods[0].failed);
  EXPECT_EQ(s.methods[0].stands, std::optional<size_t>(2));
  EXPECT_TRUE(std::isnan(s.results[0].points[1].error));
  EXPECT_EQ(cheapest(s.results[0].settled, 0.2), std::optional<size_t>(2));
}

TEST_F(AssessingProblems, AreNoneOfThoseOfTheSceneAsItIs) {
  assess({116, 104, 101}, {250, 190, 198});
  members_.members.push_back({{}, members_.runs.size(), "", "nothing"});
  add(101, 1);
  const Assessment s = study::assess(study_, members_, records_, store_);
  EXPECT_EQ(s.results[0].taken.back().value, 101);
  EXPECT_TRUE(std::isnan(s.results[0].taken.back().error));
  EXPECT_EQ(s.settings.size(), 3u);
}

TEST_F(AssessingProblems, AreExtrapolatedEachByItself) {
  for (Target& t : study_.results[0].targets)
    t.reference.kind = Reference::Kind::extrapolated;
  const ResultReport r = assess({116, 104, 101}, {184, 192, 196}).results[0];
  ASSERT_TRUE(r.limits.at(0) && r.limits.at(1));
  EXPECT_NEAR(r.limits[0]->value, 100, 1e-9);
  EXPECT_NEAR(r.limits[1]->value, 200, 1e-9);
  EXPECT_NEAR(r.points[2].error, 0.02, 1e-9);
}

TEST_F(Assessing, TellsWhatLeavingOutDoes) {
  study_.axes.clear();
  study_.left_out = {{"contact", {}}, {"growth", {}}};
  members_ = {};
  for (const auto& [name, value, seconds] :
       {std::tuple{"nothing", 50., 10.}, {"contact", 55., 8.}, {"growth", double{NAN}, 1.}}) {
    members_.members.push_back({{}, members_.runs.size(), "", name});
    add(value, seconds);
  }
  const Assessment s = study::assess(study_, members_, records_, store_);
  EXPECT_TRUE(s.results[0].front.empty()) << "these are no settings to choose from";
  const std::vector<LeftOutReport> l = report_left_out(study_, members_, records_, s);
  ASSERT_EQ(l.size(), 2u);
  EXPECT_DOUBLE_EQ(l[0].cost, 0.2);
  EXPECT_DOUBLE_EQ(l[0].changes[0], 0.1);
  EXPECT_TRUE(std::isnan(l[1].cost));
}

}  // namespace
}  // namespace riven::study
