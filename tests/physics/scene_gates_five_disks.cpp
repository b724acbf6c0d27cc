// Five disks in a row under impact, the middle one cracked (J.A. Nairn, CMES 4 (2003) 649-664, section 3.3).
#include <cmath>
#include <limits>
#include <map>

#include "io/particle_stress.hpp"
#include "tests/physics/scene_gates.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace gates;

constexpr double mm = 1e-3;

constexpr double diameter = 25.4 * mm;

/// Particle stresses of one state: largest |sxx| in a disk, its standard deviation, and fringe orders.
struct Look {
  explicit Look(const Simulation& m) : p(m.state.particles), stress(p, m.scene), k(m.scene.output.fringe_constant) {}

  double largest_sxx(int body) const {
    double most = 0;
    for (int i = 0; i < p.count(); ++i)
      if (body < 0 || p.body[i] == body)
        most = std::max(most, std::abs(stress.cauchy(i).xx));
    return most;
  }
  double spread_sxx(int body) const {
    double n = 0, sum = 0, squares = 0;
    for (int i = 0; i < p.count(); ++i)
      if (p.body[i] == body) {
        const double s = stress.cauchy(i).xx;
        ++n;
        sum += s;
        squares += s * s;
      }
    return std::sqrt(std::max(0.0, squares / n - sum * sum / (n * n)));
  }
  /// Fringes within `reach` of a point: the largest order less the least.
  double fringes(Vec2 at, double reach) const {
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (int i = 0; i < p.count(); ++i) {
      if (norm(Vec2{p.x[0][i], p.x[1][i]} - at) > reach)
        continue;
      const CauchyStress s = stress.cauchy(i);
      const double order = k * std::hypot(s.xx - s.yy, 2 * s.xy) / (2 * M_PI);
      least = std::min(least, order);
      most = std::max(most, order);
    }
    return most - least;
  }
  const Particles<double, 2>& p;
  ParticleStress<double> stress;
  double k;
};

/// Fringes about both tips of the crack, and about two sets of places in disk 2.
struct TipFringes {
  double tip[2]{};
  double image[2]{};  ///< the tips' mirror images across the plane in which disks 2 and 3 touch
  double own[2]{};    ///< the tips' own places in disk 2, one diameter back

  TipFringes() = default;
  TipFringes(const Look& look, const Cracks& crack, double reach) {
    const Vec2 ends[2] = {crack.plane[0], crack.plane[crack.points() - 1]};
    for (int e = 0; e < 2; ++e) {
      tip[e] = look.fringes(ends[e], reach);
      image[e] = look.fringes({4 * diameter - ends[e].x, ends[e].y}, reach);
      own[e] = look.fringes(ends[e] - Vec2{diameter, 0}, reach);
    }
  }
  void add(const TipFringes& other) {
    for (int e = 0; e < 2; ++e) {
      tip[e] += other.tip[e];
      image[e] += other.image[e];
      own[e] += other.own[e];
    }
  }
};

/// A fifth of the crack's half length: so far from a tip its singular term, K / sqrt(2 pi r), still is 0.87 of the
/// whole stress x / sqrt(x^2 - a^2) ahead of a crack.
constexpr double near_tip = diameter / 20;

struct FiveDisks {
  double arrival = 0, noise = 0;  ///< t c / D of the front in disk 5; standard deviation of sxx there before, over peak
  TipFringes now, sum;            ///< when the front arrives; over all looks at t c / D of 4 to 7
  long touching_steps = 0;
  double overlap = 0;
};

FiveDisks run_five_disks(const std::vector<std::string>& settings) {
  const test::ChosenSpace space;
  Scene scene = shipped("five_disks", settings);
  scene.deterministic = true;
  const double c = std::sqrt(scene.materials[0].E / scene.materials[0].density), unit = diameter / c;
  Simulation m(scene, space);
  FiveDisks r;
  double peak = 0;
  long touching = 0;
  while (!m.finished()) {
    m.step();
    r.overlap = std::max(r.overlap, overlap(m.state.cracks));
    r.touching_steps += m.contact_after.touching > touching;
    touching = m.contact_after.touching;
    const double t = m.state.clock.time / unit;
    if (m.state.clock.step % 4 != 0 || t > 7)
      continue;
    const Look look(m);
    if (t >= 4)
      r.sum.add(TipFringes(look, m.state.cracks, near_tip));
    if (r.arrival > 0)
      continue;
    peak = std::max(peak, look.largest_sxx(-1));
    if (t < 3.5)
      r.noise = look.spread_sxx(4) / peak;
    if (look.largest_sxx(4) < 0.05 * peak)
      continue;
    r.arrival = t;
    r.now = TipFringes(look, m.state.cracks, near_tip);
  }
  return r;
}

const FiveDisks& five_disks() {
  static const FiveDisks result = run_five_disks({});
  return result;
}

