// One pair of fields against closed forms: J.A. Nairn, CMES 4 (2003), eqs. 13-18, and the oscillator of two masses.
#include <gtest/gtest.h>

#include <cmath>

#include "core/laws/contact_sweep.hpp"

namespace riven {
namespace {

constexpr double dt = 1e-3;

/// Masses 2 (above) and 6 (below), so that the relative motion has mass 1.5. n = (0, -1): the crack lies along x.
ContactNode two_fields(Vec2 above, Vec2 below) {
  ContactNode node;
  node.mass[1] = 2;
  node.mass[0] = 6;
  node.momentum[1] = 2 * above;
  node.momentum[0] = 6 * below;
  return node;
}
const Vec2 down{0, -1};

ContactOutcome touch(Vec2 above, Vec2 below, ContactSettings law, double gap = -1e-6, bool held = false) {
  ContactNode node = two_fields(above, below);
  if (law.law == ContactLaw::stick)
    node.add(StickingPair{1, 0, down});
  else
    node.add(touching_pair(law, 1, 0, down, gap, dt, held));
  return solve(node);
}

TEST(ContactLaws, FrictionlessEqualisesNormalVelocitiesOnly) {
  const ContactOutcome out = touch({3, -4}, {1, 0}, {ContactLaw::frictionless});
  EXPECT_DOUBLE_EQ(out.velocity[1].y, -1);  // common normal velocity (2 (-4) + 6 0) / 8
  EXPECT_DOUBLE_EQ(out.velocity[0].y, -1);
  EXPECT_EQ(out.velocity[1].x, 3);
  EXPECT_EQ(out.velocity[0].x, 1);
  EXPECT_DOUBLE_EQ(out.lambda[0], 1.5 * 4);
}

TEST(ContactLaws, PartingFacesFeelNothing) {
  for (ContactLaw law : {ContactLaw::frictionless, ContactLaw::coulomb, ContactLaw::stick}) {
    const ContactOutcome out = touch({3, 4}, {1, 0}, {law, 0.5});
    EXPECT_FALSE(out.changed[0] || out.changed[1]);
    EXPECT_EQ(out.lambda[0], 0);
    EXPECT_EQ(out.tau[0], 0);
  }
}

TEST(ContactLaws, StickMovesBothWithTheirCentreOfMass) {
  const ContactOutcome out = touch({3, -4}, {1, 0}, {ContactLaw::stick});
  for (int f : {0, 1}) {
    EXPECT_DOUBLE_EQ(out.velocity[f].x, 1.5);
    EXPECT_DOUBLE_EQ(out.velocity[f].y, -1);
  }
}

TEST(ContactLaws, CoulombSticksBelowItsLimitAndSlidesAboveIt) {
  // m u_n = 6, m u_t = 3: sticks for mu >= 1/2
  for (double sign : {-1., 1.}) {
    const ContactOutcome stick = touch({1 + 2 * sign, -4}, {1, 0}, {ContactLaw::coulomb, 0.6});
    EXPECT_NEAR(stick.velocity[1].x, stick.velocity[0].x, 1e-15);
    const ContactOutcome slide = touch({1 + 2 * sign, -4}, {1, 0}, {ContactLaw::coulomb, 0.2});
    EXPECT_DOUBLE_EQ(std::abs(slide.tau[0]), 0.2 * slide.lambda[0]);
    // friction 1.2 slows the upper field (mass 2) by 0.6 and drags the lower one (mass 6) along by 0.2
    EXPECT_DOUBLE_EQ(slide.velocity[1].x, 1 + 2 * sign - 0.6 * sign);
    EXPECT_DOUBLE_EQ(slide.velocity[0].x, 1 + 0.2 * sign);
  }
}

TEST(ContactLaws, BondedHasTheCommonVelocityInTensionToo) {
  ContactNode node = two_fields({3, 4}, {1, 0});
  node.bond(0, 1);
  const ContactOutcome out = solve(node);
  for (int f : {0, 1})
    EXPECT_TRUE((out.velocity[f] == Vec2{1.5, 1}));
}

TEST(ContactLaws, AGapIsClosedInOneStepAndNotOverrun) {
  const double gap = 1e-3;  // the fields approach at 4 m/s: 4e-3 m in this step
  const ContactOutcome out = touch({0, -4}, {0, 0}, {ContactLaw::frictionless}, gap);
  EXPECT_NEAR(gap + dt * (out.velocity[1].y - out.velocity[0].y), 0, 1e-18);
  const ContactOutcome open = touch({0, -4}, {0, 0}, {ContactLaw::frictionless}, 4.1e-3);
  EXPECT_EQ(open.lambda[0], 0);
}

TEST(ContactLaws, FacesHeldByVolumeMayPull) {
  const ContactOutcome out = touch({0, 4}, {0, 0}, {ContactLaw::frictionless}, 0, true);
  EXPECT_DOUBLE_EQ(out.velocity[1].y, 1);
  EXPECT_DOUBLE_EQ(out.velocity[0].y, 1);
}

TEST(ContactLaws, StricterLawsAreOrdered) {
  using L = ContactLaw;
  const L order[] = {L::ignored, L::interface, L::frictionless, L::coulomb, L::stick, L::bonded};
  for (int i = 0; i < 5; ++i) {
    EXPECT_TRUE(stricter({order[i + 1]}, {order[i]}));
    EXPECT_FALSE(stricter({order[i]}, {order[i + 1]}));
  }
  EXPECT_TRUE(stricter({L::coulomb, 0.4}, {L::coulomb, 0.3}));
  EXPECT_TRUE(stricter({L::interface, 0, 2, 1}, {L::interface, 0, 1, 1}));
}

// ---- interface ----------------------------------------------------------------------------------------------

/// Velocity of approach after one step of a free pair (mass 1.5) that closes at u0 and is open by delta, under a steady
/// force that alone would add `forced` to the velocity.
double after_step(double phase2, double u0, double forced, double delta) {
  ContactNode node = two_fields({0, -u0 - forced}, {0, 0});
  ContactPair p{1, 0, down, interface_response(phase2, u0, delta, dt), {}};
  node.add(p);
  const ContactOutcome out = solve(node);
  return dot(out.velocity[1] - out.velocity[0], down);
}

TEST(ContactInterface, IsTheExactOscillatorUpToAQuarterPeriod) {
  const double u0 = 0.7, delta = 2e-4, forced = 0.3;
  for (double phase2 = 1e-6; phase2 < stiff_phase2; phase2 *= 3) {
    const double phi = std::sqrt(phase2), w = phi / dt;
    // delta'' + w^2 delta = -forced/dt with delta(0) = delta, delta'(0) = -u0
    const double exact = u0 * std::cos(phi) + w * delta * std::sin(phi) + forced / phi * std::sin(phi);
    EXPECT_NEAR(after_step(phase2, u0, forced, delta), exact, 1e-14) << phase2;
  }
}

TEST(ContactInterface, IsFreeWithoutStiffnessAndBondedWithoutBound) {
  EXPECT_EQ(after_step(0, 0.7, 0.3, 2e-4), 1.0);
  for (double phase2 : {1e6, 1e12, 1e24})
    EXPECT_NEAR(after_step(phase2, 0.7, 0.3, 0), 0, 2 / phase2);
  // the same on both sides of the quarter period
  EXPECT_NEAR(after_step(stiff_phase2 * (1 - 1e-13), 0.7, 0.3, 2e-4), after_step(stiff_phase2, 0.7, 0.3, 2e-4), 1e-12);
  EXPECT_EQ(interface_hold(stiff_phase2).give, 0);
  EXPECT_EQ(interface_hold(0.99 * stiff_phase2).give, 1);
}

TEST(ContactInterface, RestsWhereItsTractionBalancesTheForces) {
  const double force = 12;  // N, on the relative motion of mass 1.5
  for (double phase2 : {1e-3, 0.5, 2.0, 1e3, 1e9}) {
    const double stiffness = phase2 * 1.5 / (dt * dt), forced = -force / 1.5 * dt;  // pulls the faces apart
    EXPECT_NEAR(after_step(phase2, 0, forced, force / stiffness), 0, 1e-15) << phase2;
  }
}

/// Largest |u|, in units of the first, over many free steps; the opening moves with u1 or with (u0 + u1)/2.
template <class Step>
double growth(bool mean, const Step& step) {
  double u = 1, delta = 0.3 * dt, most = 0;
  for (int i = 0; i < 100000 && most < 1e3; ++i) {
    const double next = step(u, delta);
    delta -= dt * (mean ? 0.5 * (u + next) : next);
    u = next;
    most = std::max(most, std::abs(u));
  }
  return most;
}

TEST(ContactInterface, NeverGrowsAtAnyStiffnessAndTheExplicitUpdateDoes) {
  for (bool mean : {false, true})
    for (double phase2 = 1e-6; phase2 < 2e12; phase2 *= 10) {
      const double most = growth(mean, [&](double u, double delta) {
        const PairResponse r = interface_response(phase2, u, delta, dt);
        return r.give * u + r.bias;
      });
      EXPECT_LT(most, 2) << phase2 << (mean ? " mean" : " last");
      if (phase2 > 5) {
        const double naive = growth(mean, [&](double u, double delta) { return u + phase2 * delta / dt; });
        EXPECT_GT(naive, 1e3) << phase2;
      }
    }
}

TEST(ContactInterface, KeepsItsPeriodOverManyOscillations) {
  const double phase2 = 0.01;  // 63 steps a period
  double u = 1, delta = 0;
  int crossings = 0;
  const int steps = 6283;  // phi * steps = 200 pi + 0.0147
  for (int i = 0; i < steps; ++i) {
    const PairResponse r = interface_response(phase2, u, delta, dt);
    const double next = r.give * u + r.bias;
    delta -= 0.5 * dt * (u + next);
    crossings += u * next < 0;
    u = next;
  }
  EXPECT_NEAR(crossings, 200, 1);
  EXPECT_GT(u, 0.9);  // neither the amplitude nor the phase is lost
}

}  // namespace
}  // namespace riven
