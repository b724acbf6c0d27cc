// Cracks that grow by K and J set by hand: where they go, how fast, and what they leave behind.
#include "kernels/grow_cracks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/fracture/growth.hpp"
#include "tests/kernels/driven_growth.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace driven_growth;
using Kind = CrackEvent::Kind;

TEST(GrowCracks, GoStraightAtTheSpeedLimit) {
  for (const double limit : {5., 10., 25., 38., 45.}) {
    Driven run(plate({crack("edge", {{-1, 8}, {6, 8}})}, limit), open);  // on a grid line
    ASSERT_EQ(run.m.state.tips.size(), 1u);
    double start = -1;
    while (run.m.state.tips[0].length < 12 && run.m.state.clock.step < 2000) {
      run.steps(1);
      const Tip& t = run.m.state.tips[0];
      if (start < 0 && t.length > 0)
        start = run.m.state.clock.time;
      if (start >= 0) {
        const double since = run.m.state.clock.time - start;
        EXPECT_LE(t.length, limit * since + 0.5 + 1e-9) << limit;
        EXPECT_GE(t.length, std::min(limit, 0.5 / run.m.state.clock.dt) * since - 0.5) << limit;
      }
    }
    const Tip& t = run.m.state.tips[0];
    EXPECT_GE(t.length, 12);
    EXPECT_NEAR(t.speed, std::min(limit, 0.5 / run.m.state.clock.dt), 0.02 * limit);
    EXPECT_EQ(run.events(), std::vector{Kind::start});
    EXPECT_NEAR(run.m.state.ledger.energy.fracture, 3 * 0.5 * t.length, 1e-9);
    EXPECT_NEAR(t.released, 3 * 0.5 * t.length, 1e-9);
    for (int k = 0; k < run.m.state.cracks.points(); ++k)
      EXPECT_NEAR(run.m.state.cracks.plane[k].y, 8, 0.02);
  }
}

TEST(GrowCracks, TurnInTheDirectionOfGreatestHoopStress) {
  for (const double K_II : {0.3, -0.3})
    for (const bool last : {true, false}) {
      std::vector<Vec2> points{{-1, 8.2}, {6, 8.2}};
      if (!last)
        std::reverse(points.begin(), points.end());
      bool once = true;
      Driven run(plate({crack("edge", points)}), [&](Tip& t) {
        open(t);
        t.drive_II = once ? K_II : 0;
      });
      const Vec2 before = run.end(0, last);
      while (run.m.state.tips[0].length == 0)
        run.steps(1);
      once = false;
      run.steps(30);
      const Vec2 way = run.end(0, last) - before;
      EXPECT_NEAR(std::atan2(way.y, way.x), greatest_hoop_stress(2, K_II).angle, 0.02);
      EXPECT_EQ(way.y > 0, K_II < 0);
    }
}

/// The same crack, written from either end, grows the same way.
TEST(GrowCracks, AtTheFirstEndAsAtTheLast) {
  const auto other = crack("other", {{3, 3}, {7, 2.5}});
  Driven a(plate({crack("edge", {{-1, 8.2}, {6, 8.4}}), other}), open);
  Driven b(plate({crack("edge", {{6, 8.4}, {-1, 8.2}}), other}), open);
  a.steps(150);
  b.steps(150);
  const Cracks &ca = a.m.state.cracks, &cb = b.m.state.cracks;
  ASSERT_EQ(ca.points(), cb.points());
  ASSERT_GT(ca.points(), 30);
  for (int k = 0; k < ca.start[1]; ++k)
    EXPECT_LT(norm(ca.plane[k] - cb.plane[ca.start[1] - 1 - k]), 1e-9) << k;
  for (int k = ca.start[1]; k < ca.start[2]; ++k)
    EXPECT_LT(norm(ca.plane[k] - cb.plane[k]), 1e-9) << k;
}

TEST(GrowCracks, ArrestAndStartAgain) {
  double K_I = 2;
  Driven run(plate({crack("edge", {{-1, 8.1}, {6, 8.1}})}), [&](Tip& t) {
    t.drive_I = K_I;
    t.release = K_I * K_I / PlaneElasticity(run.m.scene.materials[0], run.m.scene.plane).E;
  });
  run.steps(20);
  EXPECT_GT(run.m.state.tips[0].length, 0);
  EXPECT_EQ(run.events(), std::vector{Kind::start});
  K_I = 0.5;
  run.steps(120);
  EXPECT_EQ(run.events(), (std::vector{Kind::start, Kind::arrest}));
  EXPECT_EQ(run.m.state.tips[0].speed, 0);
  const double length = run.m.state.tips[0].length;
  run.steps(500);
  EXPECT_EQ(run.m.state.tips[0].length, length);
  K_I = 2;
  run.steps(10);
  EXPECT_EQ(run.events(), (std::vector{Kind::start, Kind::arrest, Kind::start}));
}

