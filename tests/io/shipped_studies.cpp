// Every shipped study can be begun: none of its runs is refused, and its results are columns of their histories.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "io/study/members.hpp"
#include "io/study/read_study.hpp"
#include "io/study/settings_text.hpp"
#include "io/study/take_result.hpp"
#include "tests/io/results_sample.hpp"
#include "tests/program.hpp"

namespace riven::study {
namespace {

const std::filesystem::path shipped = RIVEN_SOURCE_DIR "/cases";

std::vector<std::filesystem::path> shipped_studies() {
  std::vector<std::filesystem::path> list;
  for (const auto& entry : std::filesystem::directory_iterator(shipped / "studies"))
    if (entry.path().extension() == ".toml")
      list.push_back(entry.path());
  std::sort(list.begin(), list.end());
  return list;
}

class ShippedStudies : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(ShippedStudies, BeginAndFindTheirResults) {
  const Study s = read_study(GetParam().string());
  const std::string scene = (shipped / "scenes" / (s.scene + ".toml")).string();
  const Members all = expand(s, scene);
  for (const study::Run& r : all.runs)
    EXPECT_EQ(r.refused, "") << r.label;
  const auto smallest =
      std::min_element(all.runs.begin(), all.runs.end(), [](const auto& a, const auto& b) { return a.work < b.work; });
  const sample::Folder folder;
  std::string command = as_command("'" + scene + "'", smallest->set).substr(std::string("riven ").size());
  command += " -o '" + (folder / "results").string() + "' --quiet --wall-limit '1 ms'";
  const Outcome run = riven(command, folder);
  ASSERT_EQ(run.code, 5) << run.errors;  // interrupted
  const NumericTable history = read_numeric_table((folder / "results/history.csv").string(), "the history");
  for (const Member& m : all.members)
    if (&all.runs[m.run] == &*smallest)
      for (const Result& r : s.results)
        for (Target target : r.targets) {
          // the run has only begun: this is about columns, files and units
          target.from = 0;
          target.to = history.columns[0].back();
          if (r.take == Take::curve && target.scale.empty())
            target.scale = "1 " + history.units[history.find(column_of(m, r.column), r.name)];
          EXPECT_NO_THROW(take_result(r, target, column_of(m, r.column), history)) << r.name;
        }
}

INSTANTIATE_TEST_SUITE_P(Each, ShippedStudies, testing::ValuesIn(shipped_studies()),
                         [](const testing::TestParamInfo<std::filesystem::path>& of) {
                           return of.param.stem().string();
                         });

}  // namespace
}  // namespace riven::study
