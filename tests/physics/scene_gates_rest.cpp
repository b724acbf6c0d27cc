// The double cantilever beam at rest, against finite elements on the grid of the run: square four-node elements, the
// crack as doubled nodes on the mid-plane, the same loads and fixed nodes (J.A. Nairn, CMES 4 (2003) 649-664, section
// 3.1 and figure 2).
#include <cmath>

#include "io/particle_stress.hpp"
#include "tests/physics/q4_plate.hpp"
#include "tests/physics/scene_gates.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace gates;

constexpr int columns = 50, rows = 18, half_rows = 9, tip_column = 25;  // elements; the last node of the ligament

test::Q4Plate finite_elements(const Simulation& m) {
  const Scene& s = m.scene;
  test::Q4Plate plate({0, -half_rows * s.cell}, columns, rows, s.cell, s.materials[0], s.thickness, half_rows,
                      tip_column + 1);
  for (int j = 0; j <= rows; ++j)
    plate.fix(0, j, 0);
  plate.fix(0, half_rows, 1);
  const auto& p = m.state.particles;
  for (const Load& load : s.loads) {
    std::vector<Vec2> loaded;
    for (int i = 0; i < p.count(); ++i)
      if (const Vec2 X{p.x0[0][i], p.x0[1][i]}; contains(load.region, X))
        loaded.push_back(X);
    for (const Vec2 X : loaded)
      plate.push(X, {0, load.value[1](0) / static_cast<double>(loaded.size())});
  }
  plate.solve();
  return plate;
}

/// The whole beam when the scene's time is over, beside the finite elements.
struct AtRest {
  AtRest() : scene(shipped("dcb")), m(scene, space), plate(finite_elements(m)) {
    while (!m.finished())
      m.step();
    m.take_stock();
  }

  test::ChosenSpace space;
  Scene scene;
  Simulation m;
  test::Q4Plate plate;
};

const AtRest& at_rest() {
  static const AtRest beam;
  return beam;
}

TEST(BeamAtRest, HasNoKineticEnergyLeft) {
  const Energy& e = at_rest().m.state.ledger.energy;
  report("double cantilever beam, last kinetic over strain energy", e.kinetic / e.strain, "1e-6");
  EXPECT_LT(e.kinetic / e.strain, 1e-6);
  EXPECT_LT(std::abs(e.relative_error()), 0.0025);
}

/// The points of the particles integrate an element's stiffness at +-1/2, Gauss's at +-0.577: 0.7 % in the energy.
TEST(BeamAtRest, BendsAsFiniteElements) {
  const Energy& e = at_rest().m.state.ledger.energy;
  const double energy = e.strain / at_rest().plate.strain_energy() - 1;
  report("double cantilever beam, strain energy over that of finite elements, less 1", energy, "0.02");
  EXPECT_LT(std::abs(energy), 0.02);
}

/// sxx along the mid-plane, upper face, as the particles' stresses extrapolate to the nodes there, "by the same methods
/// used to extrapolate momenta"; the finite elements' stresses are taken at the same points and go the same way. The
/// two cells at the tip are left out.
TEST(BeamAtRest, HasTheStressOfFiniteElementsAlongTheMidPlane) {
  const AtRest& beam = at_rest();
  const auto& p = beam.m.state.particles;
  const double h = beam.scene.cell;
  const ParticleStress stress(p, beam.scene);
  std::vector<double> mass(columns + 1), run(columns + 1), elements(columns + 1);
  for (int i = 0; i < p.count(); ++i) {
    const Vec2 X{p.x0[0][i], p.x0[1][i]};
    if (X.y < 0 || X.y > h)
      continue;
    const int left = static_cast<int>(X.x / h);
    for (int n : {left, left + 1}) {
      const auto k = static_cast<size_t>(n);
      const double m = p.mass[i] * (1 - std::abs(X.x / h - n)) * (1 - X.y / h);
      mass[k] += m;
      run[k] += m * stress.cauchy(i).xx;
      elements[k] += m * beam.plate.stress(X)[0];
    }
  }
  double squares = 0, peak = 0;
  int count = 0;
  for (int n = 0; n <= columns; ++n) {
    const auto k = static_cast<size_t>(n);
    peak = std::max(peak, std::abs(elements[k] / mass[k]));
    if (std::abs(n - tip_column) <= 1)
      continue;
    squares += std::pow((run[k] - elements[k]) / mass[k], 2);
    ++count;
  }
  const double rms = std::sqrt(squares / count) / peak;
  report("double cantilever beam, rms difference of sxx along the mid-plane from finite elements, over the peak", rms,
         "0.05");
  EXPECT_LT(rms, 0.05);
}

}  // namespace
}  // namespace riven
