// Where cracks that grow come to an end: they leave the solid, join others, meet or pass their tips, and break through.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kernels/grow_cracks.hpp"
#include "tests/kernels/driven_growth.hpp"

namespace riven {
namespace {

using namespace driven_growth;
using Kind = CrackEvent::Kind;

int above(Vec2 x, double y) {
  return x.y > y;
}

TEST(GrowCracks, LeaveTheSolidInTwoParts) {
  for (const double y : {8., 8.25, 8.1}) {  // on a grid line, through particles, beside both
    Scene scene = plate({crack("edge", {{-1, y}, {6, y}})}, 25);
    scene.contact.law = ContactLaw::ignored;
    Driven run(scene, open);
    // slowly: nothing turns the crack back, and as the solid stretches beside it, it turns into the next row of
    // particles
    for (double& v : run.m.state.particles.v[1])
      v *= 0.1;
    EXPECT_GT(run.shared_fields([&](Vec2 x) { return above(x, y); }), 0);
    run.to_the_end();
    EXPECT_EQ(run.events(), (std::vector{Kind::start, Kind::exit}));
    const CrackEvent& exit = run.m.state.events.back();
    EXPECT_NEAR(exit.place.x, 24, 0.6);
    EXPECT_NEAR(exit.place.y, y, 0.3);
    EXPECT_EQ(exit.J, 3);
    EXPECT_EQ(run.m.state.tips[0].J, 0);
    EXPECT_FALSE(run.m.state.tips[0].open);
    EXPECT_GT(run.end(0, true).x, 25.5);
    const int points = run.m.state.cracks.points();
    // the particles in line with the crack belong to either part
    const auto part = [&](Vec2 x) { return above(x, y == 8.25 ? 8.2 : y); };
    run.steps(1);
    if (y != 8.25) {
      EXPECT_EQ(run.shared_fields(part), 0) << y;
    }
    const auto momentum = [&](bool upper) {
      Vec2 sum;
      const auto& p = run.m.state.particles;
      for (long i = 0; i < p.count(); ++i)
        if (part(run.first[static_cast<size_t>(p.id[i])]) == upper)
          sum += p.mass[i] * Vec2{p.v[0][i], p.v[1][i]};
      return sum;
    };
    const Vec2 up = momentum(true), low = momentum(false);
    run.steps(60);
    EXPECT_EQ(run.m.state.cracks.points(), points);
    if (y != 8.25) {
      EXPECT_EQ(run.shared_fields(part), 0) << y;
      EXPECT_LT(norm(momentum(true) - up), 1e-11 * norm(up)) << y;
      EXPECT_LT(norm(momentum(false) - low), 1e-11 * norm(low)) << y;
    }
  }
}

TEST(GrowCracks, LeaveIntoAHoleAndAtASlant) {
  Scene scene = plate({crack("inner", {{6, 8.1}, {7, 8.1}}), crack("slant", {{3, 12.1}, {4, 13.1}})}, 25);
  scene.bodies[0].holes = {Disk{{14, 8}, 3}};
  Driven run(scene, open);
  ASSERT_EQ(run.m.state.tips.size(), 4u);
  run.to_the_end();
  for (const CrackEvent& e : run.m.state.events)
    EXPECT_TRUE(e.kind == Kind::start || e.kind == Kind::exit);
  for (const CrackEvent& e : run.m.state.events)
    if (e.kind == Kind::exit && e.crack == 0 && e.last) {
      EXPECT_NEAR(norm(e.place - Vec2{14, 8}), 3, 0.8);
    }
  run.steps(50);
  const auto part = [](Vec2 x) { return x.y > x.x + 9.1 ? 0 : x.x < 14 ? 1 + (x.y > 8.1) : 3; };
  // around the hole the plate holds together
  EXPECT_EQ(run.shared_fields([&](Vec2 x) { return part(x) == 0; }), 0);
  EXPECT_EQ(run.shared_fields([&](Vec2 x) {
    return x.x > 12 ? 0 : part(x) == 2 ? 2 : part(x) == 1 ? 1 : 0;
  }) > 0,
            true);
}

/// A pressure pushes on what lies in the solid: what is drawn on beyond it finds nodes of next to no mass, whose work
/// would be out of all proportion.
TEST(GrowCracks, BearNothingBeyondTheSolid) {
  for (const bool last : {true, false}) {
    Scene scene = plate({crack("edge", {{18, 8.1}, {7, 8.1}})}, 25);
    if (last)
      std::reverse(scene.cracks[0].points.begin(), scene.cracks[0].points.end());
    scene.cracks[0].traction.emplace().pressure = TimeFunction{1, {}, ""};
    Driven run(scene, [last](Tip& t) {
      if (t.last == last)
        open(t);
      else
        t.drive_I = t.J = t.release = 0;
    });
    const auto grows = [last](const Tip& t) { return t.last == last && t.open; };
    for (int n = 0; n < 3000 && std::any_of(run.m.state.tips.begin(), run.m.state.tips.end(), grows); ++n)
      run.steps(1);
    const Cracks& c = run.m.state.cracks;
    const double outside = c.plane[c.end_point(0, last)].x;
    EXPECT_GT(outside, 25);
    for (int k = 0; k + 1 < c.points(); ++k) {
      const bool beyond = std::max(c.plane[k].x, c.plane[k + 1].x) == outside;
      EXPECT_EQ(c.bearing[k].y, beyond ? 0 : scene.thickness) << k;
      EXPECT_EQ(c.bearing[k + 1].x, beyond ? 0 : scene.thickness) << k;
    }
  }
}

/// Another body stands 1 m, two particles, beyond the edge; and the far side of a slot does.
TEST(GrowCracks, LeaveWithoutCuttingWhatIsBeyond) {
  for (const bool slot : {false, true}) {
    Scene scene = plate({crack("edge", {{-1, 8.1}, {6, 8.1}})}, 25);
    if (slot) {
      scene.bodies[0].holes = {Rectangle{{14, 6}, {15, 10}}};
    } else {
      scene.bodies[0].region = Rectangle{{0, 0}, {14, 16}};
      scene.bodies.push_back(scene.bodies[0]);
      scene.bodies[1].name = "beyond";
      scene.bodies[1].region = Rectangle{{15, 0}, {17, 16}};
    }
    Driven run(scene, open);
    run.to_the_end();
    EXPECT_EQ(run.events(), (std::vector{Kind::start, Kind::exit}));
    EXPECT_NEAR(run.m.state.events.back().place.x, 14, 0.6);
    EXPECT_GT(run.end(0, true).x, 14.2);
    EXPECT_LT(run.end(0, true).x, 15);
    run.steps(1);
    // 1 below, 2 above in what is beyond, which still share nodes
    EXPECT_GT(run.shared_fields([](Vec2 x) { return x.x < 15 ? 0 : 1 + (x.y > 8.1); }), 0) << slot;
  }
}

/// A crack grows into one that goes through the plate; three parts share nothing, then and later, while all move.
TEST(GrowCracks, JoinACrackInTheWay) {
  for (const double y : {8., 8.1})
    for (const double x : {14., 14.2}) {
      Driven run(plate({crack("edge", {{-1, y}, {6, y}}), crack("upright", {{x, -1}, {x + 1e-3, 17}})}, 25), open);
      ASSERT_EQ(run.m.state.tips.size(), 1u);
      auto& p = run.m.state.particles;
      for (long i = 0; i < p.count(); ++i) {  // turning, too
        p.v[0][i] -= 0.1 * (p.x[1][i] - 8);
        p.v[1][i] += 0.1 * (p.x[0][i] - 12);
      }
      run.to_the_end();
      EXPECT_EQ(run.events(), (std::vector{Kind::start, Kind::join}));
      EXPECT_EQ(run.m.state.events.back().other, 1);
      ASSERT_EQ(run.m.state.cracks.junctions.size(), 1u);
      const auto part = [&](Vec2 q) { return q.x > x ? 2 : above(q, y); };
      for (int n = 0; n < 5; ++n) {
        run.steps(20);
        EXPECT_EQ(run.shared_fields(part), 0) << y << ' ' << x << ' ' << n;
        const Junction& j = run.m.state.cracks.junctions[0];
        const Vec2* on = run.m.state.cracks.plane.data() + run.m.state.cracks.start[1] + j.segment;
        const Vec2 at = on[0] + j.along * (on[1] - on[0]), tip = run.end(0, true);
        EXPECT_NEAR(norm(tip - at), 1e-6, 1e-9);
        EXPECT_LT(dot(at - run.m.state.cracks.plane[run.m.state.cracks.next_to_end(0, true)], at - tip), 0);
      }
    }
}

/// Faces that stand wide open are joined, not left into; and a running tip needs no contour to get there.
TEST(GrowCracks, JoinACrackThatStandsOpen) {
  bool run_now = false;
  for (const bool sound : {true, false}) {
    Scene scene = plate({crack("edge", {{-1, 8.1}, {6, 8.1}}), crack("upright", {{14.2, -1}, {14.2, 17}})}, 25);
    Driven run(scene, [&](Tip& t) {
      t.K_I = 0;
      if (run_now) {
        open(t);
        t.sound = sound || t.length < 5;
      }
    });
    auto& p = run.m.state.particles;
    for (long i = 0; i < p.count(); ++i)  // the right part moves away
      p.v[0][i] = p.x[0][i] > 14.2 ? 5 : 0;
    run.steps(25);
    run_now = true;
    run.to_the_end();
    run_now = false;
    EXPECT_EQ(run.events(), (std::vector{Kind::start, Kind::join}));
    EXPECT_GT(run.end(0, true).x, 14.6);
    run.steps(20);
    EXPECT_EQ(run.shared_fields([&](Vec2 q) { return q.x > 14.2 ? 2 : above(q, 8.1); }), 0);
  }
}

/// The tie holds on to its segment while the crack that was joined grows at its first end.
TEST(GrowCracks, StayTiedWhileTheOtherGrows) {
  Driven run(plate({crack("edge", {{-1, 8.1}, {6, 8.1}}), crack("upright", {{8.2, 6}, {8.2, 17}})}, 25), open);
  run.drive = [](Tip& t) {
    if (t.crack == 0)
      open(t);
  };
  run.steps(40);
  ASSERT_EQ(run.m.state.cracks.junctions.size(), 1u);
  const Vec2 at = run.end(0, true);
  run.drive = open;
  run.to_the_end();
  run.steps(1);
  EXPECT_EQ(run.events(), (std::vector{Kind::start, Kind::join, Kind::start, Kind::exit}));
  EXPECT_LT(norm(run.end(0, true) - at), 0.2);
  EXPECT_EQ(run.shared_fields([](Vec2 x) { return x.x > 8.2 ? 2 : above(x, 8.1); }), 0);
}

TEST(GrowCracks, JoinTheEndOfACrackBesideTheirWay) {
  Driven run(plate({crack("edge", {{-1, 8}, {6, 8}}), crack("upright", {{14.1, 8.2}, {14.1, 17}})}, 25), [](Tip& t) {
    if (t.crack == 0)
      open(t);
  });
  ASSERT_EQ(run.m.state.tips.size(), 2u);
  run.to_the_end();
  EXPECT_EQ(run.events(), (std::vector{Kind::start, Kind::join, Kind::join}));
  run.steps(20);
  EXPECT_LT(norm(run.end(0, true) - run.end(1, false)), 2e-6);
}

/// Two cracks that grow towards each other part the plate.
TEST(GrowCracks, TipsThatMeetBecomeOneLine) {
  for (const double y : {8., 8.1})
    for (const double offset : {0., 0.2, -0.4}) {
      Driven run(plate({crack("left", {{-1, y}, {6, y}}), crack("right", {{25, y + offset}, {18, y + offset}})}, 25),
                 open);
      run.to_the_end();
      EXPECT_EQ(run.events(), (std::vector{Kind::start, Kind::start, Kind::meet, Kind::meet}));
      EXPECT_LT(norm(run.end(0, true) - run.end(1, true)), 2e-6);
      // what is above and what below the line of both, as it was at first; beside it by less than that is known neither
      const Cracks& c = run.m.state.cracks;
      std::vector<Vec2> line(c.plane0.begin(), c.plane0.begin() + c.start[1]);
      line.insert(line.end(), std::reverse_iterator(c.plane0.end()),
                  std::reverse_iterator(c.plane0.begin() + c.start[1]));
      std::sort(line.begin(), line.end(), [](Vec2 a, Vec2 b) { return a.x < b.x; });
      const auto part = [&](Vec2 x) {
        const auto to = std::find_if(line.begin() + 1, line.end() - 1, [&](Vec2 p) { return p.x >= x.x; });
        const Vec2 a = to[-1], d = *to - a;
        const double off = x.y - a.y - (d.x > 0 ? (x.x - a.x) / d.x * d.y : 0);
        return std::fabs(off) < 0.05 ? -1 : int{off > 0};
      };
      for (int n = 0; n < 5; ++n) {
        EXPECT_EQ(run.shared_fields(part), 0) << y << ' ' << offset << ' ' << n;
        run.steps(20);
      }
    }
}

/// With tips within a cell J vanishes; a running tip does not wait for it, a resting one is left alone.
TEST(GrowCracks, RunningTipsMeetWithoutJ) {
  for (const bool running : {false, true}) {
    Driven run(plate({crack("left", {{-1, 8.1}, {6, 8.1}}), crack("right", {{25, 8.1}, {10, 8.1}})}, 25), [&](Tip& t) {
      const bool near = t.length > (running ? 3.1 : -1);
      t.drive_I = t.J = t.release = near || t.crack == 1 ? 0 : 2;
    });
    run.steps(100);
    EXPECT_EQ(run.events(), running ? (std::vector{Kind::start, Kind::meet, Kind::meet}) : std::vector<Kind>{});
  }
}

/// Offset by two cells, tips pass each other.
TEST(GrowCracks, TipsThatDoNotFaceEachOtherPass) {
  Driven run(plate({crack("left", {{-1, 7}, {6, 7}}), crack("right", {{25, 9}, {18, 9}})}, 25), open);
  run.to_the_end();
  EXPECT_EQ(run.events(), (std::vector{Kind::start, Kind::start, Kind::exit, Kind::exit}));
}

/// What is left of the solid between a tip and an edge, too little for a contour, breaks from rest where J and K drive
/// the tip, and not by K of a contour whose J is nothing.
TEST(GrowCracks, BreakWhatIsLeftBeforeAnEdge) {
  for (const bool driven : {true, false}) {
    Driven run(plate({crack("edge", {{-1, 8.1}, {22.6, 8.1}})}, 25), [&](Tip& t) {
      open(t);
      t.sound = false;
      t.K_I = driven ? t.drive_I : 0;
      t.J = driven ? t.J : 0;
    });
    run.steps(100);
    EXPECT_EQ(run.events(), (driven ? std::vector{Kind::start, Kind::exit} : std::vector<Kind>{}));
  }
}

/// What contours give that cannot be trusted counts in no energy.
TEST(GrowCracks, TakeUpWhatTheyHaveMetWhereNoContourIsSound) {
  Driven run(plate({crack("edge", {{-1, 8.1}, {6, 8.1}})}, 25), [&](Tip& t) {
    open(t);
    t.sound = t.length < 15.5;
    if (!t.sound)
      t.J = t.release = 1e6;
  });
  run.to_the_end();
  const Tip& tip = run.m.state.tips[0];
  EXPECT_EQ(run.events(), (std::vector{Kind::start, Kind::exit}));
  EXPECT_GT(tip.length, 17);
  EXPECT_NEAR(run.m.state.ledger.energy.fracture, 3 * 0.5 * tip.length, 0.01 * tip.length);
}

TEST(GrowCracks, PassOnesWhoseFacesNeverPart) {
  Scene scene = plate({crack("edge", {{-1, 8.1}, {6, 8.1}}), crack("across", {{14, -1}, {14, 17}})}, 25);
  scene.cracks[1].contact = ContactSettings{ContactLaw::bonded, 0, 0, 0};
  Driven run(scene, open);
  run.to_the_end();
  EXPECT_EQ(run.events(), (std::vector{Kind::start, Kind::exit}));
  EXPECT_GT(run.m.state.events.back().place.x, 23);
}

/// Where its rule says which way whatever the modes say, it goes that way through what is left, too.
TEST(GrowCracks, BreakThroughInTheDirectionOfTheirRule) {
  for (const bool fixed : {true, false}) {
    const std::vector<Vec2> points = fixed ? std::vector<Vec2>{{-1, 7}, {3, 7}} : std::vector<Vec2>{{-1, 5}, {3, 7}};
    Scene scene = plate({crack("edge", points)}, 25);
    scene.growth->direction = fixed ? GrowthDirection::fixed : GrowthDirection::self_similar;
    scene.growth->heading = {2, 1};
    Driven run(scene, [&](Tip& t) {
      open(t);
      t.sound = t.length < 15.7;  // two cells below the edge, to which it goes by 27 degrees
    });
    run.to_the_end();
    EXPECT_EQ(run.events(), (std::vector{Kind::start, Kind::exit}));
    const Vec2 out = run.m.state.events.back().place;
    EXPECT_NEAR((out.y - 7) / (out.x - 3), 0.5, 0.02) << (fixed ? "fixed" : "self-similar");
  }
}

/// One that runs along an edge less than a cell away breaks through to it where no contour fits in between.
TEST(GrowCracks, BreakThroughToAnEdgeBesideTheirWay) {
  for (const double y : {0.9, 15.1}) {
    Driven run(plate({crack("edge", {{-1, y}, {6, y}})}, 25), [&](Tip& t) {
      open(t);
      t.sound = t.length < 5;
    });
    run.to_the_end();
    EXPECT_EQ(run.events(), (std::vector{Kind::start, Kind::exit}));
    const Vec2 end = run.end(0, true);
    EXPECT_LT(end.x, 15);  // from 11, by two cells and a quarter at most, and two that are drawn beyond
    EXPECT_TRUE(y < 8 ? end.y < 0 : end.y > 16) << end.y;
  }
}

}  // namespace
}  // namespace riven
