// When contact acts: its sums against brute force, gaps of bodies that turn and part, and every way of detection.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "kernels/contact_meetings.hpp"
#include "tests/kernels/contact_setting.hpp"

namespace riven {
namespace {

using namespace contact_setting;

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

}  // namespace
}  // namespace riven
