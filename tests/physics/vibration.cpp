// Manufactured vibration along the axes (after Wallstedt and Guilkey 2008, section 5.2): a neo-Hookean unit square
// between rigid, smooth walls is driven to move as
//   u = A sin(pi X) sin(w t),   v = A sin(pi Y) sin(w t + pi),   w = pi sqrt(E / rho),
// by the body force b = u_tt - (1/rho0) dP_xx/dX (and likewise along y). With Fx = 1 + du/dX, Fy = 1 + dv/dY and the
// law's P_xx = mu (Fx - 1/Fx) + lambda/2 (Fx Fy^2 - 1/Fx),
//   dP_xx/dX = d2u/dX2 [ mu (1 + 1/Fx^2) + lambda/2 (Fy^2 + 1/Fx^2) ].
// What is measured is the root-mean-square error of the displacement over all particles and over one period.
//
// Two errors of the quadrature by particles do not fall with the mesh, and are kept below the mesh's own:
// - Linear functions integrate each cell's stress by the mean over its particles. Where these have moved by d, the
// force
//   on a node is that of the point d away: an error of the relative size A, on any mesh and with any number of
//   particles. At A = 1e-4 it is 1.7e-4, as large as the mesh's error with 128 cells.
// - Particles that cross cells lie unevenly under the nodes. What that adds to the forces falls with the particles per
//   cell, not with the mesh. With 2 x 2 of them it is more than the mesh's error from 64 cells on, in every transfer
//   and at any time step; so there are as many of them here as the finest mesh needs.
#include <gtest/gtest.h>

#include <numbers>

#include "core/error.hpp"
#include "kernels/dispatch.hpp"
#include "tests/physics/scenes.hpp"

namespace riven {
namespace {

using namespace test;
constexpr double pi = std::numbers::pi;

struct Motion {
  double amplitude, omega, lambda, mu;  ///< Lame's constants over density

