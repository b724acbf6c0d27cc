// J of a crack that turns sharply within its contour, with open faces.
#include <gtest/gtest.h>

#include "tests/physics/scene_gates.hpp"
#include "tests/physics/scenes.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace test;

/// J/m^2 at the end of a crack that runs in from the left edge of a plate under tension and then up by `leg` cells.
double J_behind_bend(double leg, int contour) {
  const ChosenSpace space;
  return last_J(
      pulled_plate(crack("bent", {{-22e-3, 0.3e-3}, {-8.2e-3, 0.3e-3}, {-8.2e-3, (0.3 + leg) * 1e-3}}), contour),
      space);
}

// On cells of a quarter of the size, with contours of 2 mm that stay clear of the bend, J is 11.2 J/m^2 behind 2 mm and
// 13.8 behind 4 mm. With the bend within the contour it was 4.1 and 7.3.
TEST(SharpBend, IsLeftOutOfTheContour) {
  for (const auto& [leg, contour, reference] : {std::tuple{2., 4, 11.2}, {4., 8, 13.8}, {4., 10, 13.8}}) {
    const double J = J_behind_bend(leg, contour);
    gates::report(
        fmt::format("{} cells behind a right angle, contour of {}: J over its reference, less 1", leg, contour),
        J / reference - 1, "0.12");
    EXPECT_NEAR(J, reference, 0.12 * reference);
  }
}

}  // namespace
}  // namespace riven
