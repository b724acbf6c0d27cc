// All contacts of a node together: conservation, energy, and the closed forms of four fields.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "core/laws/contact_sweep.hpp"

namespace riven {
namespace {

constexpr double dt = 1e-3;

Vec2 unit(double angle) {
  return {std::cos(angle), std::sin(angle)};
}
Vec2 rotated(Vec2 v, double a) {
  return {std::cos(a) * v.x - std::sin(a) * v.y, std::sin(a) * v.x + std::cos(a) * v.y};
}

Vec2 total(const ContactNode& n) {
  Vec2 p;
  for (int f = 0; f < 4; ++f)
    if (n.mass[f] > 0)
      p += n.momentum[f];
  return p;
}
double scale(const ContactNode& n) {
  double s = 0;
  for (int f = 0; f < 4; ++f)
    if (n.mass[f] > 0)
      s += norm(n.momentum[f]);
  return s;
}
double energy(const ContactNode& n) {
  double e = 0;
  for (int f = 0; f < 4; ++f)
    if (n.mass[f] > 0)
      e += dot(n.momentum[f], n.momentum[f]) / (2 * n.mass[f]);
  return e;
}
double energy(const ContactNode& n, const ContactOutcome& out) {
  double e = 0;
  for (int f = 0; f < 4; ++f)
    if (n.mass[f] > 0)
      e += 0.5 * n.mass[f] * dot(out.velocity[f], out.velocity[f]);
  return e;
}

/// The four pairs of two crossing cracks; which field of a pair is above differs from crack to crack.
struct Crossing {
  ContactSettings law[2];
  Vec2 normal[2];
  bool bit_above[2];
  double gap[4];
  double phase2[2];
  Vec2 start[4];    ///< velocity before the forces (interface)
  Vec2 opening[2];  ///< interface

