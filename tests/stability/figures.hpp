// What the hard cases measured: each test adds rows, and the program prints one table of them at its end.
#pragma once
#include <string>

namespace riven::hard_cases {

/// The figure has to be below the limit; adds a row, and a test failure where it is not (or is not a number).
void below(const std::string& row, double figure, double limit);
/// The figure has to be above the limit: most are controls, which show that the scene can fail.
void above(const std::string& row, double figure, double limit);
/// The figure has to lie between two limits.
void between(const std::string& row, double figure, double low, double high);
/// A figure without a limit, for the record.
void note(const std::string& row, double figure);

/// Like `below`, for a row that is known to fail: the table says so, and tests that run with
/// --gtest_also_run_disabled_tests fail by it.
void open_below(const std::string& row, double figure, double limit);

}  // namespace riven::hard_cases
