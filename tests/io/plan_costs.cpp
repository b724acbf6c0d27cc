// `riven plan --costs`: what effects cost, measured, where a setting turns them on or off.
#include <gtest/gtest.h>

#include <sstream>

#include "tests/program.hpp"

namespace riven {
namespace {

/// The line of an effect, after its name.
std::string line_of(const std::string& plan, const std::string& effect) {
  std::istringstream lines(plan);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("  " + effect + " "))
      return line.substr(2 + effect.size());
  return {};
}

TEST(PlanCosts, AreShownOfWhatCanBeTurnedOnOrOff) {
  const sample::Folder folder;
  const Outcome with = riven("plan two_disks --costs", folder);
  ASSERT_EQ(with.code, 0) << with.errors;
  for (const char* effect : {"cracks", "contact", "second stress update", "J", "higher orders", "grid damping"})
    EXPECT_NE(line_of(with.output, effect).find(" %  "), std::string::npos) << line_of(with.output, effect);
  for (const char* effect : {"tractions", "deformation gradient", "boundary"})
    EXPECT_EQ(line_of(with.output, effect).find(" %  "), std::string::npos) << line_of(with.output, effect);
  const Outcome without = riven("plan two_disks", folder);
  ASSERT_EQ(without.code, 0);
  EXPECT_EQ(line_of(without.output, "contact").find(" %  "), std::string::npos);
}

/// A second field of velocities for all nodes that two more extrapolations read is not free.
TEST(PlanCosts, OfASecondExtrapolationIsMoreThanAFewPercent) {
  const sample::Folder folder;
  const Outcome with = riven("plan many_cracks --costs --threads 1", folder);
  ASSERT_EQ(with.code, 0) << with.errors;
  const std::string line = line_of(with.output, "second extrapolation");
  EXPECT_GT(std::stod(line.substr(line.find('+'))), 10) << line;
}

}  // namespace
}  // namespace riven
