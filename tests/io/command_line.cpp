// What the program says to a command line that it does not understand.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/program.hpp"

using namespace riven;

namespace {

/// What is said to these words of a command line.
Outcome said_to(const std::string& words) {
  const sample::Folder folder;
  return riven::riven(words + " -o x", folder);
}

bool says(const Outcome& o, const std::string& text) {
  return o.errors.find(text) != std::string::npos;
}

/// These words are refused, with this advice.
void expect_advice(const std::string& words, const std::string& advice) {
  const Outcome refused = said_to(words);
  EXPECT_EQ(refused.code, 2) << words;
  EXPECT_TRUE(says(refused, "try:     " + advice)) << refused.errors;
}

}  // namespace

TEST(CommandLine, AnUnknownCommandIsNamedWithTheNearest) {
  const Outcome misspelt = said_to("rum");
  EXPECT_EQ(misspelt.code, 2);
  EXPECT_TRUE(says(misspelt, "value:   rum")) << misspelt.errors;
  EXPECT_TRUE(says(misspelt, "did you mean 'run'?")) << misspelt.errors;
  const Outcome strange = said_to("frobnicate");
  EXPECT_EQ(strange.code, 2);
  EXPECT_TRUE(says(strange, "value:   frobnicate")) << strange.errors;
  EXPECT_TRUE(says(strange, "allowed: run, plan, check, cases, study, advise, picture")) << strange.errors;
}

TEST(CommandLine, ASceneAloneIsToldHowToRun) {
  expect_advice("plate.toml", "riven run plate.toml");
}

TEST(CommandLine, AStudyIsNotRunButStudied) {
  expect_advice("run sent_j", "sent_j is a study: riven study sent_j");
  expect_advice("study sent", "sent is a scene: riven run sent");
}

TEST(CommandLine, AShippedSceneIsShownAndCopiedWithItsFiles) {
  const sample::Folder folder;
  const Outcome shown = riven::riven("cases ten_cracks", folder);
  EXPECT_EQ(shown.code, 0);
  EXPECT_TRUE(shown.output.starts_with("# Purpose")) << shown.output;
  const std::string copy = "cases ten_cracks --copy -o " + (folder / "mine").string();
  EXPECT_EQ(riven::riven(copy, folder).code, 0);
  EXPECT_EQ(sample::text_of(folder / "mine/ten_cracks.toml"), shown.output);
  EXPECT_EQ(riven::riven("check " + (folder / "mine/ten_cracks.toml").string(), folder).code, 0);
  std::filesystem::remove(folder / "mine/ten_cracks.toml");
  const Outcome again = riven::riven(copy, folder);  // its file of cracks is there still
  EXPECT_EQ(again.code, 4);
  EXPECT_TRUE(says(again, "ten_cracks.csv: there is such a file already")) << again.errors;
  EXPECT_FALSE(std::filesystem::exists(folder / "mine/ten_cracks.toml"));
  expect_advice("cases ten_crack --copy", "did you mean 'ten_cracks'?");
}

/// What shows only when particles are laid out.
TEST(CommandLine, CheckRefusesWhatRunWould) {
  const sample::Folder folder;
  const std::string inside = R"( sent --set 'load=[{ kind="traction", edge="top", traction_y="1 MPa", )"
                             R"(rectangle={ lower=["10 mm", "10 mm"], upper=["20 mm", "20 mm"] } }]')";
  for (const char* command : {"check", "run"}) {
    const Outcome refused = riven::riven(command + inside, folder);
    EXPECT_EQ(refused.code, 2) << command;
    EXPECT_TRUE(says(refused, "finds no particle at an edge")) << refused.errors;
    EXPECT_TRUE(says(refused, "edge = \"top\"")) << refused.errors;
  }
}

TEST(CommandLine, WhatCannotBePrintedIsAFileError) {
  const sample::Folder folder;
  const Outcome full = riven::riven("cases >/dev/full 2>" + (folder / "said").string() + "; echo $?", folder);
  EXPECT_EQ(full.output, "4\n");
  EXPECT_NE(sample::text_of(folder / "said").find("No space left on device"), std::string::npos);
}

TEST(CommandLine, APathThatLeadsNowhereIsNoInternalError) {
  const sample::Folder folder;
  std::filesystem::create_symlink("loop.toml", folder / "loop.toml");
  const Outcome loop = riven::riven("run " + (folder / "loop.toml").string() + " -o x", folder);
  EXPECT_NE(loop.code, 0);
  EXPECT_NE(loop.code, 1) << loop.errors;
}

TEST(CommandLine, ATolerancePastTheWholeIsAskedForInPerCent) {
  expect_advice("advise sent --within 2", "did you mean '2%'?");
}

TEST(CommandLine, MissingWordsOfACommandAreStillItsOwn) {
  const sample::Folder folder;
  const Outcome nothing = riven::riven("", folder), plan = riven::riven("plan", folder);
  EXPECT_EQ(nothing.code, 2);
  EXPECT_TRUE(says(nothing, "subcommand")) << nothing.errors;
  EXPECT_EQ(plan.code, 2);
  EXPECT_FALSE(says(plan, "no such command")) << plan.errors;
}
