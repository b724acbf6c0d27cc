// Orders, limits and fronts of studies, against data of known order.
#include <gtest/gtest.h>

#include <cmath>

#include "io/study/fits.hpp"

namespace riven::study {
namespace {

const double none = std::nan("");

TEST(StudyFits, FindTheOrderOfAPower) {
  const std::vector<double> h{4, 2, 1, 0.4};
  std::vector<double> error;
  for (const double x : h)
    error.push_back(0.3 * std::pow(x, 1.7));
  EXPECT_NEAR(log_slope(h, error), 1.7, 1e-12);
  error[1] = none;
  EXPECT_TRUE(std::isnan(log_slope(h, error)));
  EXPECT_TRUE(std::isnan(log_slope({2, 2}, {1, 3})));
}

TEST(StudyFits, ExtrapolateWhateverTheRatios) {
  for (const double order : {0.5, 1., 2., 4.}) {
    const std::vector<double> h{0.25, 2, 0.1, 1};  // in any order; the three smallest count
    std::vector<double> values;
    for (const double x : h)
      values.push_back(7 - 3 * std::pow(x, order));
    values[1] = 100;
    const std::optional<Limit> l = extrapolate(h, values);
    ASSERT_TRUE(l) << order;
    EXPECT_NEAR(l->value, 7, 1e-9) << order;
    EXPECT_NEAR(l->order, order, 1e-9);
  }
}

TEST(StudyFits, DoNotExtrapolateWhatDoesNotConverge) {
  EXPECT_FALSE(extrapolate({4, 2, 1}, {1, 2, 1.5}));   // to and fro
  EXPECT_FALSE(extrapolate({4, 2, 1}, {1, 2, 4}));     // further apart with each
  EXPECT_FALSE(extrapolate({4, 2, 1}, {1, 2, 2}));     // faster than any order
  EXPECT_FALSE(extrapolate({4, 2, 1}, {1, none, 2}));  // two are left
  EXPECT_FALSE(extrapolate({4, 2}, {1, 2}));
}

TEST(StudyFits, AgreeOnTheMiddle) {
  const std::optional<Consensus> c = agree({10, 11, 9, 50, 10.5});
  ASSERT_TRUE(c);
  EXPECT_EQ(c->value, 10.5);
  EXPECT_EQ(c->spread, 0.5);
  EXPECT_EQ(c->count, 5u);
  EXPECT_FALSE(agree({}));
}

TEST(StudyFits, FrontHoldsWhatNothingBeats) {
  const std::vector<Point> points{{5, 0.01}, {1, 0.2}, {2, 0.3}, {2, none}, {3, 0.05}, {3, 0.04}, {9, 0.01}};
  EXPECT_EQ(pareto_front(points), (std::vector<size_t>{1, 5, 0}));
  EXPECT_EQ(cheapest(points, 0.1), std::optional<size_t>(5));
  EXPECT_EQ(cheapest(points, 0.2), std::optional<size_t>(1));
  EXPECT_EQ(cheapest(points, 0.001), std::nullopt);
}

}  // namespace
}  // namespace riven::study
