// Powers of numbers near one against those of the standard library.
#include "core/math/power.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace riven {
namespace {

TEST(PowerNearOne, HasAllDigitsNearOneAndBeyond) {
  for (const double p : {-1., -0.5, -0.49, 0., 0.3, 1.})
    for (int k = -2000; k <= 2000; ++k) {
      const double x = 1 + 1.1e-5 * k, exact = std::pow(x, p);
      EXPECT_NEAR(power_near_one(x, p), exact, 2 * std::numeric_limits<double>::epsilon() * exact) << x << "^" << p;
    }
  EXPECT_DOUBLE_EQ(power_near_one(0.25, -0.5), 2);
  EXPECT_TRUE(std::isnan(power_near_one(std::numeric_limits<double>::quiet_NaN(), -0.5)));
}

}  // namespace
}  // namespace riven
