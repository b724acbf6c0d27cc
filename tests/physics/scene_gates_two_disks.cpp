// Two colliding disks with cracks (J.A. Nairn, CMES 4 (2003) 649-664, section 3.2).
#include <cmath>
#include <map>
#include <optional>

#include "io/crack_opening.hpp"
#include "io/particle_stress.hpp"
#include "kernels/contact_meetings.hpp"
#include "tests/physics/scene_gates.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace gates;

constexpr double mm = 1e-3, ms = 1e-3;

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
      const Meeting meeting =
          meeting_across(n, {f.normals.data() + i, nullptr}, m.state.cracks.contact.data(), 0, 0, 1, 1);
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
  const int first = c.start[crack], last = c.start[crack + 1] - 1;
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
  const int first = c.start[crack], last = c.start[crack + 1] - 1;
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
  const test::ChosenSpace space;
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
      r.opening[due.front()] = {extreme_opening(m.scene, m.state.cracks, 0) / mm,
                                extreme_opening(m.scene, m.state.cracks, 1) / mm};
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

}  // namespace
}  // namespace riven