TEST(FiveDisks, FrontArrivesWithoutNoiseAhead) {
  const FiveDisks& r = five_disks();
  report("five disks, t c / D when the front reaches disk 5", r.arrival, "4 to 7");
  report("five disks, spread of sxx in disk 5 before, over the peak", r.noise, "1e-3");
  EXPECT_GT(r.arrival, 4);
  EXPECT_LT(r.arrival, 7);
  EXPECT_LT(r.noise, 1e-3);
}

TEST(FiveDisks, TipsGatherFringesAndDifferFromEachOther) {
  const FiveDisks &r = five_disks(), whole = run_five_disks({"contact.law=bonded"});
  for (int e = 0; e < 2; ++e) {
    report(fmt::format("five disks, fringes at the {} tip over those without a crack", e == 0 ? "left" : "right"),
           r.now.tip[e] / whole.now.tip[e], "2");
    EXPECT_GE(r.now.tip[e], 2 * whole.now.tip[e]) << e;
  }
  report("five disks, difference of the tips' fringes", std::abs(r.now.tip[0] / r.now.tip[1] - 1), "> 0.01");
  EXPECT_GT(std::abs(r.now.tip[0] / r.now.tip[1] - 1), 0.01);
}

class FiveDisksOfCells : public ::testing::TestWithParam<int> {};

/// "The stress concentrations at the crack tip are evident by the increased number of fringes": each tip gathers twice
/// those of its mirror image in disk 2 when the front reaches disk 5, and, as the waves pass tip and image at different
/// moments, also on the mean over t c / D = 4 to 7, then against its own place in disk 2 too. Counted in orders, for no
/// place holds more than two dark bands.
///
/// It is a gate on the tips' own field. The crack lies along the load, so that K_I is some 1 to 2 MPa sqrt(m): 0.1 to
/// 0.2 fringes at D / 10, and none straight ahead, where sxx = syy in mode I, beside 1 to 2 fringes of the waves. The
/// wider the count, the more of the waves it takes in at both places. Ratios at the left / right tip:
///
///                   within near_tip = D / 20                           within D / 10
///   cells   image       own place    image, mean   own, mean    image       image, mean   own, mean
///    30     3.1 / 6.2   12.6 / 1.5   3.0 / 3.1     3.0 / 3.0    1.7 / 2.7   1.7 / 1.8     1.7 / 1.8
///    60     2.3 / 3.0    4.4 / 1.5   2.6 / 2.5     2.6 / 2.5    1.3 / 1.6   1.5 / 1.4     1.5 / 1.4
///   120     2.8 / 2.6    2.5 / 2.9   2.8 / 2.3     2.9 / 2.3    1.6 / 1.4   1.5 / 1.2     1.5 / 1.2
///   240     3.6 / 4.6    6.6 / 2.6   3.7 / 2.7     4.0 / 2.6    1.7 / 2.1   1.7 / 1.2     1.8 / 1.2
///
/// One moment depends on when the front is said to be there (right tip, 120 cells: 1.6 at t c / D = 4.9, 2.6 at 5.3);
/// the mean does not.
TEST_P(FiveDisksOfCells, TipsGatherTwiceTheFringesOfDiskTwo) {
  const int cells = GetParam();
  const FiveDisks r =
      run_five_disks({fmt::format("grid.cell=\"{:.15g} mm\"", diameter / mm / cells), "solver.time=\"18.54 us\""});
  report(fmt::format("five disks of {} cells, t c / D when the front reaches disk 5", cells), r.arrival, "4 to 7");
  EXPECT_GT(r.arrival, 4);
  EXPECT_LT(r.arrival, 7);
  for (int e = 0; e < 2; ++e) {
    const auto gate = [&](const std::string& what, double tip, double place) {
      report(fmt::format("five disks of {} cells, fringes at the {} tip over those {}", cells,
                         e == 0 ? "left" : "right", what),
             tip / place, "2");
      EXPECT_GE(tip, 2 * place) << what << ", " << e;
    };
    report(fmt::format("five disks of {} cells, fringes at the {} tip over those at its own place in disk 2", cells,
                       e == 0 ? "left" : "right"),
           r.now.tip[e] / r.now.own[e], "-");
    gate("at its image in disk 2", r.now.tip[e], r.now.image[e]);
    gate("at its image in disk 2, mean", r.sum.tip[e], r.sum.image[e]);
    gate("at its own place in disk 2, mean", r.sum.tip[e], r.sum.own[e]);
  }
}

INSTANTIATE_TEST_SUITE_P(Cells, FiveDisksOfCells, ::testing::Values(30, 60));
/// The last rows of the table, a matter of minutes and of half an hour.
INSTANTIATE_TEST_SUITE_P(DISABLED_Cells, FiveDisksOfCells, ::testing::Values(120, 240));