  Vec2 swing(double t) const { return amplitude * Vec2{std::sin(omega * t), std::sin(omega * t + pi)}; }
  Vec2 rate(double t) const { return amplitude * omega * Vec2{std::cos(omega * t), std::cos(omega * t + pi)}; }
  /// Body force per mass at the particle whose sines and cosines of pi X, pi Y are s and c.
  Vec2 force(Vec2 s, Vec2 c, Vec2 swing) const {
    const double Fx = 1 + pi * swing.x * c.x, Fy = 1 + pi * swing.y * c.y;
    const double ux = swing.x * s.x, uy = swing.y * s.y;
    const auto stiffness = [&](double F, double G) {
      return mu * (1 + 1 / (F * F)) + 0.5 * lambda * (G * G + 1 / (F * F));
    };
    return {(pi * pi * stiffness(Fx, Fy) - omega * omega) * ux, (pi * pi * stiffness(Fy, Fx) - omega * omega) * uy};
  }
};

/// Adds the body force to the grid's forces.
template <class Shape>
void add_forces(Simulation& m, const Motion& motion, const std::vector<Vec2>& s, const std::vector<Vec2>& c) {
  auto& p = m.state.particles;
  const Lattice& l = m.state.grid.lattice;
  const Vec2 swing = motion.swing(m.state.clock.time + 0.5 * m.state.clock.dt);
  double* q = m.state.grid.q.data();
  for (int i = 0; i < p.count(); ++i) {
    const size_t id = static_cast<size_t>(p.id[i]);
    const Vec2 f = p.mass[i] * motion.force(s[id], c[id], swing);
    const auto a = Shape::axis((p.x[0][i] - l.origin.x) / l.h, m.state.domains[0].axis[0]);
    const auto b = Shape::axis((p.x[1][i] - l.origin.y) / l.h, m.state.domains[0].axis[1]);
    for (int j = 0; j < Shape::width; ++j)
      for (int k = 0; k < Shape::width; ++k) {
        double* node = q + 4L * ((b.base + j) * l.nx + a.base + k);
        node[2] += f.x * a.s[k] * b.s[j];
        node[3] += f.y * a.s[k] * b.s[j];
      }
  }
}

/// RMS displacement error over the amplitude.
double error(ShapeFunction shape, int cells, double amplitude, int particles_per_cell = 2) {
  Scene scene = empty_scene(1. / cells, {{0, 0}, {1, 1}}, LawKind::neo_hookean);
  scene.shape = shape;
  scene.cfl = 0.4;
  scene.limits.energy_growth = 1e9;  // the manufactured force's work is not booked
  scene.bodies = {body("square", Rectangle{{0, 0}, {1, 1}})};
  scene.bodies[0].particles_per_cell = particles_per_cell;
  for (const int axis : {0, 1}) {
    scene.symmetry.push_back({axis, 0, +1});
    scene.symmetry.push_back({axis, 1, -1});
  }
  Probe keep;  // makes the particles remember where they started
  keep.kind = Probe::Kind::displacement;
  scene.probes = {keep};
  const Elasticity e = elasticity(scene.materials[0]);
  const double c0 = std::sqrt(scene.materials[0].E / scene.materials[0].density);
  const Motion motion{amplitude, pi * c0, e.lambda, e.mu};
  scene.end_time = 2 / c0;

  const exec::Space space;
  Simulation m(scene, space);
  auto& p = m.state.particles;
  std::vector<Vec2> s(static_cast<size_t>(p.count())), c(s.size());
  for (int i = 0; i < p.count(); ++i) {
    const size_t id = static_cast<size_t>(p.id[i]);
    const double X = pi * p.x0[0][i], Y = pi * p.x0[1][i];
    s[id] = {std::sin(X), std::sin(Y)};
    c[id] = {std::cos(X), std::cos(Y)};
    const Vec2 rate = motion.rate(0);
    p.v[0][i] = rate.x * s[id].x;
    p.v[1][i] = rate.y * s[id].y;
  }
  const auto advance =
      std::find_if(m.tasks.begin(), m.tasks.end(), [](const Task& t) { return t.label == "advance grid"; });
  m.tasks.insert(advance, {"manufactured force", "test", [&](Simulation& n) {
                             with_shape(shape,
                                        [&](auto type) { add_forces<typename decltype(type)::type>(n, motion, s, c); });
                           }});
  double sum = 0;
  long count = 0;
  while (!m.finished()) {
    m.step();
    const Vec2 swing = motion.swing(m.state.clock.time);
    for (int i = 0; i < p.count(); ++i) {
      const size_t id = static_cast<size_t>(p.id[i]);
      const double ex = p.x[0][i] - p.x0[0][i] - swing.x * s[id].x, ey = p.x[1][i] - p.x0[1][i] - swing.y * s[id].y;
      sum += ex * ex + ey * ey;
    }
    count += p.count();
  }
  return std::sqrt(sum / static_cast<double>(count)) / amplitude;
}

/// Errors on meshes of `from`, 2 from, ... `to` cells.
std::vector<double> errors(ShapeFunction shape, int from, int to, double amplitude, int particles_per_cell = 2) {
  std::vector<double> list;
  for (int n = from; n <= to; n *= 2) {
    list.push_back(error(shape, n, amplitude, particles_per_cell));
    std::printf("%s, amplitude %g, %d cells: %.3e", name_of(shape).data(), amplitude, n, list.back());
    if (list.size() > 1)
      std::printf(", order %.2f", std::log2(list[list.size() - 2] / list.back()));
    std::printf("\n");
  }
  return list;
}

/// Least order between neighbouring meshes.
double least_order(const std::vector<double>& errors) {
  double least = 1e9;
  for (size_t k = 1; k < errors.size(); ++k)
    least = std::min(least, std::log2(errors[k - 1] / errors[k]));
  return least;
}

/// Order over all meshes: slope of the line of least squares through log(error) against log(h).
double mean_order(const std::vector<double>& errors) {
  const double middle = 0.5 * (static_cast<double>(errors.size()) - 1);
  double xx = 0, xy = 0;
  for (size_t k = 0; k < errors.size(); ++k) {
    const double x = static_cast<double>(k) - middle;
    xx += x * x;
    xy -= x * std::log2(errors[k]);
  }
  return xy / xx;
}

constexpr double small = 1e-4;  ///< no particle leaves its cell
constexpr double large = 0.05;  ///< as far as six cells of 1/128

TEST(Vibration, LinearIsOfSecondOrderWithoutCrossings) {
  EXPECT_GE(mean_order(errors(ShapeFunction::linear, 16, 128, small)), 1.8);
}
/// Far enough below the smallest mesh's error, the particles' displacement leaves the order alone.
TEST(Vibration, LinearIsOfSecondOrderOnEveryMeshWhereParticlesMoveLittle) {
  EXPECT_GE(least_order(errors(ShapeFunction::linear, 16, 128, 0.1 * small)), 1.8);
}
TEST(Vibration, UGimpIsOfSecondOrderWithoutCrossings) {
  EXPECT_GE(least_order(errors(ShapeFunction::ugimp, 16, 128, small)), 1.8);
}
TEST(Vibration, BSplineIsOfSecondOrderWithoutCrossings) {
  EXPECT_GE(least_order(errors(ShapeFunction::bspline, 16, 128, small)), 1.8);
}

TEST(Vibration, UGimpConvergesAcrossCells) {
  EXPECT_GE(least_order(errors(ShapeFunction::ugimp, 16, 64, large, 8)), 1.5);
}
TEST(Vibration, BSplineIsOfSecondOrderAcrossCells) {
  EXPECT_GE(least_order(errors(ShapeFunction::bspline, 16, 128, large, 10)), 1.8);
}

/// With four particles per cell, and across up to three cells, the smooth functions stay within a per cent.
TEST(Vibration, SmoothFunctionsStayAccurateAcrossCells) {
  EXPECT_LT(error(ShapeFunction::ugimp, 64, large), 0.01);
  EXPECT_LT(error(ShapeFunction::bspline, 64, large), 0.01);
}

/// Negative control: the error grows with every refinement, since the stress of a particle that changes its cell jumps
/// to other nodes (Bardenhagen and Kober 2004).
TEST(Vibration, LinearFailsAcrossCells) {
  for (const int particles_per_cell : {2, 8}) {
    bool fails = false;
    try {
      fails = mean_order(errors(ShapeFunction::linear, 16, 64, large, particles_per_cell)) < 0;
    } catch (const Error& e) {
      fails = e.code() == Exit::unstable;
    }
    EXPECT_TRUE(fails) << particles_per_cell;
  }
}

}  // namespace
}  // namespace riven
