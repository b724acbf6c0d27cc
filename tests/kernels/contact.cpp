// The contact kernels on small scenes: sums against brute force, gaps of bodies that turn and part, every stage and
// detection, and the same bits in every execution space.
#include "kernels/contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>
#include <random>

#include "core/error.hpp"
#include "core/scene/names.hpp"
#include "kernels/contact_meetings.hpp"
#include "tests/kernels/crack_scene.hpp"

namespace riven {
namespace {

using namespace crack_scene;
using Line = std::vector<Vec2>;

constexpr double dt = 1e-2;

struct Setting {
  Lattice lattice = unit_cells(24, 24);
  Cracks cracks;
  CrackFields fields;
  Particles<double, 2> particles;
  exec::Array<DomainSetting<double, 2>> domains;
  exec::Array<double> specific_area;
  Grid<double> grid;
  ContactSums sums;
  FieldImpulses impulses;
  double drift = 0;  ///< of the particles since they were sorted

  ContactParticles<double> all(ShapeFunction shape = ShapeFunction::ugimp) const {
    return {shape, particles, domains, specific_area, drift};
  }
};

/// Where a particle of first position X is now.
using Map = std::function<Vec2(Vec2)>;

/// A body over [4, 20]^2 of a grid of unit cells, four particles of mass 0.5 and first area 0.25 in each, with cracks,
/// particles and crack points moved by `map` from where they are first.
template <class Shape = UGimp>
Setting make_setting(const std::vector<Line>& lines, const Map& map, const Map& map_crack, ContactLaw law) {
  Setting s;
  s.cracks = cracks_of(lines, 0.5);
  for (int p = 0; p < s.cracks.points(); ++p)
    s.cracks.plane[p] = s.cracks.upper[p] = s.cracks.lower[p] = map_crack(s.cracks.plane0[p]);
  for (ContactSettings& c : s.cracks.contact)
    c.law = law;
  std::vector<Vec2> X, x;
  for (int j = 0; j < 32; ++j)
    for (int i = 0; i < 32; ++i) {
      X.push_back({4.25 + 0.5 * i, 4.25 + 0.5 * j});
      x.push_back(map(X.back()));
    }
  Particles<double, 2>& p = s.particles;
  p = sorted_particles<Shape>(s.lattice, x, in_order(x.size()));
  p.mass.resize(p.count());
  p.J.resize(p.count());
  for (auto& a : p.x0)
    a.resize(p.count());
  for (int i = 0; i < p.count(); ++i) {
    p.mass[i] = 0.5;
    p.J[i] = 1;
    p.x0[0][i] = X[static_cast<size_t>(p.id[i])].x;
    p.x0[1][i] = X[static_cast<size_t>(p.id[i])].y;
  }
  s.domains.resize(1);
  s.domains[0] = quarter_cells(s.lattice);
  s.specific_area.resize(1);
  s.specific_area[0] = 0.5;
  const exec::Space serial;
  hash_cracks<Shape>(serial, s.lattice, s.cracks, s.fields);
  determine_fields<Shape>(serial, p, s.domains.data(), s.lattice, s.cracks, s.fields);
  s.grid.lattice = s.lattice;
  s.grid.mass.resize(s.lattice.nodes() + s.fields.extra_slots);
  clear_impulses(s.fields, s.impulses);
  return s;
}

Vec2 stay(Vec2 X) {
  return X;
}

long slot_of(const Setting& s, const NodeCracks& n, int field) {
  return field == 0 ? n.node : long{s.lattice.nodes()} + s.fields.extra[n.node] + field - 1;
}

/// The impulse on a field that a stage noted.
Vec2 noted(Setting& s, const NodeCracks& n, long slot, ContactStage stage) {
  const ImpulseNotes notes(s.impulses, s.lattice);
  const long i = s.fields.node_index[n.node];
  const int k = static_cast<int>(stage);
  return notes.acted[i] & 1 << k ? notes.at(i, slot)[k] : Vec2{};
}

/// f(flagged node, field, particle, weight) for all pairs of particles and nodes that hold cracks.
template <class Shape, class F>
void each_pair(const Setting& s, const F& f) {
  const Particles<double, 2>& p = s.particles;
  for (int i = 0; i < p.count(); ++i) {
    const auto a = Shape::axis(p.x[0][i] - s.lattice.origin.x, s.domains[0].axis[0]);
    const auto b = Shape::axis(p.x[1][i] - s.lattice.origin.y, s.domains[0].axis[1]);
    for (int k = 0; k < neighbours<Shape, 2>; ++k) {
      const int index = s.fields.node_index[(b.base + k / Shape::width) * s.lattice.nx + a.base + k % Shape::width];
      if (index >= 0 && s.fields.nodes[index].crack[0] >= 0)
        f(index, CrackFields::field_of(s.fields.fields[i], k), i, a.s[k % Shape::width] * b.s[k / Shape::width]);
    }
  }
}

/// Masses of the slots of nodes that hold cracks.
template <class Shape = UGimp>
void set_masses(Setting& s) {
  s.grid.mass.zero();
  each_pair<Shape>(s, [&](int index, int field, int i, double S) {
    s.grid.mass[slot_of(s, s.fields.nodes[index], field)] += s.particles.mass[i] * S;
  });
}

template <class Shape = UGimp>
void sum(Setting& s, const exec::Space& space, ShapeFunction shape = ShapeFunction::ugimp, double thickness = 2) {
  set_masses<Shape>(s);
  contact_sums(space, {true, true, true}, s.all(shape), s.grid, s.fields, s.cracks, thickness, s.sums);
  const NodeSums<double> sums = node_sums(s.all(shape), s.lattice, s.fields, s.sums);
  for (long i = 0; i < s.fields.nodes.size(); ++i)
    sums.ask(i, s.fields.nodes[i]);
}

const Line level{{1, 12.3}, {23, 12.3}};
const Line upright{{11.8, 1}, {11.8, 23}};
const Line slanting{{2.1, 10.2}, {9.7, 11.6}, {22.3, 14.9}};

/// Particles have drifted since they were sorted by at most `drift` along each axis.
template <class Shape>
void check_sums(ShapeFunction shape, double drift) {
  Setting s = make_setting<Shape>({slanting, upright}, stay, stay, ContactLaw::frictionless);
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> any(-0.3, 0.3), move(-drift, drift);
  s.drift = drift;
  for (int i = 0; i < s.particles.count(); ++i) {
    s.particles.J[i] = 1 + any(rng);
    s.particles.x[0][i] += move(rng);
    s.particles.x[1][i] += move(rng);
  }
  determine_fields<Shape>(exec::Space(), s.particles, s.domains.data(), s.lattice, s.cracks, s.fields);
  sum<Shape>(s, exec::Space(), shape);
  const size_t slots = static_cast<size_t>(s.grid.slots());
  std::vector<double> volume(slots);
  std::vector<Vec2> place(slots), first(slots);
  const Particles<double, 2>& p = s.particles;
  each_pair<Shape>(s, [&](int index, int field, int i, double S) {
    const NodeCracks& n = s.fields.nodes[index];
    const size_t slot = static_cast<size_t>(slot_of(s, n, field));
    volume[slot] += 0.25 * p.J[i] * S;
    place[slot] += 0.5 * S * (Vec2{p.x[0][i], p.x[1][i]} - s.lattice.position(n.node));
    first[slot] += 0.5 * S * (Vec2{p.x0[0][i], p.x0[1][i]} - s.lattice.position(n.node));
  });
  double total = 0;
  for (const NodeCracks& n : s.fields.nodes)
    for (int f = 0; n.crack[0] >= 0 && f < n.fields(); ++f) {
      const long slot = slot_of(s, n, f);
      const double* sums = &s.sums.place[4 * slot];
      EXPECT_NEAR(s.sums.volume[slot], volume[static_cast<size_t>(slot)], 1e-14);
      EXPECT_NEAR(norm(Vec2{sums[0], sums[1]} - place[static_cast<size_t>(slot)]), 0, 1e-14);
      EXPECT_NEAR(norm(Vec2{sums[2], sums[3]} - first[static_cast<size_t>(slot)]), 0, 1e-14);
      total += s.sums.volume[slot];
    }
  EXPECT_GT(total, 5);
}

TEST(ContactSums, EqualBruteForce) {
  for (double drift : {0., 0.2, 0.9}) {
    check_sums<Linear>(ShapeFunction::linear, drift);
    check_sums<UGimp>(ShapeFunction::ugimp, drift);
    check_sums<BSpline>(ShapeFunction::bspline, drift);
  }
}

TEST(ContactSums, AreasOfNodesAddUpToTheCracksAndCarryItsOpening) {
  // an interior stretch of the crack: nodes well inside of the body see the whole of it
  Setting s = make_setting({level}, stay, stay, ContactLaw::interface);
  const Vec2 opening{0.01, -0.03};
  s.cracks.jump.resize(s.cracks.points());
  for (Vec2& j : s.cracks.jump)
    j = {-opening.y, opening.x};  // the normal is (0, -1), the segment along (1, 0)
  sum(s, exec::Space());
  for (int i = 8; i <= 16; ++i) {
    double column = 0;  // a column of nodes owns the crack over one cell
    for (long k = 0; k < s.fields.nodes.size(); ++k)
      if (s.lattice.position(s.fields.nodes[k].node).x == i) {
        const ContactArea& a = s.sums.area[2 * k];
        column += a.area;
        if (a.area > 0) {
          EXPECT_NEAR(norm(a.opening - opening), 0, 1e-14);
        }
      }
    EXPECT_NEAR(column, 2, 0.05) << i;  // thickness 2; midpoints of segments of 0.489 cells
  }
}

Vec2 turn(Vec2 x, double a) {
  return {std::cos(a) * x.x - std::sin(a) * x.y, std::sin(a) * x.x + std::cos(a) * x.y};
}

/// Largest and least gap over all nodes with both fields of crack 0.
std::pair<double, double> gaps(Setting& s, double least_mass = 0) {
  sum(s, exec::Space());
  double low = 1e9, high = -1e9;
  for (long i = 0; i < s.fields.nodes.size(); ++i) {
    const NodeCracks& n = s.fields.nodes[i];
    if (n.crack[0] < 0)
      continue;
    double mass[4] = {};
    long slot[4] = {};
    for (int f = 0; f < n.fields(); ++f) {
      slot[f] = slot_of(s, n, f);
      mass[f] = s.grid.mass[slot[f]];
    }
    if (mass[0] <= least_mass || mass[1] <= least_mass)
      continue;
    const Meetings<2> m = find_meetings<2>(n, {s.fields.normals.data() + i, nullptr}, mass, s.cracks.contact.data());
    const double g = gap_of(m.list[0], s.sums.place.data(), slot, mass);
    low = std::min(low, g);
    high = std::max(high, g);
  }
  return {low, high};
}

TEST(ContactDetection, NoRigidMotionOpensOrClosesAGap) {
  for (double angle : {0., 0.01, 0.5, 2.0, std::numbers::pi}) {
    const Map rigid = [=](Vec2 X) { return turn(X - Vec2{12, 12}, angle) + Vec2{12.13, 11.91}; };
    Setting s = make_setting({slanting}, rigid, rigid, ContactLaw::frictionless);
    const auto [low, high] = gaps(s);
    EXPECT_NEAR(low, 0, 2e-12) << angle;
    EXPECT_NEAR(high, 0, 2e-12) << angle;
  }
}

TEST(ContactDetection, TheGapIsTheJumpOfDisplacementAcrossTheCrack) {
  for (double jump : {-0.02, 0.02, 0.1}) {
    for (double slip : {0., 0.15}) {
      const Map open = [=](Vec2 X) { return X.y > 12.3 ? X + Vec2{slip, jump} : X; };
      const Map plane = [=](Vec2 X) { return X + Vec2{0.5 * slip, 0.5 * jump}; };
      Setting s = make_setting({level}, open, plane, ContactLaw::frictionless);
      const auto [low, high] = gaps(s);
      EXPECT_NEAR(low, jump, 1e-13);
      EXPECT_NEAR(high, jump, 1e-13);
    }
  }
}

TEST(ContactDetection, CompressionClosesTheGapAndPenetratesLittle) {
  const Map squeeze = [](Vec2 X) { return Vec2{X.x, 12.3 + (X.y - 12.3) * (1 - 1e-3)}; };
  Setting s = make_setting({level}, squeeze, squeeze, ContactLaw::frictionless);
  const auto [low, high] = gaps(s);
  EXPECT_LT(high, 0);
  EXPECT_GT(low, -2e-3);  // of a cell
}

// ---- the stages ---------------------------------------------------------------------------------------------

/// Momenta of the after-contact state, whatever a stage keeps.
void random_motion(Setting& s, unsigned seed) {
  std::mt19937 rng(seed);
  std::uniform_real_distribution<double> any(-1, 1);
  const long slots = s.grid.mass.size();
  s.grid.q.resize(4 * slots);
  s.grid.again.resize(4 * slots);
  s.grid.high.resize(4 * slots);
  for (double& q : s.grid.q)
    q = any(rng);
  for (double& q : s.grid.again)
    q = any(rng);
  for (double& q : s.grid.high)
    q = any(rng);
}

struct StageData {
  ContactStage stage;
  bool momentum;
  exec::Array<double> Grid<double>::*data;
};
const StageData stages[] = {{ContactStage::before, true, &Grid<double>::q},
                            {ContactStage::after, false, &Grid<double>::q},
                            {ContactStage::again, true, &Grid<double>::again},
                            {ContactStage::higher, false, &Grid<double>::high}};

Setting crossing_setting(ContactLaw a, ContactLaw b) {
  Setting s = make_setting({slanting, upright}, stay, stay, a);
  s.cracks.contact[0] = {a, 0.3, 50, 20};
  s.cracks.contact[1] = {b, 0.2, 1e9, 5};
  sum(s, exec::Space());
  set_masses(s);
  return s;
}

/// Three cracks through one place.
Setting triple_setting(ContactLaw a, ContactLaw b, ContactLaw c) {
  Setting s = make_setting({slanting, upright, {{4.3, 4.2}, {19.3, 19.8}}}, stay, stay, a);
  s.cracks.contact[0] = {a, 0.3, 50, 20};
  s.cracks.contact[1] = {b, 0.2, 1e9, 5};
  s.cracks.contact[2] = {c, 0.1, 30, 1e9};
  sum(s, exec::Space());
  set_masses(s);
  return s;
}

/// Those that hold three cracks, with mass in six fields or more: lines through one point part a plane into six.
int nodes_of_eight_fields(const Setting& s) {
  int count = 0;
  for (const NodeCracks& n : s.fields.nodes) {
    int filled = 0;
    for (int f = 0; n.crack[2] >= 0 && f < n.fields(); ++f)
      filled += s.grid.mass[slot_of(s, n, f)] > 0;
    count += filled > 4;
  }
  return count;
}

/// Two cracks that cross, or three.
void check_momentum(bool third) {
  for (ContactLaw law :
       {ContactLaw::bonded, ContactLaw::stick, ContactLaw::frictionless, ContactLaw::coulomb, ContactLaw::interface})
    for (const StageData& st : stages) {
      Setting s =
          third ? triple_setting(law, ContactLaw::frictionless, law) : crossing_setting(law, ContactLaw::frictionless);
      if (third) {
        EXPECT_GT(nodes_of_eight_fields(s), 0);
      }
      random_motion(s, 3);
      const Grid<double> before = s.grid;
      ContactReport report;
      contact(exec::Space(), s.grid, s.fields, s.cracks, {}, st.stage, dt, s.all(), s.sums, s.impulses, report);
      EXPECT_EQ(report.capped, 0);
      EXPECT_GT(report.touching, 5) << name_of(law);
      double change = 0, work = 0;
      for (const NodeCracks& n : s.fields.nodes) {
        if (n.crack[0] < 0)
          continue;
        Vec2 sum_before, sum_after;
        double scale = 0;
        for (int f = 0; f < n.fields(); ++f) {
          const long slot = f == 0 ? n.node : long{s.lattice.nodes()} + s.fields.extra[n.node] + f - 1;
          const double m = s.grid.mass[slot];
          if (m == 0)
            continue;
          const double *was = &(before.*st.data)[4 * slot], *is = &(s.grid.*st.data)[4 * slot];
          const double factor = st.momentum ? 1 : m;
          const Vec2 p0 = factor * Vec2{was[0], was[1]}, p1 = factor * Vec2{is[0], is[1]};
          sum_before += p0;
          sum_after += p1;
          scale += norm(p0);
          change += norm(p1 - p0);
          const double a = st.stage == ContactStage::after ? dt : 0;  // back to before the forces
          const Vec2 first = p0 * (1 / m) - a * Vec2{was[2], was[3]};
          work += 0.5 * dot(p1 - p0, first + p1 * (1 / m));
          EXPECT_LT(norm(noted(s, n, slot, st.stage) - (p1 - p0)), 1e-12 * norm(p0) + 1e-15);
          if (st.stage == ContactStage::after) {
            EXPECT_NEAR(was[2] + (is[0] - was[0]) / dt, is[2], 1e-12 * std::abs(is[2]) + 1e-12);
            EXPECT_NEAR(was[3] + (is[1] - was[1]) / dt, is[3], 1e-12 * std::abs(is[3]) + 1e-12);
          } else {
            EXPECT_EQ(was[2], is[2]);
            EXPECT_EQ(was[3], is[3]);
          }
        }
        EXPECT_NEAR(norm(sum_after - sum_before), 0, 2e-15 * scale);
      }
      EXPECT_GT(change, 0.1);
      if (law != ContactLaw::interface && st.stage != ContactStage::after) {
        EXPECT_LT(work, 0);
      }
    }
}

TEST(ContactKernel, KeepsTheMomentumOfEveryNodeInEveryStage) {
  check_momentum(false);
}
TEST(ContactKernel, KeepsTheMomentumOfNodesWithEightFields) {
  check_momentum(true);
}

TEST(ContactKernel, IsTheSameToTheBitInEverySpaceAndOnAnyNumberOfThreads) {
  std::vector<double> first;
  using exec::Kind;
  for (const auto& [kind, threads] : {std::pair{Kind::serial, 1},
                                      {Kind::openmp, 1},
                                      {Kind::openmp, 2},
                                      {Kind::openmp, 4},
                                      {Kind::stdpar, 1},
                                      {Kind::stdpar, 2},
                                      {Kind::stdpar, 4}}) {
    const exec::Space space(kind, threads);
    Setting s = triple_setting(ContactLaw::coulomb, ContactLaw::interface, ContactLaw::interface);
    s.sums = {};
    sum(s, space);
    clear_impulses(s.fields, s.impulses);
    random_motion(s, 5);
    ContactReport report;
    contact(space, s.grid, s.fields, s.cracks, {}, ContactStage::before, dt, s.all(), s.sums, s.impulses, report);
    contact(space, s.grid, s.fields, s.cracks, {}, ContactStage::after, dt, s.all(), s.sums, s.impulses, report);
    std::vector<double> all(s.grid.q.begin(), s.grid.q.end());
    for (const NodeCracks& n : s.fields.nodes)
      for (int f = 0; n.crack[0] >= 0 && f < n.fields(); ++f) {
        const long slot = slot_of(s, n, f);
        const double* place = &s.sums.place[4 * slot];
        all.insert(all.end(), {s.sums.volume[slot], place[0], place[1], place[2], place[3]});
        for (const ContactStage stage : {ContactStage::before, ContactStage::after}) {
          const Vec2 impulse = noted(s, n, slot, stage);
          all.insert(all.end(), {impulse.x, impulse.y});
        }
      }
    for (const ContactArea& a : s.sums.area)
      all.insert(all.end(), {a.area, a.opening.x, a.opening.y});
    all.insert(all.end(), {report.penetration, report.gap});
    if (first.empty())
      first = all;
    ASSERT_EQ(first.size(), all.size());
    EXPECT_EQ(std::memcmp(first.data(), all.data(), all.size() * sizeof(double)), 0)
        << exec::name(kind) << " " << threads;
  }
}

/// Upper half moves down at `speed` in m/s, lower half rests.
void approach(Setting& s, double speed = 1) {
  s.grid.q.resize(4 * s.grid.mass.size());
  s.grid.q.zero();
  for (long i = 0; i < s.fields.nodes.size(); ++i) {
    const NodeCracks& n = s.fields.nodes[i];
    if (n.crack[0] < 0)
      continue;
    const bool crossing_above = n.side[0] == Side::above;
    const long slot = crossing_above ? s.lattice.nodes() + s.fields.extra[n.node] : n.node;
    s.grid.q[4 * slot + 1] = -speed;
  }
}

ContactReport touch(double jump, ContactDetection by, ContactLaw law = ContactLaw::frictionless, double J = 1,
                    double speed = 1) {
  const Map open = [=](Vec2 X) { return X.y > 12.3 ? X + Vec2{0, jump} : X; };
  const Map plane = [=](Vec2 X) { return X + Vec2{0, 0.5 * jump}; };
  Setting s = make_setting({level}, open, plane, law);
  for (double& a : s.particles.J)
    a = J;
  sum(s, exec::Space());
  set_masses(s);
  approach(s, speed);
  ContactReport report;
  ContactRules rules;
  rules.detection = by;
  contact(exec::Space(), s.grid, s.fields, s.cracks, rules, ContactStage::after, dt, s.all(), s.sums, s.impulses,
          report);
  return report;
}

TEST(ContactKernel, DisplacementDetectionWaitsUntilTheGapCloses) {
  for (ContactLaw law : {ContactLaw::frictionless, ContactLaw::coulomb, ContactLaw::stick}) {
    const ContactReport open = touch(0.2, ContactDetection::displacement, law);  // 0.01 m of approach in this step
    EXPECT_EQ(open.touching, 0);
    EXPECT_GT(open.apart, 0);
    const ContactReport closed = touch(-1e-3, ContactDetection::displacement, law);
    EXPECT_EQ(closed.apart, 0);
    EXPECT_GT(closed.touching, 0);
    EXPECT_NEAR(closed.penetration, 1e-3, 1e-12);
  }
  // however fast the faces approach, none touches across more than 0.2 cells
  EXPECT_GT(touch(0.19, ContactDetection::displacement, ContactLaw::frictionless, 1, 1e3).touching, 0);
  EXPECT_EQ(touch(0.21, ContactDetection::displacement, ContactLaw::frictionless, 1, 1e3).touching, 0);
  const ContactReport closing = touch(0.009, ContactDetection::displacement);
  EXPECT_GT(closing.touching, 0);
  EXPECT_NEAR(closing.gap, 0.009, 1e-12);
}

TEST(ContactKernel, VelocityDetectionTouchesEarlyAndIsCounted) {
  // one cell apart: nodes between the halves see a volume well below that of their cells
  const ContactReport velocity = touch(1, ContactDetection::velocity);
  EXPECT_GT(velocity.touching, 0);
  EXPECT_GT(velocity.early, 0);
  EXPECT_EQ(touch(1, ContactDetection::displacement).touching, 0);
}

TEST(ContactKernel, VolumeDetectionFollowsItsThreeRanges) {
  EXPECT_EQ(touch(0, ContactDetection::volume, ContactLaw::frictionless, 0.85).touching, 0);
  EXPECT_EQ(touch(0, ContactDetection::volume, ContactLaw::frictionless, 0.85).early, 0);
  EXPECT_GT(touch(0, ContactDetection::volume, ContactLaw::frictionless, 1).touching, 0);
  EXPECT_GT(touch(0, ContactDetection::volume, ContactLaw::frictionless, 1.2).touching, 0);
  // parting faces: free in the gray range, held above it
  for (double J : {1., 1.2}) {
    Setting s = make_setting({level}, stay, stay, ContactLaw::frictionless);
    for (double& a : s.particles.J)
      a = J;
    sum(s, exec::Space());
    set_masses(s);
    approach(s);
    for (double& q : s.grid.q)
      q = -q;
    ContactReport report;
    ContactRules rules;
    rules.detection = ContactDetection::volume;
    contact(exec::Space(), s.grid, s.fields, s.cracks, rules, ContactStage::before, dt, s.all(), s.sums, s.impulses,
            report);
    EXPECT_EQ(report.touching > 0, J > 1.1);
  }
}

TEST(ContactKernel, BondedCracksMakeOneFieldOfAll) {
  Setting s = crossing_setting(ContactLaw::bonded, ContactLaw::bonded);
  random_motion(s, 7);
  s.sums = {};  // bonded faces need no detection
  ContactReport report;
  contact(exec::Space(), s.grid, s.fields, s.cracks, {}, ContactStage::after, dt, s.all(), s.sums, s.impulses, report);
  int full = 0;
  for (const NodeCracks& n : s.fields.nodes) {
    if (n.crack[0] < 0)
      continue;
    const double* q = &s.grid.q[4 * n.node];
    for (int f = 1; f < n.fields(); ++f) {
      const long slot = long{s.lattice.nodes()} + s.fields.extra[n.node] + f - 1;
      if (s.grid.mass[slot] == 0 || s.grid.mass[n.node] == 0)
        continue;
      EXPECT_EQ(s.grid.q[4 * slot], q[0]);
      EXPECT_EQ(s.grid.q[4 * slot + 1], q[1]);
      full += f == 3;
    }
  }
  EXPECT_GT(full, 0);
}

TEST(ContactKernel, RefusesToGuessWithoutItsSums) {
  Setting s = crossing_setting(ContactLaw::frictionless, ContactLaw::bonded);
  random_motion(s, 7);
  s.sums = {};
  ContactReport report;
  EXPECT_THROW(contact(exec::Space(), s.grid, s.fields, s.cracks, {}, ContactStage::after, dt, s.all(), s.sums,
                       s.impulses, report),
               Error);
}

// ---- fields that meet diagonally ----------------------------------------------------------------------------

TEST(ContactMeetings, DiagonalFieldsMeetAlongTheSumOfBothNormals) {
  NodeCracks n;
  n.node = 0;
  n.crack[0] = 0;
  n.crack[1] = 1;
  const NodeNormals normals{{{0, -1}, {1, 0}}, {{0, -1}, {1, 0}}};
  const ContactSettings laws[2] = {{ContactLaw::frictionless}, {ContactLaw::coulomb, 0.3}};
  // where the particles of a field lie, from its bits and the sides: above crack 0 is up, above crack 1 is left
  for (Side a : {Side::above, Side::below})
    for (Side b : {Side::above, Side::below})
      for (const auto& [f, g] : {std::pair{0, 3}, {1, 2}}) {
        n.side[0] = a;
        n.side[1] = b;
        const auto place = [&](int field) {
          const bool up = ((field & 1) != 0) == (a == Side::above), left = ((field & 2) != 0) == (b == Side::above);
          return Vec2{left ? -1. : 1., up ? 1. : -1.};
        };
        double mass[4] = {};
        mass[f] = 2;
        mass[g] = 3;
        const Meetings<2> m = find_meetings<2>(n, {&normals, nullptr}, mass, laws);
        ASSERT_EQ(m.count, 1);
        const Meeting& d = m.list[0];
        EXPECT_NEAR(norm(d.normal), 1, 1e-15);
        // the normal leads from the one field's place to the other's
        EXPECT_NEAR(dot(d.normal, place(d.below) - place(d.above)), norm(place(d.below) - place(d.above)), 1e-15 * 4);
        EXPECT_EQ(d.law.law, ContactLaw::coulomb);
        mass[f ^ 1] = 1;  // a field between them: two meetings of neighbours, none across
        EXPECT_EQ(find_meetings<2>(n, {&normals, nullptr}, mass, laws).count, 2);
      }
}

TEST(ContactMeetings, FieldsMeetDiagonallyAcrossThreeCracksWithNoneBetween) {
  NodeCracks n;
  n.node = 0;
  n.third = 0;
  for (int k = 0; k < 3; ++k) {
    n.crack[k] = k;
    n.side[k] = Side::above;
  }
  const double c = std::sqrt(0.75);
  const Vec2 normal[3] = {{0, -1}, {c, -0.5}, {c, 0.5}};
  const NodeNormals two{{normal[0], normal[1]}, {normal[0], normal[1]}};
  const ThirdNormal third{normal[2], normal[2]};
  const ContactSettings laws[3] = {{ContactLaw::frictionless}, {ContactLaw::bonded}, {ContactLaw::coulomb, 0.3}};
  const auto meetings = [&](unsigned present) {
    double mass[8] = {};
    for (int f = 0; f < 8; ++f)
      mass[f] = present >> f & 1u;
    return find_meetings<3>(n, {&two, &third}, mass, laws);
  };
  for (unsigned present = 0; present < 256; ++present) {
    const Meetings<3> m = meetings(present);
    ASSERT_LE(m.count, ContactNodeOf<3>::most_pairs);
    bool linked[8] = {};
    double share[3] = {};
    for (const Meeting& one : m) {
      linked[one.above] = linked[one.below] = true;
      share[one.k] += one.share;
      EXPECT_NEAR(norm(one.normal), 1, 1e-15);
    }
    for (int f = 0; f < 8; ++f)
      EXPECT_EQ(linked[f], (present >> f & 1u) != 0 && present != 1u << f) << present;  // none is left without
    for (const double part : share)
      EXPECT_TRUE(part == 0 || std::abs(part - 1) < 1e-15) << present;
  }
  // fields 0 and 7 alone: across all three, whose normals are turned to lead from 0, which lies below all, to 7
  const Meetings<3> opposite = meetings(1u << 0 | 1u << 7);
  ASSERT_EQ(opposite.count, 1);
  const Vec2 sum = -(normal[0] + normal[1] + normal[2]);
  const Meeting& d = opposite.list[0];
  EXPECT_EQ(d.above, 0);
  EXPECT_NEAR(norm(d.normal - sum * (1 / norm(sum))), 0, 1e-15);
  EXPECT_EQ(d.k, 1);
  EXPECT_EQ(d.law.law, ContactLaw::bonded);
  // 3 has 1 and 2 beside it and nothing else
  EXPECT_EQ(meetings(1u << 1 | 1u << 2 | 1u << 3).count, 2);
  // all
  EXPECT_EQ(meetings(255).count, 12);
}

}  // namespace
}  // namespace riven
