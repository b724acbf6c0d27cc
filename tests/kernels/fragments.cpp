// Into how many fragments cracks have cut a plate of 16 x 16 cells.
#include "kernels/fragments.hpp"

#include <gtest/gtest.h>

#include "kernels/dispatch.hpp"
#include "tests/physics/scenes.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace test;

Scene plate(const std::vector<std::vector<Vec2>>& cracks) {
  Scene s = empty_scene(1. / 16, {{-0.5, -0.5}, {1.5, 1.5}});
  s.bodies = {body("plate", Rectangle{{0, 0}, {1, 1}})};
  for (const std::vector<Vec2>& points : cracks)
    s.cracks.push_back(crack("crack", points));
  return s;
}

/// Shares of the mass, in every shape function and precision.
void expect_fragments(const char* what, Scene s, const std::vector<double>& shares) {
  const ChosenSpace space;
  for (const Precision precision : {Precision::as_double, Precision::as_float})
    for (const ShapeFunction shape : {ShapeFunction::linear, ShapeFunction::ugimp, ShapeFunction::bspline}) {
      s.precision = precision;
      s.shape = shape;
      with_precision(precision, [&](auto real) {
        SimulationOf<typename decltype(real)::type> m(s, space);
        const std::vector<Fragment> found = find_fragments(m);
        ASSERT_EQ(found.size(), shares.size()) << what << ", " << name_of(shape);
        const double mass = static_cast<double>(m.state.particles.count()) * m.state.particles.mass[0];
        for (size_t k = 0; k < shares.size(); ++k) {
          EXPECT_NEAR(found[k].mass / mass, shares[k], 1e-5) << what << ", " << name_of(shape) << ", " << k;
          EXPECT_NEAR(static_cast<double>(found[k].particles) / 1024, shares[k], 1e-12) << what;
        }
      });
    }
}

TEST(Fragments, AreWhatCracksCutOff) {
  expect_fragments("no crack", plate({}), {1});
  expect_fragments("through", plate({{{-0.1, 0.28}, {1.1, 0.28}}}), {0.71875, 0.28125});
  expect_fragments("a ligament of half a cell", plate({{{-0.1, 0.28}, {0.97, 0.28}}}), {1});
  expect_fragments("crossing", plate({{{-0.1, 0.28}, {1.1, 0.28}}, {{0.47, -0.1}, {0.47, 1.1}}}),
                   {0.71875 * 0.53125, 0.71875 * 0.46875, 0.28125 * 0.53125, 0.28125 * 0.46875});
  expect_fragments("one ends on the other", plate({{{-0.1, 0.28}, {1.1, 0.28}}, {{0.47, 0.28}, {0.47, 1.1}}}),
                   {0.71875 * 0.53125, 0.71875 * 0.46875, 0.28125});
  expect_fragments("one ends short of the other", plate({{{-0.1, 0.28}, {1.1, 0.28}}, {{0.47, 0.33}, {0.47, 1.1}}}),
                   {0.71875, 0.28125});
  // inside and outside of a square
  expect_fragments("closed", plate({{{0.28, 0.28}, {0.72, 0.28}, {0.72, 0.72}, {0.28, 0.72}, {0.28, 0.28}}}),
                   {1 - 0.4375 * 0.4375, 0.4375 * 0.4375});
}

TEST(Fragments, AreWholeWhereFacesHoldTogether) {
  const std::vector<Vec2> across{{-0.1, 0.28}, {1.1, 0.28}}, upward{{0.47, -0.1}, {0.47, 1.1}};
  Scene s = plate({across, upward});
  for (const ContactLaw law : {ContactLaw::bonded, ContactLaw::interface}) {
    s.cracks[0].contact = ContactSettings{law, 0, 1e9, 1e9};
    expect_fragments("one of two that cross", s, {0.53125, 0.46875});
  }
}

/// Where the two halves are after they have parted.
TEST(Fragments, AreFoundWhereParticlesAreNow) {
  Scene s = plate({{{0.47, -0.1}, {0.47, 1.1}}});
  s.bodies = {body("left", Rectangle{{0, 0}, {0.46875, 1}}), body("right", Rectangle{{0.46875, 0}, {1, 1}})};
  s.bodies[0].velocity = {-1, 0};
  s.bodies[1].velocity = {1, 0};
  s.end_time = 0.2;
  const ChosenSpace space;
  Simulation m(s, space);
  while (!m.finished())
    m.step();
  const std::vector<Fragment> found = find_fragments(m);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].centre.x, 0.5 * (0.46875 + 1) + 0.2, 0.01);
  EXPECT_NEAR(found[1].centre.x, 0.5 * 0.46875 - 0.2, 0.01);
  EXPECT_NEAR(found[0].centre.y, 0.5, 1e-3);
}

}  // namespace
}  // namespace riven
