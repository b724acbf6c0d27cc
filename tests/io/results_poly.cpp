// What frames say about particles and cracks, against closed forms.
#include <gtest/gtest.h>

#include "core/laws/elastic.hpp"
#include "io/crack_opening.hpp"
#include "io/frames.hpp"
#include "tests/io/results_sample.hpp"

namespace riven {
namespace {

const PolyArray& find(const std::vector<PolyArray>& arrays, const std::string& name) {
  for (const PolyArray& a : arrays)
    if (a.name == name)
      return a;
  throw std::runtime_error("no array " + name);
}
const std::vector<double>& reals(const PolyData& d, const std::string& name) {
  return std::get<std::vector<double>>(find(d.point_arrays, name).data);
}
const std::vector<std::int64_t>& integers(const PolyData& d, const std::string& name) {
  return std::get<std::vector<std::int64_t>>(find(d.point_arrays, name).data);
}
bool has(const PolyData& d, const std::string& name) {
  for (const PolyArray& a : d.point_arrays)
    if (a.name == name)
      return true;
  return false;
}

PolyData particle_frame(const Particles<double, 2>& particles, const Scene& scene) {
  PolyData d = particle_poly(particles, scene);
  for (PolyArray& a : d.point_arrays)
    a.settle();
  return d;
}

TEST(ResultsPoly, ParticlesComeInTheOrderOfTheirIds) {
  const auto p = sample::particles(1);
  const PolyData d = particle_frame(p, sample::scene());
  ASSERT_EQ(d.point_count(), p.count());
  ASSERT_EQ(d.cell_count(), p.count());
  for (int i = 0; i < p.count(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    EXPECT_EQ(integers(d, "id")[k], i);
    EXPECT_DOUBLE_EQ(d.points[3 * k], (i % sample::nx + 0.5) * sample::cell / 2);
    EXPECT_EQ(d.points[3 * k + 2], 0);
    EXPECT_NEAR(reals(d, "displacement")[3 * k + 1],
                sample::amplitude * std::sin(std::numbers::pi * d.points[3 * k] / sample::width), 1e-18);
    EXPECT_DOUBLE_EQ(reals(d, "size")[k], sample::cell / 2);
  }
}

TEST(ResultsPoly, FieldsAreSingleUnlessSaidOtherwiseButPositionsAreNot) {
  const auto p = sample::particles(1);
  Scene scene = sample::scene();
  const PolyData exact = particle_frame(p, scene);
  scene.output.precision = Output{}.precision;
  const PolyData d = particle_frame(p, scene);
  EXPECT_EQ(d.points, exact.points);
  for (const char* name : {"size", "velocity", "displacement", "stress", "von_mises", "J", "deformation_gradient"}) {
    const auto& values = std::get<std::vector<float>>(find(d.point_arrays, name).data);
    const std::vector<double>& of_double = reals(exact, name);
    ASSERT_EQ(values.size(), of_double.size());
    for (std::size_t k = 0; k < values.size(); ++k)
      EXPECT_EQ(values[k], static_cast<float>(of_double[k])) << name << " " << k;
  }
  EXPECT_EQ(integers(d, "id"), integers(exact, "id"));
}

TEST(ResultsPoly, StressIsCauchyWithItsOutOfPlanePart) {
  const Scene s = sample::scene();
  const auto p = sample::particles(1);
  const PolyData d = particle_frame(p, s);
  for (std::size_t k = 0; k < static_cast<std::size_t>(p.count()); ++k) {
    const double* t = reals(d, "stress").data() + 6 * k;
    const double zz = sample::nu * 4e6;
    EXPECT_NEAR(t[0], 1e6, 1e-3);
    EXPECT_NEAR(t[1], 3e6, 1e-3);
    EXPECT_NEAR(t[2], zz, 1e-3);
    const double mises = std::sqrt(0.5 * (4e12 + std::pow(3e6 - zz, 2) + std::pow(zz - 1e6, 2)) + 3 * t[3] * t[3]);
    EXPECT_NEAR(reals(d, "von_mises")[k], mises, 1e-6 * mises);
    EXPECT_NEAR(reals(d, "fringe")[k], std::cos(sample::fringe_constant * std::sqrt(4e12 + 4 * t[3] * t[3])), 1e-9);
  }
}

// A linear elastic square in plane stress under uniaxial stress s: von Mises stress s, no stress out of the plane,
// and a thickness that follows Poisson's effect.
TEST(ResultsPoly, PlaneStressHasNoStressAcrossThePlane) {
  Scene s = sample::scene();
  s.plane = Plane::stress;
  auto p = sample::particles(0);
  const double sigma = 5e6, strain = sigma / sample::E_modulus;
  const double Fxx = 1 - sample::nu * strain, Fyy = 1 + strain, Fzz = 1 - sample::nu * strain;
  for (int i = 0; i < p.count(); ++i) {
    p.F[0][i] = Fxx;
    p.F[3][i] = Fyy;
    p.stress[0][i] = p.stress[2][i] = 0;
    p.stress[1][i] = sigma * Fxx * Fyy * Fzz / sample::density;
  }
  const PolyData d = particle_frame(p, s);
  EXPECT_NEAR(reals(d, "J")[7], Fxx * Fyy * Fzz, 5 * strain * strain);
  EXPECT_EQ(reals(d, "stress")[6 * 7 + 2], 0);
  EXPECT_NEAR(reals(d, "von_mises")[7], sigma, 1e-5 * sigma);
}

// tau = mu (b - I) + lambda/2 (J^2 - 1) I, sigma = tau/J, for a stretch s of the plane and none across it.
TEST(ResultsPoly, NeoHookeanStretchHasItsClosedForm) {
  Scene s = sample::scene();
  s.materials[0].law = LawKind::neo_hookean;
  auto p = sample::particles(0);
  const double stretch = 1.2, J = stretch * stretch;
  const NeoHookean<double> law(s.materials[0], s.plane);
  for (int i = 0; i < p.count(); ++i) {
    LawState<double> state{{1, 0, 0, 1}, 1, 0, 0, 0};
    law.update({stretch - 1, 0, 0, stretch - 1}, state);
    p.F[0][i] = p.F[3][i] = stretch;
    p.F[2][i] = 0;
    p.stress[0][i] = state.xx;
    p.stress[1][i] = state.yy;
    p.stress[2][i] = state.xy;
  }
  const PolyData d = particle_frame(p, s);
  const double mu = sample::E_modulus / (2 * (1 + sample::nu));
  const double lambda = 2 * mu * sample::nu / (1 - 2 * sample::nu), pressure = 0.5 * lambda * (J * J - 1);
  EXPECT_NEAR(reals(d, "stress")[0], (mu * (J - 1) + pressure) / J, 1e-3);
  EXPECT_NEAR(reals(d, "stress")[2], pressure / J, 1e-3);
  EXPECT_DOUBLE_EQ(reals(d, "J")[0], J);
}

TEST(ResultsPoly, ArraysThatWereNotKeptAreNotWritten) {
  Scene s = sample::scene();
  s.output.fields.clear();
  auto p = sample::particles(1);
  for (auto& a : p.F)
    a = {};
  for (auto& a : p.x0)
    a = {};
  p.J.resize(p.count());
  for (double& J : p.J)
    J = 0.5;
  const PolyData d = particle_frame(p, s);
  for (const char* name : {"displacement", "deformation_gradient", "fringe"})
    EXPECT_FALSE(has(d, name)) << name;
  EXPECT_NEAR(reals(d, "stress")[0], 2e6, 1e-3) << "Kirchhoff stress over J";
}

TEST(ResultsPoly, CracksAreLinesWithOpeningAndSurfaces) {
  const double t = 0.5;
  const Cracks c = sample::cracks(t);
  const PolyData d = crack_poly(c);
  EXPECT_EQ(d.kind, PolyData::Cells::lines);
  EXPECT_EQ(d.offsets, (std::vector<std::int64_t>{0, 5, 9}));
  ASSERT_EQ(d.point_count(), 9);
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_EQ(d.connectivity[i], static_cast<std::int64_t>(i));
    EXPECT_EQ(integers(d, "crack")[i], i < 5 ? 0 : 1);
    EXPECT_NEAR(reals(d, "normal_opening")[i], 2e-5 * t, 1e-17);
    EXPECT_NEAR(reals(d, "sliding")[i], 1e-5 * t, 1e-17);
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_DOUBLE_EQ(reals(d, "upper")[3 * i + axis] - reals(d, "lower")[3 * i + axis],
                       reals(d, "opening")[3 * i + axis]);
  }
  EXPECT_NEAR(reals(d, "opening")[1], 2e-5 * t, 1e-17);
  EXPECT_EQ(std::get<std::vector<std::int64_t>>(find(d.cell_arrays, "crack").data), (std::vector<std::int64_t>{0, 1}));
}

TEST(ResultsPoly, ACrackOfOverlappingSurfacesHasNegativeOpening) {
  Cracks c = sample::cracks(1);
  c.upper.swap(c.lower);
  for (const CrackOpening& o : crack_openings(c))
    EXPECT_NEAR(o.normal, -2e-5, 1e-17);
}

}  // namespace
}  // namespace riven