/// A notch without tractions grows into the region that has them: at its tip, or farther on. Nearest to where the
/// region begins a point stands for faces on both sides.
TEST(GrowCracks, BearTractionsWhereTheyGrowIntoTheirRegion) {
  for (const double begins : {6., 7.6})
    for (const bool last : {true, false}) {
      std::vector<Vec2> points{{-1, 8.2}, {6, 8.2}};
      if (!last)
        std::reverse(points.begin(), points.end());
      Scene s = plate({crack("edge", points)});
      s.cracks[0].traction = TractionSettings{};
      s.cracks[0].traction->pressure = {1e-3, [](double) { return 1.; }, ""};
      s.cracks[0].traction->region = Rectangle{{begins, 0}, {20, 20}};
      Driven run(s, open);
      while (run.m.state.tips[0].length < 5)
        run.steps(1);
      const Cracks& c = run.m.state.cracks;
      for (int k = 0; k < c.points(); ++k) {
        const double x = c.plane0[k].x, particle = 0.5;
        SCOPED_TRACE(testing::Message() << begins << " last " << last << " at " << x);
        const Vec2 borne = c.bearing[k];
        if (x < begins - 0.5 * particle) {
          EXPECT_EQ(borne.x + borne.y, 0);
        } else if (x > begins + 0.5 * particle) {
          EXPECT_NEAR(borne.x, 0.5, 1e-12);  // m, thick
          EXPECT_NEAR(borne.y, 0.5, 1e-12);
        }
      }
    }
}

/// Neither an old J nor one without a sound contour lets a crack grow into the solid; but a running one goes through to
/// an edge.
TEST(GrowCracks, NeedAJThatCanBeTrusted) {
  bool sound = false;
  Driven run(plate({crack("edge", {{-1, 8.1}, {6, 8.1}})}, 25), [&](Tip& t) {
    open(t);
    t.sound = sound;
  });
  run.steps(50);
  EXPECT_EQ(run.m.state.tips[0].length, 0);
  sound = true;
  run.drive = [](Tip& t) {
    open(t);
    t.step -= 1;
  };
  run.steps(50);
  EXPECT_EQ(run.m.state.tips[0].length, 0);
  run.drive = [&](Tip& t) {
    open(t);
    t.sound = t.length < 5;
  };
  run.steps(100);
  EXPECT_NEAR(run.m.state.tips[0].length, 5, 0.5);
  EXPECT_EQ(run.events(), (std::vector{Kind::start, Kind::arrest}));
  run.drive = [&](Tip& t) {
    open(t);
    t.sound = t.length < 16;
  };
  run.to_the_end();
  EXPECT_EQ(run.m.state.events.back().kind, Kind::exit);
}

/// First positions of new points are those of the material there: a crack that grows straight in a turned plate was
/// straight at first.
TEST(GrowCracks, NewPointsKnowWhereTheyWereAtFirst) {
  Scene scene = plate({crack("edge", {{8.1, 8.1}, {10.1, 8.1}})}, 25);
  scene.grid = {{-8, -10}, {32, 26}};
  Driven run(scene, open);
  auto& p = run.m.state.particles;
  for (long i = 0; i < p.count(); ++i) {
    p.v[0][i] = -0.3 * (p.x[1][i] - 8);
    p.v[1][i] = 0.3 * (p.x[0][i] - 12);
  }
  run.drive = [&](Tip& t) {
    if (t.last && run.m.state.clock.time > 1.6 && t.length < 4)
      open(t);
    else
      t.drive_I = 0;
  };
  run.steps(200);
  const Cracks& c = run.m.state.cracks;
  const Vec2 d = run.end(0, true) - run.end(0, false);
  EXPECT_GT(run.m.state.tips[1].length, 3.9);
  EXPECT_GT(std::atan2(d.y, d.x), 0.45);
  for (int k = 0; k < c.points(); ++k)
    EXPECT_NEAR(c.plane0[k].y, 8.1, 0.05) << k;
  EXPECT_NEAR(c.plane0[c.points() - 1].x, 10.1 + run.m.state.tips[1].length, 0.15);
}

/// Makes the right half of the plate a body of another material.
void make_right_half(Scene& scene, const Material& material) {
  scene.materials.push_back(material);
  scene.bodies.push_back(scene.bodies[0]);
  scene.bodies[0].region = Rectangle{{0, 0}, {12, 16}};
  scene.bodies[1].region = Rectangle{{12, 0}, {24, 16}};
  scene.bodies[1].name = "right";
  scene.bodies[1].material = 1;
}

