#pragma once
#include <algorithm>
#include <vector>

namespace riven {

/// The middle of the values, or the mean of the two in the middle. There must be one at least.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<long>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1)
    return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

}  // namespace riven
