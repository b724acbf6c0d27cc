// contact.when = "auto" on the two disks: as if contact were always there, for less.
#include <gtest/gtest.h>

#include "tests/physics/scene_gates.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace gates;

struct Flight {
  std::vector<Vec2> x, v;  ///< by id
  std::vector<CrackEvent> events;
  long steps = 0;
  long tried = 0;  ///< steps in which contact was looked for
};

Flight fly(Scene scene, ContactWhen when) {
  scene.deterministic = true;
  scene.contact_rules.when = when;
  const test::ChosenSpace space;
  Simulation m(scene, space);
  while (!m.finished())
    m.step();
  Flight f;
  const auto& p = m.state.particles;
  for (const int i : by_id(p)) {
    f.x.push_back({p.x[0][i], p.x[1][i]});
    f.v.push_back({p.v[0][i], p.v[1][i]});
  }
  f.events = m.state.events;
  f.steps = m.state.clock.step;
  for (const Task& t : m.tasks)
    if (t.label == "contact after")
      f.tried = t.calls;
  return f;
}

/// Largest distance over the largest of both.
double distance(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  double most = 0, largest = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    most = std::max(most, norm(a[i] - b[i]));
    largest = std::max(largest, norm(a[i]));
  }
  return most / largest;
}

/// The left disk swells across its crack as it flies, and opens it; the right one has none.
TEST(ContactWaits, WhereNoFacesTouch) {
  Scene open = shipped("two_disks");
  open.cracks.pop_back();
  open.bodies[0].velocity_field[1] = Field(20, [](double, long n, const double*, const double* Y, double* out) {
    std::copy(Y, Y + n, out);  // 20/s
  });
  open.end_time = 3e-3;
  const Flight always = fly(open, ContactWhen::always), waiting = fly(open, ContactWhen::closing);
  const double x = distance(always.x, waiting.x), v = distance(always.v, waiting.v);
  const double tried = static_cast<double>(waiting.tried) / static_cast<double>(waiting.steps);
  report("contact that waits, no contact: difference of positions and velocities", std::max(x, v), "1e-12");
  report("contact that waits, no contact: share of steps in which it is tried", tried, "0.2");
  EXPECT_LT(x, 1e-12);
  EXPECT_LT(v, 1e-12);
  EXPECT_TRUE(waiting.events.empty());
  EXPECT_EQ(always.tried, always.steps);
  EXPECT_LE(waiting.tried, waiting.steps / 5 + 1);
}

/// The right crack closes as the disks meet, the left one when they have parted.
TEST(ContactWaits, WhereFacesTouch) {
  const Scene disks = shipped("two_disks");
  const Flight always = fly(disks, ContactWhen::always), waiting = fly(disks, ContactWhen::closing);
  const double x = distance(always.x, waiting.x), v = distance(always.v, waiting.v);
  report("contact that waits: difference of positions and velocities", std::max(x, v), "0.01");
  report("contact that waits: share of steps in which it acts or is tried",
         static_cast<double>(waiting.tried) / static_cast<double>(waiting.steps), "< 1");
  EXPECT_LT(x, 0.01);
  EXPECT_LT(v, 0.01);
  EXPECT_LT(waiting.tried, waiting.steps);
  ASSERT_FALSE(waiting.events.empty());
  EXPECT_EQ(waiting.events[0].kind, CrackEvent::Kind::close);
  EXPECT_EQ(disks.cracks[static_cast<size_t>(waiting.events[0].crack)].name, "right");
  report("contact that waits: faces close at, ms", 1e3 * waiting.events[0].time, "8 to 12");
  EXPECT_GT(waiting.events[0].time,
            8e-3);  // the disks meet after 24.6 mm at 2 m/s, less a cell and a half on each side
  EXPECT_LT(waiting.events[0].time, 12.3e-3);
}

/// Once its faces have been apart for long, contact waits again.
TEST(ContactWaits, AgainWhenFacesHaveParted) {
  Scene disks = shipped("two_disks");
  disks.cracks.erase(disks.cracks.begin());
  const Flight waiting = fly(disks, ContactWhen::closing);
  std::vector<CrackEvent::Kind> kinds;
  for (const CrackEvent& e : waiting.events)
    kinds.push_back(e.kind);
  ASSERT_GE(kinds.size(), 2u);
  for (size_t k = 0; k < kinds.size(); ++k)
    EXPECT_EQ(kinds[k], k % 2 == 0 ? CrackEvent::Kind::close : CrackEvent::Kind::open);
}

}  // namespace
}  // namespace riven
