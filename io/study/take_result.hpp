// Results of a run: numbers taken from its history, and how far they are from what they should be.
#pragma once
#include "io/study/numeric_table.hpp"
#include "io/study/study.hpp"

namespace riven::study {

/// A result of one member. NaN where the run did not get so far.
struct Taken {
  double value = 0;  ///< in SI; against a curve, the rms difference
  double error =
      0;  ///< relative, not negative; NaN without a reference, or while the reference is not extrapolated yet
  std::string unit;
};

/// `target`: of the result's targets, that of the run's problem. `column`: see column_of. Throws Error (bad_input)
/// where the column does not exist, a quantity's unit does not fit it, no row lies in the window, or a curve cannot be
/// read.
Taken take_result(const Result& result, const Target& target, const std::string& column, const NumericTable& history);

/// |value - reference| over the target's scale, or over |reference|. Throws Error (bad_input) where that is not a
/// number greater than 0.
double relative_error(const Target& target, double value, double reference, const std::string& unit);

}  // namespace riven::study
