// What the program says to a command line that it does not understand.
#include <gtest/gtest.h>

#include "tests/program.hpp"

using namespace riven;

namespace {

/// The message about `word` as the first word of a command line.
Outcome said_to(const std::string& word) {
  const sample::Folder folder;
  return riven::riven(word + " -o x", folder);
}

bool says(const Outcome& o, const std::string& text) {
  return o.errors.find(text) != std::string::npos;
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
  EXPECT_TRUE(says(strange, "allowed: run, plan, check, cases, study, advise")) << strange.errors;
}

TEST(CommandLine, ASceneAloneIsToldHowToRun) {
  const Outcome scene = said_to("plate.toml");
  EXPECT_EQ(scene.code, 2);
  EXPECT_TRUE(says(scene, "try:     riven run plate.toml")) << scene.errors;
}

TEST(CommandLine, ATolerancePastTheWholeIsAskedForInPerCent) {
  const sample::Folder folder;
  const Outcome two = riven::riven("advise sent --within 2 -o x", folder);
  EXPECT_EQ(two.code, 2);
  EXPECT_TRUE(says(two, "did you mean '2%'?")) << two.errors;
}

TEST(CommandLine, MissingWordsOfACommandAreStillItsOwn) {
  const sample::Folder folder;
  const Outcome nothing = riven::riven("", folder), plan = riven::riven("plan", folder);
  EXPECT_EQ(nothing.code, 2);
  EXPECT_TRUE(says(nothing, "subcommand")) << nothing.errors;
  EXPECT_EQ(plan.code, 2);
  EXPECT_FALSE(says(plan, "no such command")) << plan.errors;
}
