// A block between smooth plates, cut right through by a closed crack at an angle theta to them, under a pressure p on
// its sides. One uniform stress and a rigid slip along the crack satisfy every equation: the limit equilibrium of two
// wedges (C.A. Coulomb, 1773). With tan(phi) = mu the crack
//   sticks while the plates' pressure s is below the limit, so always where mu > tan(theta); the block then carries
//   what
//          it carries whole, in plane strain s = E e / (1 - nu^2) + p nu / (1 - nu);
//   slips  where s would pass   s W = (p W tan(theta) + kappa m v) / tan(theta - phi),
// W the width of the block, kappa m v what damping takes from a wedge of mass m that moves sideways with v, half the
// plate's speed over tan(theta). Without p, the block slides from under its load at once, or carries it for ever.
#include <gtest/gtest.h>

#include <numbers>
#include <utility>

#include "io/crack_opening.hpp"
#include "tests/physics/scene_gates.hpp"
#include "tests/physics/scenes.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace test;

constexpr double width = 1, height = 2, slope = 0.5, speed = 1e-3;  // m; tan(theta); of the upper plate, m/s
constexpr double E = 1e6, nu = 0.3, density = 1000, kappa = 5, end = 5;

Scene block_between_plates(double pressure, double mu) {
  Scene s = empty_scene(1. / 8, {{-0.5, -0.5}, {1.5, 2.5}});
  s.bodies = {body("block", Rectangle{{0, 0}, {width, height}})};
  FixedNodes lower, upper;
  lower.name = "lower plate";
  lower.box = {{-0.5, -0.5}, {1.5, 0}};
  lower.velocity[1] = constant(0);
  upper.name = "upper plate";
  upper.box = {{-0.5, height}, {1.5, 2.5}};
  upper.velocity[1] = constant(-speed);
  s.fixed = {lower, upper};
  for (const double side : {-1., 1.}) {
    Load push = traction_on(side < 0 ? Load::Edge::left : Load::Edge::right, s.bodies[0].region);
    push.name = side < 0 ? "left" : "right";
    push.value[0] = constant(-side * pressure);
    s.loads.push_back(push);
  }
  s.grid_damping = constant(kappa);
  s.contact = {ContactLaw::coulomb, mu, 0, 0};
  s.cracks = {crack("cut", {{-0.2, 0.65}, {1.2, 1.35}})};
  return s;
}

struct Squeezed {
  double carried = 0;  ///< Pa, pressure of the plates, mean of the last half second
  double slid = 0;     ///< m, of one face over the other inside the block, the most
};

Squeezed squeeze(double pressure, double mu) {
  const Scene scene = block_between_plates(pressure, mu);
  const ChosenSpace space;
  Simulation m(scene, space);
  Squeezed r;
  int n = 0;
  while (m.state.clock.time < end) {
    m.step();
    if (m.state.clock.time < end - 0.5)
      continue;
    r.carried += std::abs(m.state.constraints.owners[0].reaction.y) / width;
    ++n;
  }
  r.carried /= n;
  const auto openings = crack_openings(m.state.cracks);
  for (size_t k = 0; k < openings.size(); ++k)
    if (const double x = m.state.cracks.plane[static_cast<long>(k)].x; x > 0 && x < width)
      r.slid = std::max(r.slid, std::abs(openings[k].sliding));
  EXPECT_LT(m.contact_after.penetration, 0.05 * scene.cell);
  EXPECT_EQ(m.contact_after.capped, 0);
  return r;
}

double sticking(double pressure) {
  return E / (1 - nu * nu) * speed * (end - 0.25) / height + nu / (1 - nu) * pressure;
}
double slipping(double pressure, double mu) {
  const double wedge = density * width * height / 2, sideways = speed / slope / 2;
  return (pressure * width * slope + kappa * wedge * sideways) * (1 + slope * mu) / (slope - mu) / width;
}