TEST(FiveDisks, FacesMeet) {
  report("five disks, steps with contact on the crack", static_cast<double>(five_disks().touching_steps), "> 0");
  EXPECT_GT(five_disks().touching_steps, 0);
}

/// The upper half of the disks alone, the mid-plane fixed but for the crack, until the impactor has come to rest.
struct HalfModel {
  double stopped = 0;              ///< t c / D
  double lowest = 0, highest = 0;  ///< m, of the crack's face
  double across = 0;               ///< m, largest displacement of any particle of the cracked disk across the row
};

HalfModel run_upper_halves() {
  const test::ChosenSpace space;
  Scene scene = shipped("five_disks");
  const Material& disk = scene.materials[0];
  const double unit = diameter / std::sqrt(disk.E / disk.density);
  scene.end_time = 100 * unit;
  const Rectangle crack{scene.cracks[0].points.front(), scene.cracks[0].points.back()};
  scene.cracks.clear();
  scene.probes.clear();
  for (Body& b : scene.bodies)
    b.holes.push_back(Rectangle{scene.grid.lower, {scene.grid.upper.x, 0}});
  const Rectangle sides[2] = {{{scene.grid.lower.x, 0}, crack.lower}, {crack.upper, {scene.grid.upper.x, 0}}};
  for (const Rectangle& side : sides) {
    FixedNodes middle;
    middle.name = "middle";
    middle.box = side;
    middle.velocity[1] = TimeFunction{};
    scene.fixed.push_back(middle);
  }
  Simulation m(scene, space);
  const Lattice& l = m.state.grid.lattice;
  std::map<int, double> height;  // of each node of the face
  for (int n = 0; n < l.nodes(); ++n)
    if (const Vec2 x = l.position(n); std::abs(x.y) < 1e-6 * scene.cell && x.x > crack.lower.x && x.x < crack.upper.x)
      height[n] = 0;
  const auto& p = m.state.particles;
  std::vector<double> start(static_cast<size_t>(p.count()));
  for (int i = 0; i < p.count(); ++i)
    start[static_cast<size_t>(p.id[i])] = p.x[1][i];
  HalfModel r;
  double push = 1;  // momentum of the impactor
  while (!m.finished() && push > 0) {
    m.step();
    for (auto& [n, y] : height) {
      y += m.state.clock.dt * m.state.grid.q[4L * n + 1];
      r.lowest = std::min(r.lowest, y);
      r.highest = std::max(r.highest, y);
    }
    push = 0;
    for (int i = 0; i < p.count(); ++i)
      if (p.body[i] == 2)
        r.across = std::max(r.across, std::abs(p.x[1][i] - start[static_cast<size_t>(p.id[i])]));
      else if (p.body[i] == 5)
        push += p.mass[i] * p.v[0][i];
  }
  r.stopped = m.state.clock.time / unit;
  return r;
}

/// "An analysis of half the specimen develops nonphysical crack surface displacements as the crack surface
/// displacements extend past the mid-plane": the half model shows it, and the whole one without contact shows the same
/// twice. A gate of 0.05 cells (42e-6 m) for it is out of reach of this impact, whatever is counted and however long:
/// by 2 s a / E the face would need s = 580 MPa across the row, where 6 m/s start a wave of rho c V = 109 MPa along
/// it. The test therefore holds that nothing in the cracked disk, face or not, moves so far across the row before the
/// impactor has spent its momentum.
TEST(FiveDisks, HalfModelPassesTheMidPlane) {
  const HalfModel half = run_upper_halves();
  const double whole = run_five_disks({"contact.law=ignored"}).overlap, h = diameter / 30;
  report("five disks, half model, face beyond the mid-plane, m", -half.lowest, "> 0");
  report("five disks, half model, face beyond the mid-plane, cells", -half.lowest / h, "-");
  report("five disks, half model, t c / D when the impactor stops", half.stopped, "> 7");
  report("five disks, half model, largest opening of the face until then, cells", half.highest / h, "< 0.05");
  report("five disks, half model, largest displacement across the row until then, cells", half.across / h, "< 0.05");
  report("five disks without contact, half the overlap over the half model's", 0.5 * whole / -half.lowest,
         "0.7 to 1.3");
  report("five disks, overlap with contact over that without", five_disks().overlap / whole, "< 0.5");
  EXPECT_LT(half.lowest, -1e-9);
  EXPECT_GT(half.stopped, 7);
  EXPECT_LT(half.stopped, 100);
  EXPECT_LT(std::max(-half.lowest, half.highest), 0.05 * h);
  EXPECT_LT(half.across, 0.05 * h);
  EXPECT_NEAR(0.5 * whole, -half.lowest, 0.3 * -half.lowest);
  EXPECT_LT(five_disks().overlap, 0.5 * whole);
}

}  // namespace
}  // namespace riven