  void pairs(ContactNode& node, const int (&order)[4]) const {
    const int f[4] = {0, 2, 0, 1}, k[4] = {0, 0, 1, 1};
    const auto each = [&](auto&& act) {
      for (int o : order) {
        const int g = f[o] + (1 << k[o]);
        if (node.mass[f[o]] > 0 && node.mass[g] > 0)
          act(o, k[o], bit_above[k[o]] ? g : f[o], bit_above[k[o]] ? f[o] : g);
      }
    };
    each([&](int, int c, int a, int b) {
      if (law[c].law == ContactLaw::bonded)
        node.bond(a, b);
    });
    each([&](int o, int c, int a, int b) {
      if (node.together(a, b) || law[c].law == ContactLaw::ignored)
        return;
      if (law[c].law == ContactLaw::interface) {
        const Vec2 u = start[a] - start[b], t = turned(normal[c]);
        node.add({a, b, normal[c], interface_response(phase2[0], dot(u, normal[c]), dot(opening[c], normal[c]), dt),
                  interface_response(phase2[1], dot(u, t), dot(opening[c], t), dt)});
      } else if (law[c].law == ContactLaw::stick) {
        if (gap[o] <= 0)
          node.add(StickingPair{a, b, normal[c]});
      } else {
        node.add(touching_pair(law[c], a, b, normal[c], gap[o], dt, false));
      }
    });
  }
};

struct Case {
  ContactNode node;
  Crossing crossing;
};

constexpr ContactLaw all_laws[] = {ContactLaw::ignored,      ContactLaw::bonded,  ContactLaw::stick,
                                   ContactLaw::frictionless, ContactLaw::coulomb, ContactLaw::interface};

/// Lets friction bear less one way than the other.
void bear_less_back(ContactNode& n) {
  for (int k = 0; k < n.pairs; ++k)
    n.pair[k].friction.back *= 0.25;
}

Case random_case(std::mt19937& rng, ContactLaw first, ContactLaw second, double least_mass = 0.05) {
  std::uniform_real_distribution<double> any(-1, 1), share(0, 1);
  Case c;
  for (int f = 0; f < 4; ++f) {
    c.node.mass[f] = share(rng) < 0.15 ? 0 : std::pow(least_mass, share(rng));
    c.crossing.start[f] = {any(rng), any(rng)};
    c.node.momentum[f] = c.node.mass[f] * (Vec2{any(rng), any(rng)} + c.crossing.start[f]);
    c.crossing.gap[f] = 1e-3 * any(rng);
  }
  const double angle = std::numbers::pi * any(rng);
  c.crossing.law[0] = {first, 0.5 * share(rng), 0, 0};
  c.crossing.law[1] = {second, 0.5 * share(rng), 0, 0};
  c.crossing.normal[0] = unit(angle);
  c.crossing.normal[1] = unit(angle + 0.5 + 2 * share(rng));
  for (int k = 0; k < 2; ++k) {
    c.crossing.bit_above[k] = share(rng) < 0.5;
    c.crossing.phase2[k] = std::pow(10., 6 * any(rng));
    c.crossing.opening[k] = 1e-4 * Vec2{any(rng), any(rng)};
  }
  return c;
}

constexpr int in_order[4] = {0, 1, 2, 3};

TEST(ContactNode, KeepsMomentumForAllMixesOfLaws) {
  std::mt19937 rng(1);
  double worst = 0;
  for (ContactLaw a : all_laws)
    for (ContactLaw b : all_laws)
      for (int i = 0; i < 500; ++i) {
        Case c = random_case(rng, a, b);
        c.crossing.pairs(c.node, in_order);
        const ContactOutcome out = solve(c.node);
        Vec2 p, given;
        for (int f = 0; f < 4; ++f) {
          p += c.node.mass[f] * out.velocity[f];
          given += out.impulse[f];
        }
        const double s = std::max(scale(c.node), std::abs(out.lambda[0]));
        worst = std::max({worst, norm(p - total(c.node)) / s, norm(given) / s});
      }
  EXPECT_LT(worst, 1e-15);
}

TEST(ContactNode, ConvergesNeverPullsAndNeverMakesEnergy) {
  std::mt19937 rng(2);
  int most = 0, capped = 0, count = 0;
  for (ContactLaw a : all_laws)
    for (ContactLaw b : all_laws) {
      if (a == ContactLaw::interface || b == ContactLaw::interface)
        continue;
      for (int i = 0; i < 2000; ++i, ++count) {
        Case c = random_case(rng, a, b, 1e-9);
        c.crossing.pairs(c.node, in_order);
        if (i % 2 == 1)
          bear_less_back(c.node);
        const ContactOutcome out = solve(c.node);
        capped += !out.converged;
        most = std::max(most, out.sweeps);
        ASSERT_LE(energy(c.node, out), energy(c.node) * (1 + 1e-14));
        for (int k = 0; k < c.node.pairs; ++k) {
          ASSERT_GE(out.lambda[k], -1e-14 * scale(c.node));
          const auto [back, forward] = c.node.pair[k].friction;
          ASSERT_LE(out.tau[k], forward * out.lambda[k] + 1e-14 * scale(c.node));
          ASSERT_GE(out.tau[k], -back * out.lambda[k] - 1e-14 * scale(c.node));
        }
      }
    }
  RecordProperty("most_sweeps", most);
  // masses differ by up to 1e9; a few such nodes in 100,000 are left to the next step
  EXPECT_LE(capped, count / 20000) << "of " << count << " nodes, most sweeps " << most;
}

/// At the end of a solution every pair obeys its own law: no approach beyond the gap, no force while apart, no sliding
/// below the limit of friction, and friction against sliding.
TEST(ContactNode, LeavesEveryPairWithItsLawFulfilled) {
  std::mt19937 rng(3);
  for (ContactLaw a : {ContactLaw::frictionless, ContactLaw::coulomb})
    for (ContactLaw b : {ContactLaw::frictionless, ContactLaw::coulomb, ContactLaw::bonded})
      for (int i = 0; i < 3000; ++i) {
        Case c = random_case(rng, a, b);
        c.crossing.pairs(c.node, in_order);
        if (i % 2 == 1)
          bear_less_back(c.node);
        const ContactOutcome out = solve(c.node);
        const double tiny = 1e-11;
        for (int k = 0; k < c.node.pairs; ++k) {
          const ContactPair& p = c.node.pair[k];
          const Vec2 u = out.velocity[p.above] - out.velocity[p.below];
          const double spare = p.across.bias - dot(u, p.normal), slip = dot(u, turned(p.normal));
          ASSERT_GT(spare, -tiny);
          if (out.lambda[k] > tiny) {
            ASSERT_NEAR(spare, 0, tiny);
          }
          const double most = out.tau[k] > 0 ? p.friction.forward : p.friction.back;
          if (std::abs(out.tau[k]) < most * out.lambda[k] - tiny) {
            ASSERT_NEAR(slip, 0, tiny);
          }
          if (std::abs(slip) > tiny) {
            ASSERT_GE(slip * out.tau[k], 0);
          }
        }
      }
}

TEST(ContactNode, BondedOnBothCracksIsOneVelocity) {
  std::mt19937 rng(4);
  for (int i = 0; i < 100; ++i) {
    Case c = random_case(rng, ContactLaw::bonded, ContactLaw::bonded);
    for (double& m : c.node.mass)
      m = std::max(m, 1e-3);
    c.crossing.pairs(c.node, in_order);
    const ContactOutcome out = solve(c.node);
    for (int f = 1; f < 4; ++f)
      EXPECT_TRUE(out.velocity[f] == out.velocity[0]);
    const double m = c.node.mass[0] + c.node.mass[1] + c.node.mass[2] + c.node.mass[3];
    EXPECT_NEAR(norm(m * out.velocity[0] - total(c.node)), 0, 1e-15 * scale(c.node) * 4);
  }
}

/// Four quarters pushed at each other across two perpendicular cracks: across each crack the normal velocities of
/// opposite quarters become equal, while they slide freely along it.
TEST(ContactNode, FourSqueezedFieldsCarryLoadAcrossBothCracksAndSlideFreely) {
  Crossing cross{};
  cross.law[0] = cross.law[1] = {ContactLaw::frictionless};
  cross.normal[0] = {0, -1};  // fields with bit 0 are above: upper half
  cross.normal[1] = {1, 0};   // fields with bit 1 are above: left half
  cross.bit_above[0] = cross.bit_above[1] = true;
  ContactNode node;
  const double m[4] = {1, 2, 3, 4};
  const Vec2 v[4] = {{-1, 2}, {-2, -3}, {3, 1}, {1, -4}};  // lower right, upper right, lower left, upper left
  for (int f = 0; f < 4; ++f) {
    node.mass[f] = m[f];
    node.momentum[f] = m[f] * v[f];
  }
  cross.pairs(node, in_order);
  ASSERT_EQ(node.pairs, 4);
  const ContactOutcome out = solve(node);
  const double right = (1 * 2 + 2 * -3) / 3., left = (3 * 1 + 4 * -4) / 7.;  // common y velocities
  const double low = (1 * -1 + 3 * 3) / 4., high = (2 * -2 + 4 * 1) / 6.;    // common x velocities
  const Vec2 expected[4] = {{low, right}, {high, right}, {low, left}, {high, left}};
  for (int f = 0; f < 4; ++f)
    EXPECT_NEAR(norm(out.velocity[f] - expected[f]), 0, 1e-15);
  for (int k = 0; k < 4; ++k)
    EXPECT_GT(out.lambda[k], 0);
}

/// A field of 1e-9 of the mass between two heavy ones passes their push on; sweeps alone would need 1e9 of them.
TEST(ContactNode, ALightFieldPassesOnThePushOfHeavyOnes) {
  ContactNode node;
  node.mass[0] = 1;
  node.mass[1] = 1e-9;
  node.mass[3] = 3;
  node.momentum[0] = {4, 0};  // the heavy fields run into each other along x with the light one between
  const Vec2 n{1, 0};
  node.add(touching_pair({ContactLaw::frictionless}, 0, 1, n, 0, dt, false));
  node.add(touching_pair({ContactLaw::frictionless}, 1, 3, n, 0, dt, false));
  const ContactOutcome out = solve(node);
  EXPECT_TRUE(out.converged);
  EXPECT_LT(out.sweeps, 20);
  for (int f : {0, 1, 3})
    EXPECT_NEAR(node.mass[f] * (out.velocity[f].x - 4 / (4 + 1e-9)), 0, 1e-14);
}

TEST(ContactNode, DoesNotDependOnTheOrderOfPairs) {
  std::mt19937 rng(5);
  double worst = 0;
  for (ContactLaw a : all_laws)
    for (ContactLaw b : all_laws)
      for (int i = 0; i < 200; ++i) {
        const Case c = random_case(rng, a, b);
        Case first = c;
        first.crossing.pairs(first.node, in_order);
        const ContactOutcome one = solve(first.node);
        for (int trial = 0; trial < 4; ++trial) {
          int order[4] = {0, 1, 2, 3};
          std::shuffle(std::begin(order), std::end(order), rng);
          Case again = c;
          again.crossing.pairs(again.node, order);
          const ContactOutcome other = solve(again.node);
          for (int f = 0; f < 4; ++f)
            worst = std::max(worst, c.node.mass[f] * norm(one.velocity[f] - other.velocity[f]) / scale(c.node));
        }
      }
  EXPECT_LT(worst, 1e-13);
}

TEST(ContactNode, TurnsWithTheFrame) {
  std::mt19937 rng(6);
  const double angle = 37 * std::numbers::pi / 180;
  const Vec2 drift{0.3, -0.2};
  double worst = 0;
  for (ContactLaw a : all_laws)
    for (ContactLaw b : all_laws)
      for (int i = 0; i < 200; ++i) {
        const Case c = random_case(rng, a, b);
        Case plain = c, turned_case = c;
        plain.crossing.pairs(plain.node, in_order);
        for (int f = 0; f < 4; ++f) {
          const Vec2 moved = c.node.momentum[f] + c.node.mass[f] * drift;
          turned_case.node.momentum[f] = rotated(moved, angle);
          turned_case.crossing.start[f] = rotated(c.crossing.start[f] + drift, angle);
        }
        for (int k = 0; k < 2; ++k) {
          turned_case.crossing.normal[k] = rotated(c.crossing.normal[k], angle);
          turned_case.crossing.opening[k] = rotated(c.crossing.opening[k], angle);
        }
        turned_case.crossing.pairs(turned_case.node, in_order);
        const ContactOutcome one = solve(plain.node), other = solve(turned_case.node);
        for (int f = 0; f < 4; ++f) {
          if (!(c.node.mass[f] > 0))
            continue;
          const Vec2 back = rotated(other.velocity[f], -angle) - drift;
          worst = std::max(worst, c.node.mass[f] * norm(one.velocity[f] - back) / scale(c.node));
        }
      }
  EXPECT_LT(worst, 1e-13);
}

TEST(ContactNode, FieldsWithoutMassAreAbsent) {
  ContactNode node;
  node.mass[0] = 1;
  node.momentum[0] = {1, 2};
  node.momentum[1] = {std::nan(""), 0};
  const ContactOutcome out = solve(node);
  EXPECT_TRUE(out.velocity[0] == (Vec2{1, 2}));
  EXPECT_FALSE(out.changed[0]);
  EXPECT_FALSE(out.changed[1]);
}

}  // namespace
}  // namespace riven
