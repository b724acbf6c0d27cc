// A free disk that spins once in 1,000 steps keeps its centripetal stress on average over the turn; about that it
// breathes by a few per cent, because its staircase of particles is no circle. It keeps its size and its angular
// momentum: strain increments of the first order in time let both grow by 2 %. The stress (Timoshenko and Goodier,
// Theory of Elasticity, section 32), with k = nu in plane stress and nu / (1 - nu) in plane strain:
//   sigma_r = (3 + k)/8 rho w^2 (R^2 - r^2),   sigma_t = rho w^2 ((3 + k) R^2 - (1 + 3 k) r^2) / 8.
#include <numbers>

#include "kernels/dispatch.hpp"
#include "tests/spaces.hpp"
#include "tests/stability/gates.hpp"

namespace riven {
namespace {

using namespace test;
using namespace hard_cases;

constexpr double rho = 1000, E = 1e6, nu = 0.3;

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

struct Turned {
  double radial = 0, hoop = 0;  ///< mean errors of the stresses, over the stress in the middle
  double breath = 0;            ///< the largest of them
  double energy = 0, angular = 0, momentum = 0;
  double growth = 0;  ///< of the mean size
};

/// Turns a disk of radius 1 m once, in so many steps, from the closed form's state.
Turned spin(LawKind law, Plane plane, ShapeFunction shape, int cells, int steps) {
  const double h = 1. / cells;
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
  const ChosenSpace space;
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
  EXPECT_EQ(turned, steps);
  return {std::abs(radial_error / samples),
          std::abs(hoop_error / samples),
          breath,
          energy,
          m.state.ledger.momentum.angular_error(),
          m.state.ledger.momentum.error(),
          std::abs(mean_size / samples / first_size - 1)};
}

void expect_turned(LawKind law, Plane plane, ShapeFunction shape) {
  const Turned r = spin(law, plane, shape, 20, 1000);
  const std::string row =
      fmt::format("disk turned in 1000 steps, {}, plane {}, {}", name_of(law), name_of(plane), name_of(shape));
  below(row + ": radial stress, mean error", r.radial, 0.02);
  below(row + ": hoop stress, mean error", r.hoop, 0.02);
  below(row + ": energy drift", r.energy, 0.01);
  EXPECT_LT(r.breath, 0.1);
  EXPECT_LT(r.growth, 0.002);
  EXPECT_LT(r.angular, 0.002);
  EXPECT_LT(r.momentum, 1e-12);
}

TEST(SpinningDisk, KeepsItsCentripetalStressAndEnergy) {
  for (const LawKind law : {LawKind::linear_elastic, LawKind::neo_hookean})
    for (const Plane plane : {Plane::strain, Plane::stress})
      expect_turned(law, plane, ShapeFunction::ugimp);
}

TEST(SpinningDisk, KeepsItsCentripetalStressWithBSplines) {
  expect_turned(LawKind::linear_elastic, Plane::strain, ShapeFunction::bspline);
}

/// The rim of a disk of four cells moves at 0.36 of the speed of waves, and strains it by 7 %.
TEST(SpinningDisk, MayTurnInAHundredSteps) {
  for (const LawKind law : {LawKind::linear_elastic, LawKind::neo_hookean}) {
    const Turned r = spin(law, Plane::strain, ShapeFunction::ugimp, 4, 100);
    const std::string row = fmt::format("disk of 4 cells turned in 100 steps, {}", name_of(law));
    note(row + ": radial stress, mean error", r.radial);
    note(row + ": hoop stress, mean error", r.hoop);
    below(row + ": energy drift", r.energy, 0.01);
    below(row + ": momentum error", r.momentum, 1e-12);
  }
}

}  // namespace
}  // namespace riven
