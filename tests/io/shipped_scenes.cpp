// Every shipped scene begins, and its curves are of columns that its history has.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

#include "tests/io/results_sample.hpp"
#include "tests/program.hpp"

namespace riven {
namespace {

std::vector<std::filesystem::path> shipped_scenes() {
  std::vector<std::filesystem::path> list;
  for (const auto& entry : std::filesystem::directory_iterator(RIVEN_SOURCE_DIR "/cases/scenes"))
    if (entry.path().extension() == ".toml")
      list.push_back(entry.path());
  std::sort(list.begin(), list.end());
  return list;
}

/// The columns that a scene's "# draw: --curve X Y ..." asks for.
std::vector<std::string> curves_of(const std::filesystem::path& scene) {
  std::vector<std::string> list;
  std::istringstream lines(sample::text_of(scene));
  for (std::string line; std::getline(lines, line);) {
    const std::string draw = "# draw: --curve ";
    if (!line.starts_with(draw))
      continue;
    std::istringstream words(line.substr(draw.size()));
    for (std::string word; words >> std::quoted(word) && !word.starts_with("-");)
      list.push_back(word);
  }
  return list;
}

class ShippedScenes : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(ShippedScenes, BeginAndKnowTheirCurves) {
  const sample::Folder folder;
  const Outcome run = riven("run " + GetParam().string() + " -o " + folder.path().string() +
                                "/results --quiet --set output.frames=0 --wall-limit '1 ms'",
                            folder);
  ASSERT_EQ(run.code, 5) << run.errors;  // interrupted
  const std::string history = sample::text_of(folder / "results/history.csv");
  const std::string header = "," + history.substr(0, history.find('\n')) + ",";
  for (const std::string& column : curves_of(GetParam()))
    EXPECT_TRUE(header.find("," + column + " [") != std::string::npos ||
                header.find("," + column + ",") != std::string::npos)
        << column;
}

INSTANTIATE_TEST_SUITE_P(Each, ShippedScenes, testing::ValuesIn(shipped_scenes()),
                         [](const testing::TestParamInfo<std::filesystem::path>& of) {
                           return of.param.stem().string();
                         });

}  // namespace
}  // namespace riven