/// mu 4 % below tan(theta) and 4 % above it; the slipping block carries nothing but the drag.
TEST(InclinedCrack, SticksOrSlipsAsItsFrictionIsAboveOrBelowItsSlope) {
  const Squeezed slips = squeeze(0, 0.48), sticks = squeeze(0, 0.52);
  EXPECT_NEAR(slips.carried, slipping(0, 0.48), 0.02 * slipping(0, 0.48));
  EXPECT_NEAR(sticks.carried, sticking(0), 0.005 * sticking(0));
  // the block, a spring in series with the drag of its wedges, has taken up this much of the time
  const double taken = slipping(0, 0.48) / sticking(0) * (end - 0.25), sine = slope / std::hypot(1, slope);
  EXPECT_NEAR(slips.slid, speed * (end - taken) / sine, 0.02 * slips.slid);
  EXPECT_LT(sticks.slid, 0.03 * slips.slid);
}

TEST(InclinedCrack, SlipsAtTheLimitOfEquilibrium) {
  for (const double mu : {0., 0.4}) {
    SCOPED_TRACE(mu);
    const Squeezed s = squeeze(300, mu);
    EXPECT_NEAR(s.carried, slipping(300, mu), 0.015 * slipping(300, mu));
  }
}

/// Side pressure raises the limit beyond what the plates reach.
TEST(InclinedCrack, SticksBelowTheLimitOfEquilibrium) {
  const Squeezed s = squeeze(300, 0.45);
  ASSERT_GT(slipping(300, 0.45), 1.2 * sticking(300));
  EXPECT_NEAR(s.carried, sticking(300), 0.005 * sticking(300));
  EXPECT_LT(s.slid, 0.02 * speed * end);
}

/// A block of 16 x 8 cells on a slope of 45 degrees that does not move, under a weight of 0.1 % of E that sets in at
/// once. The crack between them is a diagonal of the lattice of particles. Its acceleration along the slope over that
/// of one without friction, 1 - mu, by the speed that it has gained.
double acceleration_on_slope(double mu, bool reversed) {
  Scene s = empty_scene(1, {{-24, -30}, {30, 30}});
  const double r = std::numbers::sqrt2 / 2;
  const auto at = [&](double along, double up) { return Vec2{r * (along - up), r * (along + up)}; };
  const Polygon slope{{at(-20, -6), at(30, -6), at(30, 0), at(-20, 0)}};
  Body block = body("block", Polygon{{at(0, 0), at(16, 0), at(16, 8), at(0, 8)}});
  s.bodies = {body("slope", slope), block};
  s.cracks = {crack("foot", {at(-21, 0), at(31, 0)})};
  if (reversed)
    std::swap(s.cracks[0].points[0], s.cracks[0].points[1]);
  s.contact = {ContactLaw::coulomb, mu, 0, 0};
  s.grips = {grip_at_rest("slope", slope)};
  const double weight = 1e-3 * s.materials[0].E / (s.materials[0].density * 8);
  s.body_force[1] = constant(-weight);
  const ChosenSpace space;
  Simulation m(s, space);
  const auto speed = [&] {
    double sum = 0, mass = 0;
    for (long i = 0; i < m.state.particles.count(); ++i)
      if (m.state.particles.body[i] == 1) {
        const double part = m.state.particles.mass[i];
        sum -= part * r * (m.state.particles.v[0][i] + m.state.particles.v[1][i]);
        mass += part;
      }
    return sum / mass;
  };
  constexpr double settled = 3, seconds = 8;
  while (m.state.clock.time < settled)
    m.step();
  const double first = speed(), from = m.state.clock.time;
  while (m.state.clock.time < settled + seconds)
    m.step();
  return (speed() - first) / (m.state.clock.time - from) / (r * weight);
}

TEST(Slope, LetsABlockSlideWhereParticlesLieOnTheCrack) {
  for (const bool reversed : {false, true})
    for (const double mu : {0., 0.4}) {
      const double a = acceleration_on_slope(mu, reversed);
      gates::report(fmt::format("block on 45 degrees, friction {}: acceleration", mu), a,
                    fmt::format("{} +-0.02", 1 - mu));
      EXPECT_NEAR(a, 1 - mu, 0.02) << (reversed ? "crack drawn downwards" : "");
    }
}

}  // namespace
}  // namespace riven
