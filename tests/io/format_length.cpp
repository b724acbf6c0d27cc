// Lengths in messages are in the unit that a user would take.
#include "io/format_length.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace riven {
namespace {

TEST(Lengths, AreInMillimetresWhereTheyAreOfThatSize) {
  EXPECT_EQ(format_length(0), "0 mm");
  EXPECT_EQ(format_length(0.0125), "12.5 mm");
  EXPECT_EQ(format_length(-10e-6), "-0.01 mm");
  EXPECT_EQ(format_length(9.5), "9500 mm");
  EXPECT_EQ(format_length(1.23456789e-3, 3), "1.23 mm");
}

TEST(Lengths, AreInLargerAndSmallerUnitsBeyond) {
  EXPECT_EQ(format_length(3e-6), "3 um");
  EXPECT_EQ(format_length(-250e-9), "-250 nm");
  EXPECT_EQ(format_length(12), "12 m");
  EXPECT_EQ(format_length(2400), "2.4 km");
  EXPECT_EQ(format_length(std::numeric_limits<double>::infinity()), "inf mm");
}

TEST(Lengths, OfAPlaceShareTheUnitOfTheLarger) {
  EXPECT_EQ(format_place({3e-3, -2e-6}), "(3, -0.002) mm");
  EXPECT_EQ(format_place({-5000, 100}), "(-5, 0.1) km");
  EXPECT_EQ(format_size({2e-6, 1e-6}, 4), "2 x 1 um");
}

}  // namespace
}  // namespace riven