/// A tip says when its contour of two cells to a side takes in another material, and is of that one once it lies in it;
/// the points that it leaves know how dense the bodies beside them are.
TEST(GrowCracks, SayThatTheyComeToAnotherMaterial) {
  Scene scene = plate({crack("edge", {{-1, 8.2}, {6, 8.2}})}, 25);
  make_right_half(scene, {"heavy", LawKind::linear_elastic, 1e6, 0.3, 8000});
  Driven run(scene, open);
  const FractureReport& report = run.m.fracture;
  while (report.mixed == 0 && run.end(0, true).x < 20)
    run.steps(1);
  EXPECT_NEAR(report.place[4].x, 10.25, 0.5) << "two cells before the first particles";
  EXPECT_EQ(run.m.state.tips[0].material, 0);
  while (run.end(0, true).x < 14)
    run.steps(1);
  EXPECT_EQ(run.m.state.tips[0].material, 1);
  EXPECT_GT(report.mixed, 1);
  const Cracks& c = run.m.state.cracks;
  for (int k = 0; k < c.points(); ++k) {
    const double x = c.plane0[k].x;
    if (std::fabs(x - 12) > 0.3) {
      EXPECT_EQ(c.density[k], (x < 12 ? Vec2{1000, 1000} : Vec2{8000, 8000})) << x;
    }
  }
}

/// Where the rule has no toughness that of the material around the tip holds: K_I = 2 takes it through one of 1.5 and
/// not through one of 2.5, and that the two are elastically alike leaves nothing to be said of the contour.
TEST(GrowCracks, ByTheToughnessOfTheirMaterial) {
  for (const bool by_J : {false, true}) {
    Scene scene = plate({crack("edge", {{-1, 8.2}, {6, 8.2}})}, 25);
    scene.growth->toughness = 0;
    scene.growth->speed_limit = 2;  // a ninth of the Rayleigh speed: so slow a tip meets no more when it slows
    scene.growth->criterion = by_J ? GrowthCriterion::critical_j : GrowthCriterion::k_max;
    const double K = std::sqrt(3 * PlaneElasticity(scene.materials[0], scene.plane).E);  // that releases 3 J/m^2
    scene.materials[0].K_Ic = 0.75 * K;
    scene.materials[0].J_Ic = 2.5;
    make_right_half(scene, {"tough", LawKind::linear_elastic, 1e6, 0.3, 1000, 1.25 * K, 3.5});
    Driven run(scene, [K](Tip& t) {
      open(t);
      t.drive_I = K;
    });
    run.steps(1200);
    EXPECT_EQ(run.events(), (std::vector{Kind::start, Kind::arrest}));
    EXPECT_NEAR(run.end(0, true).x, 12, 0.6);
    EXPECT_NEAR(run.m.state.tips[0].load, by_J ? std::sqrt(3 / 3.5) : 0.8, 1e-12);
    EXPECT_EQ(run.m.fracture.mixed, 0);
  }
}

TEST(GrowCracks, TheSameOnEverySpace) {
  std::vector<std::vector<Vec2>> first;
  for (const test::SpaceCase& where : test::space_cases()) {
    if (where.scatter != ScatterKind::ordered)
      continue;
    const exec::Space space(where.kind, where.threads);
    Driven run(
        plate({crack("edge", {{-1, 8}, {6, 8}}), crack("upright", {{10.2, 3}, {10.1, 12}}),
               crack("right", {{25, 8.2}, {18, 8.1}})},
              25),
        [](Tip& t) {
          open(t);
          t.drive_II = 0.1 * t.crack;
        },
        space);
    run.steps(120);
    EXPECT_GT(run.m.state.cracks.junctions.size(), 0u);
    std::vector<std::vector<Vec2>> now;
    const Cracks& c = run.m.state.cracks;
    for (const auto* a : {&c.plane, &c.upper, &c.lower, &c.plane0})
      now.emplace_back(a->begin(), a->end());
    if (first.empty())
      first = now;
    for (size_t a = 0; a < now.size(); ++a) {
      ASSERT_EQ(now[a].size(), first[a].size()) << where.name();
      if (where.same_bits()) {
        EXPECT_EQ(std::memcmp(now[a].data(), first[a].data(), now[a].size() * sizeof(Vec2)), 0) << where.name();
        continue;
      }
      for (size_t k = 0; k < now[a].size(); ++k)
        EXPECT_LT(norm(now[a][k] - first[a][k]), 1e-9) << where.name() << ", point " << k;
    }
  }
}

}  // namespace
}  // namespace riven
