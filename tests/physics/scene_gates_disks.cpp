// Disks with cracks: two that collide, five under impact (J.A. Nairn, CMES 4 (2003) 649-664, sections 3.2 and 3.3).
#include <cmath>
#include <map>
#include <optional>

#include "io/crack_opening.hpp"
#include "io/particle_stress.hpp"
#include "kernels/contact_meetings.hpp"
#include "tests/physics/scene_gates.hpp"

namespace riven {
namespace {

using namespace gates;

constexpr double mm = 1e-3, ms = 1e-3;

/// Largest overlap of the faces of any crack, m.
double overlap(const Cracks& cracks) {
  double most = 0;
  for (const CrackOpening& o : crack_openings(cracks))
    most = std::max(most, -o.normal);
  return most;
}

/// For each particle the one that starts at its mirror image about y = 0, by id.
std::vector<int> mirror_ids(const Particles<double, 2>& p, double h) {
  const auto key = [&](int i, double sign) {
    return std::pair{std::lround(8 * p.x[0][i] / h), std::lround(sign * 8 * p.x[1][i] / h)};
  };
  std::map<std::pair<long, long>, int> at;
  for (int i = 0; i < p.count(); ++i)
    at[key(i, 1)] = p.id[i];
  std::vector<int> mirror(static_cast<size_t>(p.count()));
  for (int i = 0; i < p.count(); ++i)
    mirror[static_cast<size_t>(p.id[i])] = at.at(key(i, -1));
  return mirror;
}

/// Largest distance from the mirror image, positions over the cell and velocities over the largest.
double asymmetry(const Particles<double, 2>& p, const std::vector<int>& mirror, double h) {
  const std::vector<int> at = by_id(p);
  double position = 0, velocity = 0, fastest = 0;
  for (size_t id = 0; id < mirror.size(); ++id) {
    const int i = at[id], j = at[static_cast<size_t>(mirror[id])];
    position = std::max({position, std::abs(p.x[0][i] - p.x[0][j]), std::abs(p.x[1][i] + p.x[1][j])});
    velocity = std::max({velocity, std::abs(p.v[0][i] - p.v[0][j]), std::abs(p.v[1][i] + p.v[1][j])});
    fastest = std::max(fastest, std::hypot(p.v[0][i], p.v[1][i]));
  }
  return std::max(position / h, velocity / fastest);
}

/// Largest distance of a crack's point from the nearest particle of the body with the same number.
double distance_from_body(const Simulation& m) {
  const auto& p = m.state.particles;
  const Cracks& c = m.state.cracks;
  double most = 0;
  for (int k = 0; k < c.points(); ++k) {
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < p.count(); ++i)
      if (p.body[i] == c.crack[k])
        nearest = std::min(nearest, norm(c.plane[k] - Vec2{p.x[0][i], p.x[1][i]}));
    most = std::max(most, nearest);
  }
  return most;
}

/// Normal force that contact passes on at each flagged node in the present step, by what it does to the momentum of
/// the face below, where the node holds one crack. Must outlive the simulation's steps.
class NormalForces {
 public:
  explicit NormalForces(Simulation& m) {
    insert_task(m, "contact after", false, [this](Simulation& s) { force_ = momenta(s); });
    insert_task(m, "contact after", true, [this](Simulation& s) {
      const std::vector<double> after = momenta(s);
      for (size_t i = 0; i < after.size(); ++i)
        force_[i] = (after[i] - force_[i]) / s.state.clock.dt;
    });
  }
  double at(long flagged) const { return force_[static_cast<size_t>(flagged)]; }

