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

/// For a limit that asks for what cannot be, as `why` says with figures: the table says so, too. The figure has to stay
/// below `bound`.
void beyond(const std::string& row, double figure, double limit, double bound, const std::string& why);

}  // namespace riven::hard_cases
