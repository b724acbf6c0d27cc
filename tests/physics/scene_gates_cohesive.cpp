// What cohesive cracks bear and dissipate: a bar that parts in one section, and a beam along which a zone travels.
#include <cmath>

#include "core/fracture/place_domain.hpp"
#include "core/state/tractions.hpp"
#include "tests/physics/scene_gates.hpp"
#include "tests/physics/sum_tasks.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace gates;

double energy_left_over(const Energy& e) {
  return e.external_work - e.kinetic - e.strain - e.cohesive - e.damping - e.contact;
}

struct Bar {
  double dissipated = 0;   ///< J/m^2, by what the work done does not find again
  double by_law = 0;       ///< J/m^2, booked by the law
  double off_curve = 0;    ///< largest distance of the grips' stress from the law, over the strength
  double error = 0;        ///< largest |energy made or lost|, over the work of parting
  double last_stress = 0;  ///< over the strength
};

Bar pull_bar(const Scene& scene = shipped("cohesive_bar", {})) {
  const test::ChosenSpace space;
  Simulation m(scene, space);
  const Cohesive law(*scene.cracks[0].traction);
  constexpr double section = 4e-6;
  const double strength = law.strength.normal;
  Bar bar;
  double stress = 0, opening = 0;
  int steps = 0;
  while (!m.finished()) {
    m.step();
    // waves run to and fro in 12 us: averages of 100 steps, half as long
    const auto& owners = m.state.constraints.owners;
    double mean = 0, area = 0;
    for (int k = 0; k < m.state.cracks.points(); ++k) {
      const double a = face_area(m.state.cracks, k);
      mean += a * face_opening(m.state.cracks, k).normal;
      area += a;
    }
    stress += 0.5 * (owners[0].reaction.x - owners[1].reaction.x) / section;
    opening += mean / area;
    if (++steps == 100) {
      m.take_stock();
      const double x = opening / steps / law.critical.normal, s = std::abs(stress / steps) / strength;
      if (x > scene.cracks[0].traction->peak)
        bar.off_curve = std::max(bar.off_curve, std::abs(s - law.curve.traction(x)));
      bar.last_stress = s;
      bar.error = std::max(bar.error, std::abs(m.state.ledger.energy.numerical()) / (6000 * section));
      stress = opening = steps = 0;
    }
  }
  m.take_stock();
  const Energy& e = m.state.ledger.energy;
  bar.dissipated = energy_left_over(e) / section;
  bar.by_law = e.debonding / section;
  return bar;
}

TEST(CohesiveBar, FollowsTheLawAndDissipatesItsToughness) {
  const Bar bar = pull_bar();
  report("cohesive bar, energy not found again over section, J/m^2", bar.dissipated, "6000 +-2 %");
  report("cohesive bar, dissipated by the law, J/m^2", bar.by_law, "6000 +-2 %");
  report("cohesive bar, stress of the grips beside the law", bar.off_curve, "0.02 of the strength");
  report("cohesive bar, energy error", bar.error, "0.01");
  EXPECT_NEAR(bar.dissipated, 6000, 120);
  EXPECT_NEAR(bar.by_law, 6000, 120);
  EXPECT_LT(bar.off_curve, 0.02);
  EXPECT_LT(bar.error, 0.01);
  EXPECT_LT(bar.last_stress, 0.005);
}

/// The same where one half is eight times as dense, as of a polymer on a metal.
TEST(CohesiveBar, DissipatesItsToughnessBetweenHalvesOfOtherDensity) {
  Scene scene = shipped("cohesive_bar", {"crack.crack.points.0.0=5 mm", "crack.crack.points.1.0=5 mm"});
  scene.materials.push_back(scene.materials[0]);
  scene.materials[1].name = "dense";
  scene.materials[1].density *= 8;
  scene.bodies.push_back(scene.bodies[0]);
  scene.bodies[0].region = Rectangle{{0, 0}, {5e-3, 4e-3}};
  scene.bodies[1].region = Rectangle{{5e-3, 0}, {10e-3, 4e-3}};
  scene.bodies[1].name = "right";
  scene.bodies[1].material = 1;
  const Bar bar = pull_bar(scene);
  report("cohesive bar of two densities, energy not found again over section, J/m^2", bar.dissipated, "6000 +-2 %");
  report("cohesive bar of two densities, dissipated by the law, J/m^2", bar.by_law, "6000 +-2 %");
  EXPECT_NEAR(bar.dissipated, 6000, 120);
  EXPECT_NEAR(bar.by_law, 6000, 120);
}

