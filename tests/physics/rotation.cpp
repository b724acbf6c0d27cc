// A free disk that spins once in 1,000 steps keeps its centripetal stress on average over the turn; about that it
// breathes by a few per cent, because its staircase of particles is no circle. It keeps its size and its angular
// momentum: strain increments of the first order in time let both grow by 2 %. The stress (Timoshenko and Goodier,
// Theory of Elasticity, section 32), with k = nu in plane stress and nu / (1 - nu) in plane strain:
//   sigma_r = (3 + k)/8 rho w^2 (R^2 - r^2),   sigma_t = rho w^2 ((3 + k) R^2 - (1 + 3 k) r^2) / 8.
#include <gtest/gtest.h>

#include <numbers>

#include "kernels/dispatch.hpp"
#include "tests/physics/scenes.hpp"

namespace riven {
namespace {

using namespace test;

constexpr int steps = 1000, cells = 20;
constexpr double rho = 1000, E = 1e6, nu = 0.3, h = 1. / cells;

struct Polar {
  double radial, hoop;
};

struct RotatingDisk {
  double k, omega, R;
  Polar stress(double r) const {
    const double s = rho * omega * omega / 8;
    return {s * (3 + k) * (R * R - r * r), s * ((3 + k) * R * R - (1 + 3 * k) * r * r)};
  }
};

double plane_modulus(Plane plane) {
  return plane == Plane::stress ? E : E / (1 - nu * nu);
}

/// Root of the mean square of the particles' distance from the centre.
double size(const Simulation& m) {
  const auto& p = m.state.particles;
  double sum = 0;
  for (int i = 0; i < p.count(); ++i)
    sum += p.x[0][i] * p.x[0][i] + p.x[1][i] * p.x[1][i];
  return std::sqrt(sum / p.count());
}

/// Turns the disk once from the closed form's state.
void spin(LawKind law, Plane plane, ShapeFunction shape) {
  Scene s = empty_scene(h, {{-1.5, -1.5}, {1.5, 1.5}}, law);
  s.plane = plane;
  s.shape = shape;
  s.bodies = {body("disk", Disk{{0, 0}, 1})};
  const double k = plane == Plane::stress ? nu : nu / (1 - nu);
  const double dt = 0.7 * h / std::sqrt(E * (1 - nu) / ((1 + nu) * (1 - 2 * nu)) / rho);
  s.dt_max = dt;
  s.cfl = 2;
  s.end_time = steps * dt;
  s.bodies[0].spin = 2 * std::numbers::pi / s.end_time;
  const exec::Space space;
  Simulation m(s, space);
  auto& p = m.state.particles;
  // the radius of as many particles as there are
  const RotatingDisk disk{k, s.bodies[0].spin, std::sqrt(p.count() * h * h / 4 / std::numbers::pi)};
  const double modulus = plane_modulus(plane);
  for (int i = 0; i < p.count(); ++i) {
    const double x = p.x[0][i], y = p.x[1][i], r = std::hypot(x, y), c = x / r, t = y / r;
    const Polar q = disk.stress(r), e{(q.radial - k * q.hoop) / modulus, (q.hoop - k * q.radial) / modulus};
    const Mat2<double> strain{e.radial * c * c + e.hoop * t * t, (e.radial - e.hoop) * c * t,
                              (e.radial - e.hoop) * c * t, e.radial * t * t + e.hoop * c * c};
    with_law<double>(m.plan.law, [&](auto type) {
      using Law = typename decltype(type)::type;
      LawState<double> q0{{1, 0, 0, 1}, 1, 0, 0, 0};
      Law(s.materials[0], plane).update(strain, q0);
      p.stress[0][i] = q0.xx;
      p.stress[1][i] = q0.yy;
      p.stress[2][i] = q0.xy;
      if constexpr (Law::keeps_F) {
        p.F[0][i] = q0.F.xx;
        p.F[1][i] = q0.F.xy;
        p.F[2][i] = q0.F.yx;
        p.F[3][i] = q0.F.yy;
      } else {
        p.J[i] = q0.J;
      }
    });
  }
  m.take_stock();
  const double first = m.state.ledger.energy.total(), first_size = size(m);
  const double peak = disk.stress(0).radial;
  double radial_error = 0, hoop_error = 0, breath = 0, energy = 0, mean_size = 0;
  int samples = 0;
  int turned = 0;
  for (int n = 1; !m.finished(); ++n) {
    m.step();
    turned = n;
    if (n % 10 != 0)
      continue;
    m.take_stock();
    energy = std::max(energy, std::abs(m.state.ledger.energy.total() / first - 1));
    // mean error over the inner half of the disk, where no staircase of particles is near
    double radial = 0, hoop = 0;
    int count = 0;
    for (int i = 0; i < p.count(); ++i) {
      const double x = p.x[0][i], y = p.x[1][i], r = std::hypot(x, y), c = x / r, t = y / r;
      if (r > 0.5)
        continue;
      const double sr = p.stress[0][i] * c * c + p.stress[1][i] * t * t + 2 * p.stress[2][i] * c * t;
      const double st = p.stress[0][i] + p.stress[1][i] - sr;
      radial += rho * sr - disk.stress(r).radial;
      hoop += rho * st - disk.stress(r).hoop;
      ++count;
    }
    radial /= count * peak;
    hoop /= count * peak;
    radial_error += radial;
    hoop_error += hoop;
    mean_size += size(m);
    ++samples;
    breath = std::max({breath, std::abs(radial), std::abs(hoop)});
  }
  SCOPED_TRACE(testing::Message() << name_of(law) << " " << name_of(plane) << " " << name_of(shape));
  EXPECT_EQ(turned, steps);
  EXPECT_LT(std::abs(radial_error / samples), 0.02);
  EXPECT_LT(std::abs(hoop_error / samples), 0.02);
  EXPECT_LT(breath, 0.1);
  EXPECT_LT(energy, 0.01);
  EXPECT_NEAR(mean_size / samples, first_size, 0.002 * first_size);
  EXPECT_LT(m.state.ledger.momentum.angular_error(), 0.002);
  EXPECT_LT(m.state.ledger.momentum.error(), 1e-12);
}

TEST(SpinningDisk, KeepsItsCentripetalStressAndEnergy) {
  for (const LawKind law : {LawKind::linear_elastic, LawKind::neo_hookean})
    for (const Plane plane : {Plane::strain, Plane::stress})
      spin(law, plane, ShapeFunction::ugimp);
}

TEST(SpinningDisk, KeepsItsCentripetalStressWithBSplines) {
  spin(LawKind::linear_elastic, Plane::strain, ShapeFunction::bspline);
}

}  // namespace
}  // namespace riven
