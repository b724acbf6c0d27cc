// Crack surfaces and planes under grid motions that are known exactly.
#include "kernels/move_cracks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "tests/kernels/crack_scene.hpp"

namespace riven {
namespace {

using namespace crack_scene;

struct Setting {
  Lattice lattice;
  Cracks cracks;
  CrackFields fields;
  Grid<double> grid;
};

/// A body over [2, 10] x [2, 10] of a 12 x 12 grid, with the masses of its particles in all fields.
template <class Shape>
Setting make_setting(const std::vector<std::vector<Vec2>>& lines, SurfaceUpdate update = SurfaceUpdate::xpic) {
  Setting s;
  s.lattice = unit_cells(12, 12);
  s.cracks = cracks_of(lines, 0.5, update);
  s.grid.lattice = s.lattice;
  std::vector<Vec2> x;
  for (int j = 0; j < 16; ++j)
    for (int i = 0; i < 16; ++i)
      x.push_back({2.25 + 0.5 * i, 2.25 + 0.5 * j});
  const auto p = sorted_particles<Shape>(s.lattice, x, in_order(x.size()));
  const auto domain = quarter_cells(s.lattice);
  const exec::Space serial;
  hash_cracks<Shape>(serial, s.lattice, s.cracks, s.fields);
  determine_fields<Shape>(serial, p, &domain, s.lattice, s.cracks, s.fields);
  s.grid.mass.resize(s.lattice.nodes() + s.fields.extra_slots);
  s.grid.q.resize(4 * s.grid.mass.size());
  for (long i = 0; i < p.count(); ++i) {
    const auto ax = Shape::axis(p.x[0][i] - s.lattice.origin.x, domain.axis[0]);
    const auto ay = Shape::axis(p.x[1][i] - s.lattice.origin.y, domain.axis[1]);
    for (int k = 0; k < Shape::width * Shape::width; ++k) {
      const int node = (ay.base + k / Shape::width) * s.lattice.nx + ax.base + k % Shape::width;
      const int field = CrackFields::field_of(s.fields.fields[i], k);
      const long slot = field == 0 ? node : long{s.lattice.nodes()} + s.fields.extra[node] + field - 1;
      s.grid.mass[slot] += ax.s[k % Shape::width] * ay.s[k / Shape::width];
    }
  }
  return s;
}

/// Sets velocity and acceleration of every slot from f(node position, node, field).
void set_motion(Setting& s, const std::function<std::array<double, 4>(Vec2, int, int)>& f) {
  for (int n = 0; n < s.lattice.nodes(); ++n) {
    const int i = s.fields.node_index[n];
    const int several = i < 0 ? 0 : s.fields.candidate_start[i + 1] - s.fields.candidate_start[i] > 1 ? 3 : 1;
    for (int field = 0; field <= several; ++field) {
      const auto q = f(s.lattice.position(n), n, field);
      const long slot = field == 0 ? n : long{s.lattice.nodes()} + s.fields.extra[n] + field - 1;
      for (int c = 0; c < 4; ++c)
        s.grid.q[4 * slot + c] = q[static_cast<size_t>(c)];
    }
  }
}

const std::vector<std::vector<Vec2>> two_cracks{{{0.6, 5.3}, {8.7, 6.1}}, {{5.2, 3.1}, {6.4, 9.3}}};

template <class Shape>
void translate(SurfaceUpdate update, CrackMotion motion) {
  Setting s = make_setting<Shape>(two_cracks, update);
  const Cracks before = s.cracks;
  const exec::Space serial;
  Vec2 moved;
  const double dt = 0.01;
  Vec2 v{3.1, -1.7};
  const Vec2 a{20, 30};
  // a constant acceleration: v is the velocity after each step, and the body moves by (v - a dt / 2) dt
  for (int step = 0; step < 5; ++step) {
    v += a * dt;
    set_motion(s, [&](Vec2, int, int) { return std::array{v.x, v.y, a.x, a.y}; });
    move_cracks<Shape>(serial, s.grid, s.fields, {motion, update}, dt, s.cracks);
    const bool first_order = update == SurfaceUpdate::pic && motion == CrackMotion::surfaces;
    moved += first_order ? v * dt : (v - 0.5 * dt * a) * dt;
  }
  for (int k = 0; k < s.cracks.points(); ++k) {
    ASSERT_LT(norm(s.cracks.plane[k] - before.plane[k] - moved), 1e-14) << k;
    if (update == SurfaceUpdate::pic)
      continue;
    ASSERT_LT(norm(s.cracks.upper[k] - before.upper[k] - moved), 1e-14) << k;
    ASSERT_LT(norm(s.cracks.lower[k] - before.lower[k] - moved), 1e-14) << k;
  }
}

TEST(MoveCracks, FollowsARigidTranslationToRoundOff) {
  for (SurfaceUpdate update : {SurfaceUpdate::xpic, SurfaceUpdate::flip, SurfaceUpdate::pic})
    for (CrackMotion motion : {CrackMotion::surfaces, CrackMotion::center_of_mass}) {
      translate<Linear>(update, motion);
      translate<UGimp>(update, motion);
      translate<BSpline>(update, motion);
    }
}

/// A crack from the middle of the body to beyond its edge, in a homogeneous motion: v = G (x - center).
struct Homogeneous {
  Vec2 Gx, Gy;  ///< columns of G, 1/s
  Vec2 operator()(Vec2 x) const { return (x.x - 6) * Gx + (x.y - 6) * Gy; }
};

template <class Shape>
void follow(const Homogeneous& v, SurfaceUpdate update, double tolerance) {
  Setting s = make_setting<Shape>({{{4.15, 4.7}, {11.2, 7.1}}}, update);
  const Cracks before = s.cracks;
  const double dt = 1e-6;
  set_motion(s, [&](Vec2 x, int, int) { return std::array{v(x).x, v(x).y, 0., 0.}; });
  move_cracks<Shape>(exec::Space{}, s.grid, s.fields, {CrackMotion::surfaces, update}, dt, s.cracks);
  const double scale = norm(v.Gx) + norm(v.Gy);
  for (int k = 0; k < s.cracks.points(); ++k) {
    const Vec2 moved = dt * v(before.plane[k]);
    for (const auto* now : {&s.cracks.plane, &s.cracks.upper, &s.cracks.lower})
      EXPECT_LT(norm((*now)[k] - before.plane[k] - moved), tolerance * dt * scale) << before.plane[k].x;
  }
}

/// To 1e-5 cells for each radian, also outside of the body. Mass-weighted means alone are wrong by 0.4.
TEST(MoveCracks, FollowsARigidRotation) {
  const Homogeneous turn{{0, 2}, {-2, 0}};
  for (SurfaceUpdate update : {SurfaceUpdate::flip, SurfaceUpdate::xpic, SurfaceUpdate::pic}) {
    follow<Linear>(turn, update, 1e-5);
    follow<UGimp>(turn, update, 1e-5);
    follow<BSpline>(turn, update, 1e-5);
  }
}

TEST(MoveCracks, FollowsAHomogeneousStrain) {
  // outside of the body there is nothing to follow but the rotation
  const auto inside = [](const Homogeneous& v) {
    Setting s = make_setting<UGimp>({{{4.15, 4.7}, {9.7, 6.6}}});
    const Cracks before = s.cracks;
    const double dt = 1e-6;
    set_motion(s, [&](Vec2 x, int, int) { return std::array{v(x).x, v(x).y, 0., 0.}; });
    move_cracks<UGimp>(exec::Space{}, s.grid, s.fields, {}, dt, s.cracks);
    for (int k = 0; k < s.cracks.points(); ++k)
      for (const auto* now : {&s.cracks.upper, &s.cracks.lower})
        EXPECT_LT(norm((*now)[k] - before.plane[k] - dt * v(before.plane[k])), 0.02 * dt) << before.plane[k].x;
  };
  inside({{1, 0}, {0, 0}});
  inside({{0, 0}, {0, 1}});
  inside({{0, 0.5}, {0.5, 0}});
}

/// The crack's mouth, 1.2 cells from the body, sees nodes that hold next to no mass and that forces throw about.
TEST(MoveCracks, KeepsPointsOutsideOfTheBodyInLine) {
  Setting s = make_setting<UGimp>({{{4.15, 4.7}, {11.2, 7.1}}});
  const Cracks before = s.cracks;
  const Homogeneous turn{{0, 2}, {-2, 0}};
  const double dt = 1e-3;
  set_motion(s, [&](Vec2 x, int, int) { return std::array{turn(x).x, turn(x).y, 0., 0.}; });
  for (int slot = 0; slot < s.grid.mass.size(); ++slot)
    if (s.grid.mass[slot] > 0 && s.grid.mass[slot] < 0.04)
      s.grid.q[4 * slot + 2] = 0.1 / s.grid.mass[slot];
  for (int slot = 0; slot < s.grid.mass.size(); ++slot)
    s.grid.q[4 * slot] += dt * s.grid.q[4 * slot + 2];
  move_cracks<UGimp>(exec::Space{}, s.grid, s.fields, {}, dt, s.cracks);
  int outside = 0;
  for (int k = 0; k < s.cracks.points(); ++k) {
    outside += before.plane[k].x > 10.7;
    EXPECT_LT(norm(s.cracks.plane[k] - before.plane[k] - dt * turn(before.plane[k])), 1e-4) << before.plane[k].x;
  }
  EXPECT_GE(outside, 1);
}

/// Where there are no nodes at all, points follow the crack's last one that knows how the body moves.
TEST(MoveCracks, TakesPointsOffTheGridAlong) {
  Setting s = make_setting<UGimp>({{{4.15, 4.7}, {26.2, 7.1}}, {{5.1, 7.3}, {5.2, -40.5}}});
  const Cracks before = s.cracks;
  const Vec2 v{3.1, -1.7};
  const double dt = 0.01;
  set_motion(s, [&](Vec2, int, int) { return std::array{v.x, v.y, 0., 0.}; });
  move_cracks<UGimp>(exec::Space{}, s.grid, s.fields, {}, dt, s.cracks);
  int off = 0;
  for (int k = 0; k < s.cracks.points(); ++k) {
    off += before.plane[k].x > 20 || before.plane[k].y < -10;
    EXPECT_LT(norm(s.cracks.plane[k] - before.plane[k] - dt * v), 1e-14) << k;
    EXPECT_LT(norm(s.cracks.upper[k] - before.upper[k] - dt * v), 1e-14) << k;
    EXPECT_LT(norm(s.cracks.lower[k] - before.lower[k] - dt * v), 1e-14) << k;
  }
  EXPECT_GE(off, 60);
}

/// A crack on a row of nodes between two blocks that mirror each other's motion: whatever rounding has made of its
/// points, the plane stays on the row, the surfaces mirror each other, and no node beyond a tip is seen from one side.
template <class Shape>
void mirror() {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> noise(-1e-15, 1e-15);
  for (double from : {4.13, 4.29, 4.37, 4.71})
    for (int trial = 0; trial < 20; ++trial) {
      const double at = 6;
      std::vector<Vec2> line(8);
      for (size_t i = 0; i < line.size(); ++i)
        line[i] = {from + 0.5 * static_cast<double>(i), at + (trial > 0 ? noise(random) : 0)};
      Setting s = make_setting<Shape>({line});
      set_motion(s, [&](Vec2 x, int node, int field) {
        const int i = s.fields.node_index[node];
        double side = x.y > at + 1e-9 ? 1 : x.y < at - 1e-9 ? -1 : 0;
        if (i >= 0 && s.fields.nodes[i].crack[0] >= 0)
          side = (s.fields.nodes[i].side[0] == Side::below) == (field == 0) ? 1 : -1;
        return std::array{std::sin(x.x), side * (1 + std::cos(2 * x.x)), 0., 0.};
      });
      const Cracks before = s.cracks;
      const double dt = 1e-2;
      move_cracks<Shape>(exec::Space{}, s.grid, s.fields, {}, dt, s.cracks);
      for (int k = 0; k < s.cracks.points(); ++k) {
        const Vec2 up = s.cracks.upper[k] - before.upper[k], low = s.cracks.lower[k] - before.lower[k];
        ASSERT_LT(norm(Vec2{up.x - low.x, up.y + low.y}), 1e-13) << Shape::name << ' ' << from << ' ' << k;
        ASSERT_LT(std::abs(s.cracks.plane[k].y - at), 1e-13) << Shape::name << ' ' << from << ' ' << k;
      }
    }
}

TEST(MoveCracks, MirrorsTheMotionOfACrackOnARowOfNodes) {
  mirror<Linear>();
  mirror<UGimp>();
  mirror<BSpline>();
}

template <class Shape>
void open() {
  // a crack through the whole body; what lies above goes up, what lies below goes down twice as fast
  Setting s = make_setting<Shape>({{{1, 5.3}, {11, 6.1}}});
  const Vec2 up{0, 1}, down{0, -2};
  set_motion(s, [&](Vec2, int node, int field) {
    const int i = s.fields.node_index[node];
    bool above = s.lattice.position(node).y > 5.3 + (s.lattice.position(node).x - 1) * 0.08;
    if (i >= 0 && s.fields.nodes[i].crack[0] >= 0)
      above = (s.fields.nodes[i].side[0] == Side::below) == (field == 0);
    const Vec2 v = above ? up : down;
    return std::array{v.x, v.y, 0., 0.};
  });
  const Cracks before = s.cracks;
  const exec::Space serial;
  const double dt = 0.01;
  move_cracks<Shape>(serial, s.grid, s.fields, {}, dt, s.cracks);
  for (int k = 0; k < s.cracks.points(); ++k) {
    const double x = before.plane[k].x;
    if (x < 2 || x > 10)
      continue;  // around the tips, outside of the body, nodes of both sides may be seen
    EXPECT_LT(norm(s.cracks.plane[k] - before.plane[k] - 0.5 * dt * (up + down)), 1e-14) << x;
    EXPECT_LT(norm(s.cracks.upper[k] - before.upper[k] - dt * up), 1e-14) << x;
    EXPECT_LT(norm(s.cracks.lower[k] - before.lower[k] - dt * down), 1e-14) << x;
  }
}

TEST(MoveCracks, MovesEachSurfaceWithItsSide) {
  open<Linear>();
  open<UGimp>();
  open<BSpline>();
}

TEST(MoveCracks, OpensBothOfTwoCrossingCracks) {
  // four blocks, each with its own velocity; away from the crossing each surface moves with the block beside it
  const std::vector<std::vector<Vec2>> cross{{{1, 6.05}, {11, 6.05}}, {{6.05, 1}, {6.05, 11}}};
  Setting s = make_setting<UGimp>(cross);
  const auto block = [](bool above, bool right) { return Vec2{right ? 1. : -1., above ? 1. : -1.}; };
  set_motion(s, [&](Vec2 x, int node, int field) {
    const int i = s.fields.node_index[node];
    bool above = x.y > 6.05, right = x.x > 6.05;
    for (int m = 0; i >= 0 && m < 2; ++m)
      if (s.fields.nodes[i].crack[m] >= 0 && (field >> m) & 1) {
        if (s.fields.nodes[i].crack[m] == 0)
          above = !above;
        else
          right = !right;
      }
    const Vec2 v = block(above, right);
    return std::array{v.x, v.y, 0., 0.};
  });
  const Cracks before = s.cracks;
  const exec::Space serial;
  const double dt = 0.01;
  move_cracks<UGimp>(serial, s.grid, s.fields, {}, dt, s.cracks);
  for (int k = 0; k < s.cracks.points(); ++k) {
    const Vec2 x = before.plane[k];
    const double along = s.cracks.crack[k] == 0 ? x.x : x.y;
    if (along < 2 || along > 10)
      continue;
    const bool flat = s.cracks.crack[k] == 0;  // its upper side is above; that of the upright crack is on the left
    const Vec2 upper = flat ? block(true, x.x > 6.05) : block(x.y > 6.05, false);
    const Vec2 lower = flat ? block(false, x.x > 6.05) : block(x.y > 6.05, true);
    EXPECT_LT(norm(s.cracks.upper[k] - x - dt * upper), 1e-14) << x.x << ' ' << x.y;
    EXPECT_LT(norm(s.cracks.lower[k] - x - dt * lower), 1e-14) << x.x << ' ' << x.y;
  }
}

TEST(MoveCracks, GivesTheSameBitsOnAnyThreadsAndSpace) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  Setting start = make_setting<UGimp>(two_cracks);
  for (double& q : start.grid.q)
    q = any(random);
  Setting alone = start;
  move_cracks<UGimp>(exec::Space{}, alone.grid, alone.fields, {}, 0.01, alone.cracks);
  for (exec::Kind kind : {exec::Kind::openmp, exec::Kind::stdpar})
    for (int threads : {1, 2, 4}) {
      Setting s = start;
      move_cracks<UGimp>(exec::Space(kind, threads), s.grid, s.fields, {}, 0.01, s.cracks);
      for (int k = 0; k < s.cracks.points(); ++k) {
        ASSERT_EQ(s.cracks.plane[k], alone.cracks.plane[k]);
        ASSERT_EQ(s.cracks.upper[k], alone.cracks.upper[k]);
        ASSERT_EQ(s.cracks.lower_velocity[k], alone.cracks.lower_velocity[k]);
      }
    }
}

}  // namespace
}  // namespace riven