/// J of `cohesive_dcb` through two cuts across the beam, 6 and 10 mm from its ends, with the zone between them; the
/// edges between the cuts are free. What the faces bear is left out: this is what the zone takes up. Called where
/// J is found in a step.
double far_contour(Simulation& m) {
  const PlaneElasticity solid(m.scene.materials[0], m.scene.plane);
  TipTask task;
  constexpr double mm = 1e-3;
  constexpr double reach[4] = {26 * mm, 14 * mm, 30 * mm, 14 * mm};
  task.domain = plain_domain({40 * mm, 0}, reach, m.scene.cell);
  task.heading = {1, 0};
  task.solid = &solid;
  task.inertia = true;
  std::vector<TipTask> tasks{task};
  test::sum_tasks(m.space, m, tasks);
  return tasks[0].sums.J.x + tasks[0].sums.area.x;
}

/// The point at 20 mm, the zone's root as it is laid.
int root_of(const Cracks& c) {
  int root = 0;
  while (c.plane0[root].x < 20e-3 - 1e-9)
    ++root;
  return root;
}

double taken_up(const Cracks& c, int point) {
  return stored_energy(c, point) + dissipated_energy(c, point);
}

struct Front {
  double place = 0;  ///< m, along the crack: how far nothing is left
  double energy = 0;
};

/// Where the greatest effective opening was 1, between two points, and the energy that has gone by then.
Front front(Simulation& m) {
  m.take_stock();
  const Cracks& c = m.state.cracks;
  Front f;
  f.energy = energy_left_over(m.state.ledger.energy);
  for (int k = 0; k + 1 < c.points(); ++k) {
    const double now = c.cohesive[k].worst, next = c.cohesive[k + 1].worst;
    if (now >= 1 && next < 1)
      f.place = c.plane0[k].x + (now - 1) / (now - next) * (c.plane0[k + 1].x - c.plane0[k].x);
  }
  return f;
}

TEST(CohesiveDcb, DissipatesItsToughnessPerNewArea) {
  const test::ChosenSpace space;
  Scene scene = shipped("cohesive_dcb");
  scene.fracture.asked = true;
  Simulation m(scene, space);
  double far = 0;
  bool due = false;
  insert_task(m, "J and K", true, [&](Simulation& s) {
    if (due)
      far = far_contour(s);
  });
  Front first, last;
  double error = 0, J = 0, inside = 0;
  int found = 0;
  for (int part = 1; part <= 40; ++part) {
    while (!m.finished() && m.state.clock.time < part / 40.0 * scene.end_time)
      m.step();
    const Front now = front(m);
    const Energy& e = m.state.ledger.energy;
    error = std::max(error, std::abs(e.relative_error()));
    if (now.place > 24e-3 && first.place == 0)
      first = now;
    if (now.place < 48e-3)
      last = now;
    if (now.place > 24e-3 && now.place < 48e-3 && !m.finished()) {
      due = true;
      m.step();
      due = false;
      ++found;
      J += far;
      inside += taken_up(m.state.cracks, root_of(m.state.cracks));
    }
  }
  const double toughness = (last.energy - first.energy) / ((last.place - first.place) * scene.thickness);
  report("cohesive DCB, new crack, mm", 1e3 * (last.place - first.place), "> 15");
  report("cohesive DCB, energy gone per new area, J/m^2", toughness, "500 +-5 %");
  // of which the 1 % of PIC that keeps the arms quiet takes nearly all: the ledger has no sink for what it wears down
  report("cohesive DCB, energy error", error, "0.05");
  report(fmt::format("cohesive DCB, mean J of the zone over that of the far contour, {} instants", found), inside / J,
         "1 +-4 %");
  EXPECT_GT(last.place - first.place, 15e-3);
  EXPECT_NEAR(toughness, 500, 25);
  EXPECT_GT(found, 5);
  EXPECT_NEAR(inside / J, 1, 0.04);
  EXPECT_LT(error, 0.05);
}