 private:
  static std::vector<double> momenta(const Simulation& m) {
    const CrackFields& f = m.state.fields;
    const Grid<double>& g = m.state.grid;
    std::vector<double> p(static_cast<size_t>(f.nodes.size()));
    for (long i = 0; i < f.nodes.size(); ++i) {
      const NodeCracks& n = f.nodes[i];
      if (f.held[i] != 1)
        continue;
      const Meeting meeting = neighbour_meeting(n, f.normals[i], m.state.cracks.contact.data(), 0, 0, 1);
      const long slot = meeting.below == 0 ? n.node : long{g.lattice.nodes()} + n.extra;
      if (g.mass[slot] > 0)
        p[static_cast<size_t>(i)] = g.mass[slot] * dot(meeting.normal, Vec2{g.q[4 * slot], g.q[4 * slot + 1]});
    }
    return p;
  }
  std::vector<double> force_;
};

/// A crack's faces in the middle three fifths of it: how far they stand apart, and whether they press on each other.
struct Middle {
  double mean = 0, most = 0;  ///< m, opening of the tracked faces: its mean, and the largest at a point, to either side
  double pressed = 0;         ///< share of its points at whose nearest node contact presses the faces apart
  double force = 0;           ///< N, normal force between the faces of the whole crack
  double stress = 0;          ///< N, the same from the stress of the particles beside the middle
};

/// Normal force that the particles in the first row beside the middle of a crack carry towards it, over its length.
double force_beside(const Simulation& m, int crack) {
  const auto& p = m.state.particles;
  const Cracks& c = m.state.cracks;
  const int first = c.start[static_cast<size_t>(crack)], last = c.start[static_cast<size_t>(crack) + 1] - 1;
  const Vec2 line = c.plane0[last] - c.plane0[first], t = line * (1 / norm(line)), now = c.plane[last] - c.plane[first];
  const Vec2 middle = 0.5 * (c.plane0[first] + c.plane0[last]), n = turned(now) * (1 / norm(now));
  const ParticleStress stress(p, m.scene);
  double sum = 0, count = 0;
  for (int i = 0; i < p.count(); ++i) {
    const Vec2 r = Vec2{p.x0[0][i], p.x0[1][i]} - middle;
    if (std::abs(dot(r, turned(t))) > 0.5 * m.scene.cell || std::abs(dot(r, t)) > 0.3 * norm(line))
      continue;
    const CauchyStress s = stress.cauchy(i);
    sum -= n.x * n.x * s.xx + n.y * n.y * s.yy + 2 * n.x * n.y * s.xy;
    ++count;
  }
  return sum / count * norm(now) * m.scene.thickness;
}

Middle look_at_middle(const Simulation& m, const NormalForces& forces, int crack) {
  const CrackFields& f = m.state.fields;
  const Lattice& l = m.state.grid.lattice;
  const Cracks& c = m.state.cracks;
  const std::vector<CrackOpening> opening = crack_openings(c);
  Middle r;
  r.stress = force_beside(m, crack);
  for (long i = 0; i < f.nodes.size(); ++i)
    if (f.held[i] == 1 && f.nodes[i].crack[0] == crack)
      r.force += forces.at(i);
  const int first = c.start[static_cast<size_t>(crack)], last = c.start[static_cast<size_t>(crack) + 1] - 1;
  const int begin = first + (last - first) / 5, end = last - (last - first) / 5;
  for (int k = begin; k <= end; ++k) {
    const double normal = opening[static_cast<size_t>(k)].normal, part = 1. / (end - begin + 1);
    const Vec2 X = (c.plane[k] - l.origin) * (1 / l.h);
    const int i = f.node_index[static_cast<int>(std::lround(X.y)) * l.nx + static_cast<int>(std::lround(X.x))];
    r.mean += part * normal;
    r.most = std::max(r.most, std::abs(normal));
    r.pressed += i >= 0 && forces.at(i) > 0 ? part : 0;
  }
  return r;
}

struct TwoDisks {
  std::map<int, std::pair<double, double>> opening;  ///< mm, of the left and the right crack, by ms
  std::map<int, Middle> left;                        ///< by ms
  double overlap = 0, outside = 0, asymmetry = 0, momentum = 0, drop = 0, growth = 0;
  long early = 0;
};

TwoDisks run_two_disks(const std::vector<std::string>& settings, bool volumes = false) {
  const exec::Space space;
  Scene scene = shipped("two_disks", settings);
  scene.deterministic = true;
  scene.end_time = 45 * ms;
  Simulation m(scene, space);
  std::optional<NormalForces> forces;
  if (m.plan.contact_position)
    forces.emplace(m);
  if (volumes)
    insert_task(m, "contact before", false, [](Simulation& s) {
      contact_sums<double>(
          s.space, {.volume = true},
          {s.plan.shape, s.state.particles, s.state.domains, s.state.specific_area, s.state.watch.drift}, s.state.grid,
          s.state.fields, s.state.cracks, s.scene.thickness, s.contact_sums);
    });
  const std::vector<int> mirror = mirror_ids(m.state.particles, scene.cell);
  TwoDisks r;
  const double first = m.state.ledger.energy.total();
  std::vector<int> due{20, 32, 45};
  while (!m.finished()) {
    m.step();
    m.take_stock();
    r.overlap = std::max(r.overlap, overlap(m.state.cracks));
    r.drop = std::max(r.drop, 1 - m.state.ledger.energy.total() / first);
    r.growth = std::max(r.growth, m.state.ledger.energy.total() / first - 1);
    if (!due.empty() && m.state.clock.time >= due.front() * ms * (1 - 1e-9)) {
      r.opening[due.front()] = {extreme_opening(m.state.cracks, 0) / mm, extreme_opening(m.state.cracks, 1) / mm};
      if (forces)
        r.left[due.front()] = look_at_middle(m, *forces, 0);
      r.outside = std::max(r.outside, distance_from_body(m));
      due.erase(due.begin());
    }
  }
  r.asymmetry = asymmetry(m.state.particles, mirror, scene.cell);
  r.momentum = m.state.ledger.momentum.error();
  r.early = m.contact_after.early;
  return r;
}

const TwoDisks& two_disks() {
  static const TwoDisks result = run_two_disks({});
  return result;
}

TEST(TwoDisks, CracksOpenAndCloseAsInThePaper) {
  const TwoDisks& r = two_disks();
  const auto [left_20, right_20] = r.opening.at(20);
  const auto [left_32, right_32] = r.opening.at(32);
  report("two disks, left opening at 20 ms, mm", left_20, "> 0");
  report("two disks, right opening at 20 ms, mm", right_20, "|.| < 0.05");
  report("two disks, left opening at 32 ms, mm", left_32, "|.| < 0.2, a tenth of a cell (closed)");
  report("two disks, right opening at 32 ms, mm", right_32, "> 0, slightly");
  report("two disks, left opening at 45 ms, mm", r.opening.at(45).first, "> 0");
  EXPECT_GT(left_20, 0);
  EXPECT_LT(std::abs(right_20), 0.05);
  EXPECT_LT(std::abs(left_32), 0.2);
  EXPECT_GT(right_32, 0);
  EXPECT_LT(right_32, 1);
  EXPECT_GT(r.opening.at(45).first, 0);
}

/// Closed faces press on each other, with the force that the particles beside them carry.
TEST(TwoDisks, LeftCrackPressesAt32) {
  const Middle& shut = two_disks().left.at(32);
  report("two disks, share of the middle of the left crack that presses at 32 ms", shut.pressed, "1");
  report("two disks, normal force on the left crack at 32 ms, N", shut.force, "> 0");
  report("two disks, normal force on the left crack over that beside it", shut.force / shut.stress, "0.5 to 2");
  report("two disks, mean opening of the middle of the left crack at 32 ms, mm", shut.mean / mm, "|.| < 0.05");
  EXPECT_NEAR(shut.pressed, 1, 1e-12);
  EXPECT_GT(shut.force, 0.5 * shut.stress);
  EXPECT_LT(shut.force, 2 * shut.stress);
  EXPECT_GT(shut.stress, 0);
  EXPECT_LT(std::abs(shut.mean), 0.05 * mm);
  for (int open : {20, 45}) {
    EXPECT_EQ(two_disks().left.at(open).pressed, 0) << open;
    EXPECT_EQ(two_disks().left.at(open).force, 0) << open;
  }
}

/// Contact acts at nodes. Between them, points of faces that press on each other stay apart or overlap by up to a tenth
/// of a cell, and by less the finer the grid.
TEST(TwoDisks, PointsOfTheShutCrackMeetOnAFinerGrid) {
  const Middle &coarse = two_disks().left.at(32), fine = run_two_disks({"grid.cell=1 mm"}).left.at(32);
  report("two disks, largest opening in the middle of the left crack at 32 ms, mm", coarse.most / mm, "-");
  report("two disks, the same on a grid twice as fine, over it", fine.most / coarse.most, "0.75");
  EXPECT_NEAR(fine.pressed, 1, 1e-12);
  EXPECT_GT(fine.force, 0.5 * fine.stress);
  EXPECT_LT(fine.most, 0.75 * coarse.most);
}

/// The left crack by the measure of the right one, the largest opening at any point: in cells of 2 mm, that of the
/// points between nodes and next to the tips.
TEST(TwoDisks, DISABLED_LeftCrackIsShutAt32) {
  EXPECT_LT(std::abs(two_disks().opening.at(32).first), 0.05);
}

TEST(TwoDisks, KeepMomentumAndEnergy) {
  const TwoDisks& r = two_disks();
  report("two disks, momentum drift", r.momentum, "1e-12");
  report("two disks, crack points to the nearest particle of their disk, cells", r.outside / (2 * mm), "1");
  report("two disks, energy drop", r.drop, "0.15");
  report("two disks, energy growth", r.growth, "0.01");
  EXPECT_LT(r.momentum, 1e-12);
  EXPECT_LT(r.outside, 2 * mm);
  EXPECT_LT(r.drop, 0.15);
  EXPECT_LT(r.growth, 0.01);
}

TEST(TwoDisks, KeepSymmetryAboutTheLineOfImpact) {
  report("two disks, asymmetry about the line of impact", two_disks().asymmetry, "1e-9");
  EXPECT_LT(two_disks().asymmetry, 1e-9);
}

/// The overlap of the tracked surfaces, which takes in what tracking them adds.
TEST(TwoDisks, FacesOverlapByLessThanATenthOfACell) {
  report("two disks, overlap of faces, cells", two_disks().overlap / (2 * mm), "0.1");
  EXPECT_LT(two_disks().overlap, 0.1 * 2 * mm);
}

TEST(TwoDisks, FacesOverlapWithoutContact) {
  const TwoDisks r = run_two_disks({"contact.law=ignored"});
  report("two disks without contact, overlap of faces, cells (must fail)", r.overlap / (2 * mm), "> 0.5");
  EXPECT_GT(r.overlap, 0.5 * 2 * mm);
}

TEST(TwoDisks, VelocitiesAloneSeeContactAcrossAGap) {
  const TwoDisks r = run_two_disks({"contact.detection=velocity"}, true);
  report("two disks by velocity alone, contacts with a relative volume below 0.9", static_cast<double>(r.early), "> 0");
  EXPECT_GT(r.early, 0);
}

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
  ParticleStress stress;
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
  const exec::Space space;
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
  const exec::Space space(exec::Kind::serial, 1);
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
