// The contact kernel in every stage: momenta, the same bits in every execution space, and what it refuses.
#include "kernels/contact.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "core/error.hpp"
#include "core/scene/names.hpp"
#include "tests/kernels/contact_setting.hpp"

namespace riven {
namespace {

using namespace contact_setting;

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

}  // namespace
}  // namespace riven