/// The beam of `cohesive_dcb` at rest under forces that leave part of the zone's strength. The contour along its edges
/// finds J from the loads alone, J = sum f_p . du_p/dx / b (body forces f_p), and W_Z and what the zone has dissipated
/// at its root are the same J, taken from the inside (G. Bao and Z. Suo, Appl. Mech. Rev. 45 (1992) 355-366).
TEST(CohesiveDcb, TakesUpAtItsRootTheJOfTheLoads) {
  const test::ChosenSpace space;
  Scene scene = shipped("cohesive_dcb");
  scene.grips.clear();
  scene.probes.clear();
  constexpr double force = 7, ramp = 0.6e-3;
  for (const double sign : {1., -1.}) {
    Load load;
    load.name = sign > 0 ? "up" : "down";
    load.region = sign > 0 ? Rectangle{{0, 0}, {1e-3, 8e-3}} : Rectangle{{0, -8e-3}, {1e-3, 0}};
    load.value[1] = TimeFunction{
        sign * force, [](double t) { return t < ramp ? 0.5 * (1 - std::cos(3.14159265358979 * t / ramp)) : 1; }, ""};
    scene.loads.push_back(load);
  }
  scene.grid_damping = TimeFunction{2e4, {}, ""};
  scene.end_time = 1.2e-3;
  scene.fracture.asked = true;
  Simulation m(scene, space);
  double far = 0;
  insert_task(m, "J and K", true, [&](Simulation& s) {
    const Clock& c = s.state.clock;
    if (c.time + c.dt >= scene.end_time * (1 - 1e-12))
      far = far_contour(s);
  });
  const auto first = m.state.particles.x;
  const std::vector<int> before = by_id(m.state.particles);
  std::vector<Vec2> start;
  start.reserve(before.size());
  for (const int i : before)
    start.push_back({first[0][i], first[1][i]});
  while (!m.finished())
    m.step();
  m.take_stock();

  // slope of each arm where it is loaded, by least squares
  double slope = 0;
  const std::vector<int> at = by_id(m.state.particles);
  for (const double sign : {1., -1.}) {
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (size_t id = 0; id < start.size(); ++id) {
      const Vec2 x0 = start[id];
      if (x0.x > 1e-3 || x0.y * sign < 0)
        continue;
      const double u = m.state.particles.x[1][at[id]] - x0.y;
      n += 1, sx += x0.x, sy += u, sxx += x0.x * x0.x, sxy += x0.x * u;
    }
    slope += sign * (n * sxy - sx * sy) / (n * sxx - sx * sx);
  }
  const double J = -force * slope / scene.thickness;
  const Cracks& c = m.state.cracks;
  const int root = root_of(c);
  const double inside = taken_up(c, root);
  report("cohesive DCB at rest, J of the loads, J/m^2", J, "150 to 450");
  report("cohesive DCB at rest, J of the zone over J of the loads", inside / J, "1 +-4 %");
  report("cohesive DCB at rest, J of the zone over that of the far contour", inside / far, "1 +-4 %");
  report("cohesive DCB at rest, kinetic over strain energy",
         m.state.ledger.energy.kinetic / m.state.ledger.energy.strain, "1e-3");
  EXPECT_GT(J, 150);
  EXPECT_LT(J, 450);
  EXPECT_NEAR(inside / J, 1, 0.04);
  EXPECT_NEAR(inside / far, 1, 0.04);
  EXPECT_GT(stored_energy(c, root), 0.02 * inside);
  EXPECT_LT(m.state.ledger.energy.kinetic, 1e-3 * m.state.ledger.energy.strain);
}

}  // namespace
}  // namespace riven
