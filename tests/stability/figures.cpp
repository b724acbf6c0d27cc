#include "tests/stability/figures.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace riven::hard_cases {

namespace {

struct Row {
  std::string name;
  double figure;
  std::string limit, verdict;
};

std::vector<Row>& rows() {
  static std::vector<Row> list;
  return list;
}

void add(const std::string& row, double figure, const std::string& limit, bool pass) {
  rows().push_back({row, figure, limit, pass ? "pass" : "FAIL"});
  EXPECT_TRUE(pass) << row << ": " << figure << ", limit " << limit;
}

class Table : public ::testing::Environment {
 public:
  void TearDown() override {
    const std::vector<Row>& all = rows();
    size_t width = 4, limits = 5;
    for (const Row& r : all) {
      width = std::max(width, r.name.size());
      limits = std::max(limits, r.limit.size());
    }
    const auto line = [&](const std::string& name, const std::string& figure, const std::string& limit,
                          const std::string& verdict) {
      fmt::print("{:<{}}  {:>11}  {:<{}}  {}\n", name, width, figure, limit, limits, verdict);
    };
    fmt::print("\n");
    line("case", "figure", "limit", "");
    for (const Row& r : all)
      line(r.name, fmt::format("{:.3g}", r.figure), r.limit, r.verdict);
    fmt::print("\n");
  }
};

// googletest owns it, and tears it down once all tests have run
[[maybe_unused]] const ::testing::Environment* const table = ::testing::AddGlobalTestEnvironment(new Table);

}  // namespace

void below(const std::string& row, double figure, double limit) {
  add(row, figure, fmt::format("< {:g}", limit), figure < limit);
}
void above(const std::string& row, double figure, double limit) {
  add(row, figure, fmt::format("> {:g}", limit), figure > limit);
}
void between(const std::string& row, double figure, double low, double high) {
  add(row, figure, fmt::format("{:g} to {:g}", low, high), figure >= low && figure <= high);
}
void note(const std::string& row, double figure) {
  rows().push_back({row, figure, "none", ""});
}

void beyond(const std::string& row, double figure, double limit, double bound, const std::string& why) {
  add(row, figure, fmt::format("< {:g}", bound), figure < bound);
  if (!(figure < limit) && figure < bound)
    rows().back().verdict = fmt::format("not < {:g}: {}", limit, why);
}

}  // namespace riven::hard_cases
