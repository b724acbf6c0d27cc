// Which fields of a node meet across its cracks.
#include "kernels/contact_meetings.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace riven {
namespace {

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
