// A crack in a disk that spins: the grid's directions must not show, and surfaces stay with the particles beside them.
#include <cmath>
#include <numbers>

#include "io/crack_opening.hpp"
#include "tests/physics/scene_gates.hpp"

namespace riven {
namespace {

using namespace gates;

constexpr double mm = 1e-3;
constexpr Vec2 center{20 * mm, 20 * mm};

/// Puts the crack of the scene in a direction.
std::string crack_setting(double from, double to, double degrees) {
  const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
  return fmt::format(R"(crack.crack.points=[["{:.9f} mm", "{:.9f} mm"], ["{:.9f} mm", "{:.9f} mm"]])", 20 + from * c,
                     20 + from * s, 20 + to * c, 20 + to * s);
}

/// Means over the run: the disk breathes.
struct Means {
  double opening = 0, kinetic = 0, strain = 0;
};

Means spin(double degrees) {
  const exec::Space space;
  Scene scene = shipped("spinning_crack", {crack_setting(4, 16, degrees)});
  scene.deterministic = true;
  Simulation m(scene, space);
  Means mean;
  int samples = 0;
  while (!m.finished()) {
    m.step();
    if (m.state.clock.step % 8 != 0)
      continue;
    m.take_stock();
    const std::vector<CrackOpening> all = crack_openings(m.state.cracks);
    for (const CrackOpening& o : all)
      mean.opening += o.normal / static_cast<double>(all.size());
    mean.kinetic += m.state.ledger.energy.kinetic;
    mean.strain += m.state.ledger.energy.strain;
    ++samples;
  }
  for (double* x : {&mean.opening, &mean.kinetic, &mean.strain})
    *x /= samples;
  return mean;
}

TEST(SpinningCrack, OpensAlikeInRotatedFrames) {
  const double degrees[] = {0, 45, 60};
  Means runs[3], mean;
  for (int i = 0; i < 3; ++i) {
    runs[i] = spin(degrees[i]);
    mean.opening += runs[i].opening / 3;
    mean.kinetic += runs[i].kinetic / 3;
    mean.strain += runs[i].strain / 3;
  }
  for (int i = 0; i < 3; ++i) {
    const auto differs = [&](const char* what, double value, double from) {
      report(fmt::format("spinning crack at {} degrees, {} against the mean of three directions", degrees[i], what),
             value / from - 1, "|.| < 0.02");
      EXPECT_LT(std::abs(value / from - 1), 0.02) << degrees[i];
    };
    differs("opening", runs[i].opening, mean.opening);
    differs("kinetic energy", runs[i].kinetic, mean.kinetic);
    differs("strain energy", runs[i].strain, mean.strain);
  }
}

/// Root mean square distance of the particles from the center.
double spread(const Particles<double, 2>& p) {
  double sum = 0;
  for (int i = 0; i < p.count(); ++i)
    sum += std::pow(p.x[0][i] - center.x, 2) + std::pow(p.x[1][i] - center.y, 2);
  return std::sqrt(sum / p.count());
}

/// An edge crack, bonded, so that the body does not know of it; its mouth is 1.5 cells outside of the disk.
TEST(SpinningCrack, TurnsWithItsBody) {
  const double h = 2 * mm, omega = 10.2;
  const exec::Space space;
  Scene scene = shipped("spinning_crack", {R"(grid.cell="2 mm")", R"(contact.law="bonded")", crack_setting(4, 23, 0)});
  scene.deterministic = true;
  scene.end_time = 2 * std::numbers::pi / omega;
  Simulation m(scene, space);
  const double first = spread(m.state.particles);
  double opening = 0, astray = 0, mouth = 0;
  while (!m.finished()) {
    m.step();
    if (m.state.clock.step % 50 != 0)
      continue;
    const Cracks& c = m.state.cracks;
    const std::vector<CrackOpening> openings = crack_openings(c);
    const double growth = spread(m.state.particles) / first;
    const Vec2 along = (c.plane[0] - center) * (1 / norm(c.plane[0] - center));
    for (int k = 0; k < c.points(); ++k) {
      const double r = norm(c.plane0[k] - center), off = norm(c.plane[k] - center - (growth * r) * along);
      (r < 19 * mm ? astray : mouth) = std::max(r < 19 * mm ? astray : mouth, off);
      if (r < 19 * mm)
        opening = std::max(opening, norm(openings[static_cast<size_t>(k)].vector));
    }
  }
  report("spinning crack, bonded, opening and sliding in a turn, cells", opening / h, "0.02");
  report("spinning crack, bonded, points off its line in a turn, cells", astray / h, "0.02");
  report("spinning crack, bonded, mouth off its line in a turn, cells", mouth / h, "0.2");
  EXPECT_LT(opening, 0.02 * h);
  EXPECT_LT(astray, 0.02 * h);
  EXPECT_LT(mouth, 0.2 * h);
}

}  // namespace
}  // namespace riven
