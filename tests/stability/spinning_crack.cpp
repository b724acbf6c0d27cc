// A crack in a disk that spins: the grid's directions must not show, and surfaces stay with the particles beside them.
#include <cmath>
#include <numbers>
#include <thread>

#include "io/crack_opening.hpp"
#include "tests/spaces.hpp"
#include "tests/stability/gates.hpp"

namespace riven {
namespace {

using namespace gates;
using namespace hard_cases;

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

Means spin(const Scene& scene) {
  const test::ChosenSpace space;
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
  std::vector<Scene> scenes;
  for (const double degrees : {0, 45, 60})
    scenes.push_back(shipped("spinning_crack", {crack_setting(4, 16, degrees)}));
  Means runs[3], mean;
  {
    std::vector<std::jthread> others;
    for (size_t i : {1, 2})
      others.emplace_back([&, i] { runs[i] = spin(scenes[i]); });
    runs[0] = spin(scenes[0]);
  }
  for (const Means& r : runs) {
    mean.opening += r.opening / 3;
    mean.kinetic += r.kinetic / 3;
    mean.strain += r.strain / 3;
  }
  double opening = 0, kinetic = 0, strain = 0;
  for (const Means& r : runs) {
    opening = std::max(opening, std::abs(r.opening / mean.opening - 1));
    kinetic = std::max(kinetic, std::abs(r.kinetic / mean.kinetic - 1));
    strain = std::max(strain, std::abs(r.strain / mean.strain - 1));
  }
  const std::string row = "cracked disk spins at 0.05 c/D, crack at 0, 45 and 60 degrees";
  below(row + ": opening against the mean", opening, 0.02);
  below(row + ": kinetic energy against the mean", kinetic, 0.02);
  below(row + ": strain energy against the mean", strain, 0.02);
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
  const test::ChosenSpace space;
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
  below("bonded crack in a spinning disk, one turn: opening and sliding, cells", opening / h, 0.02);
  below("bonded crack in a spinning disk, one turn: points off its line, cells", astray / h, 0.02);
  below("bonded crack in a spinning disk, one turn: mouth off its line, cells", mouth / h, 0.2);
}

}  // namespace
}  // namespace riven
