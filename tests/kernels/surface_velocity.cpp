// What a force on a crack's surface is to the nodes around it.
#include "kernels/surface_velocity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace riven {
namespace {

constexpr double h = 0.5;

/// The nodes around a point at `r` cells from the middle one.
AxisWeights axis(double r) {
  return {{h * (-1 - r), h * -r, h * (1 - r)},
          {std::max(0., -r), 1 - std::fabs(r), std::max(0., r)},
          {0.5 * (0.5 - r) * (0.5 - r), 0.75 - r * r, 0.5 * (0.5 + r) * (0.5 + r)}};
}

/// The faces move by a linear function of the velocities of the nodes; forces go to the nodes by its transposed, or a
/// stiff law between the faces would make energy. Half of the masses are missing, as beside a crack.
TEST(SurfaceForce, DoesOnNodesTheWorkThatItDoesOnTheSurface) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int trial = 0; trial < 200; ++trial) {
    const AxisWeights x = axis(0.5 * any(random)), y = axis(0.5 * any(random));
    const Vec2 F{any(random), any(random)};
    double mass[9];
    Vec2 v[9];
    SurfaceSums sums;
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        const int n = 3 * j + i;
        mass[n] = j == 0 && trial % 2 == 0 ? 0 : std::pow(10., 2 * any(random) - 2);
        v[n] = {any(random), any(random)};
        sums.add(mass[n] * x.near[i] * y.near[j], mass[n] * x.wide[i] * y.wide[j], x.r[i], y.r[j], v[n], {});
      }
    const MassAround around(sums);
    const TurningForce turning(around, F, h);
    double work = 0, moment = 0, size = 0;
    Vec2 all;
    for (int n = 0; n < 9; ++n) {
      const int i = n % 3, j = n / 3;
      const Vec2 r{x.r[i], y.r[j]};
      const Vec2 f = mass[n] * around.near * x.near[i] * y.near[j] * F + turning.on(mass[n], x.wide[i] * y.wide[j], r);
      work += dot(f, v[n]);
      all += f;
      moment += cross(r, f);
      size += norm(f);
    }
    EXPECT_NEAR(work, dot(F, fit_motion(sums, h).before), 1e-9 * size);
    EXPECT_NEAR(norm(all - F), 0, 1e-9 * size);
    // about the point; mu (surface_velocity.hpp) withstands turning
    EXPECT_NEAR(moment, 0, 1e-5 * size * h);
  }
}

/// A force off a row of nodes, above which a node has next to no mass, as at the corner of a body that has been cut
/// off: however little that is, the node is not set in motion by more than some times what all of them are.
TEST(SurfaceForce, HurlsNoNodeOff) {
  const Vec2 F{3, -4};
  double hardest = 0;
  for (double mass_above = 1e-9; mass_above < 1; mass_above *= 1.5)
    for (const double place : {-0.4, 0., 0.3, 0.5}) {
      const AxisWeights x = axis(0.2), y = axis(place);
      const auto mass = [&](int i, int j) { return j == 0 ? 1 : i == 1 && j == 1 ? mass_above : 0; };
      SurfaceSums sums;
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
          sums.add(mass(i, j) * x.near[i] * y.near[j], mass(i, j) * x.wide[i] * y.wide[j], x.r[i], y.r[j], {}, {});
      if (!(sums.near > 0.05))
        continue;
      const MassAround around(sums);
      const TurningForce turning(around, F, h);
      const Vec2 a = (1 / mass_above) * turning.on(mass_above, x.wide[1] * y.wide[1], {x.r[1], y.r[1]});
      hardest = std::max(hardest, norm(a) * sums.wide / norm(F));
    }
  EXPECT_LT(hardest, 50);
  EXPECT_GT(hardest, 1);
}

}  // namespace
}  // namespace riven
