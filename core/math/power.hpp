#pragma once
#include <cmath>

#include "core/exec/config.hpp"

namespace riven {

/// x^p of |p| <= 1, by the binomial series where x is so near to 1 that its first nine terms give all digits: a quarter
/// of the time of std::pow.
RIVEN_INLINE double power_near_one(double x, double p) {
  constexpr double near = 0.015;  // 0.015^9 is 0.2 of a rounding
  const double e = x - 1;
  if (!(std::abs(e) < near))
    return std::pow(x, p);
  double sum = 1;
  for (int k = 8; k > 0; --k)
    sum = 1 + (p - (k - 1)) * (1. / k) * e * sum;
  return sum;
}

}  // namespace riven
