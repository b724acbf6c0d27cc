// Cracks that are drawn from or to the very edge of a body part it there.
#include <gtest/gtest.h>

#include "tests/physics/scene_gates.hpp"
#include "tests/physics/scenes.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace test;

constexpr double edge = 16;  // cells of the block, each 1 m

/// A square block that a crack cuts from one of its edges to another, with the part above the crack on the move.
Scene cut_block(Vec2 from, Vec2 to, ShapeFunction shape) {
  Scene s = empty_scene(1, {{-6, -6}, {edge + 6, edge + 10}});
  s.shape = shape;
  s.contact.law = ContactLaw::ignored;
  s.bodies = {body("block", Rectangle{{0, 0}, {edge, edge}})};
  s.cracks = {crack("cut", {from, to})};
  return s;
}

/// The largest change of velocity, over the velocity, of particles of either part as they fly apart by half a cell.
double held(const Scene& s) {
  const ChosenSpace space;
  Simulation m(s, space);
  auto& p = m.state.particles;
  constexpr double v = 0.3;
  const Vec2 a = s.cracks[0].points.front(), b = s.cracks[0].points.back();
  std::vector<char> above(static_cast<size_t>(p.count()));
  for (long i = 0; i < p.count(); ++i)
    if (cross(b - a, Vec2{p.x[0][i], p.x[1][i]} - a) > 0) {
      above[static_cast<size_t>(p.id[i])] = 1;
      p.v[1][i] = v;
    }
  while (m.state.clock.time < 0.5 / v)
    m.step();
  double most = 0;
  for (long i = 0; i < p.count(); ++i)
    most = std::max(most, std::abs(p.v[1][i] - (above[static_cast<size_t>(p.id[i])] ? v : 0)) / v);
  return most;
}

TEST(Mouths, LetTheHalvesOfACutBlockFlyApart) {
  for (const ShapeFunction shape : {ShapeFunction::linear, ShapeFunction::ugimp, ShapeFunction::bspline})
    for (const auto& [from, to] : {std::pair{Vec2{0, 8}, Vec2{edge, 8}},
                                   {{0, 8.3}, {edge, 8.3}},
                                   {{0, 8.5}, {edge, 8.5}},
                                   {{0, 7}, {edge, 10.3}},
                                   {{0.2, 8}, {edge - 0.2, 8}},
                                   {{-0.4, 8.3}, {edge + 0.6, 8.3}}}) {
      const double most = held(cut_block(from, to, shape));
      gates::report(fmt::format("{}, cut from {} {} to {} {}: change of velocity of the halves", name_of(shape), from.x,
                                from.y, to.x, to.y),
                    most, "1e-9");
      EXPECT_LT(most, 1e-9);
    }
}

/// Half of a plate between walls, with a crack that begins on one of them.
double opening_at_wall(ShapeFunction shape, double y) {
  Scene s = empty_scene(1, {{0, -22}, {edge, 22}});
  s.shape = shape;
  s.plane = Plane::strain;
  s.transfer = Transfer::fmpm;
  s.order = 1;
  s.bodies = {body("plate", Rectangle{{0, -18}, {edge, 18}})};
  s.symmetry = {{0, 0, +1}, {0, edge, -1}};
  s.cracks = {crack("crack", {{0, y}, {9, y}})};
  for (const bool top : {false, true}) {
    Load l = traction_on(top ? Load::Edge::top : Load::Edge::bottom,
                         top ? Rectangle{{0, 14}, {edge, 18}} : Rectangle{{0, -18}, {edge, -14}});
    l.name = top ? "top" : "bottom";
    l.value[1] = TimeFunction{top ? 1e3 : -1e3, [](double t) { return std::min(t / 2, 1.); }, ""};
    s.loads.push_back(l);
  }
  s.grid_damping = constant(4);
  const ChosenSpace space;
  Simulation m(s, space);
  while (m.state.clock.time < 4)
    m.step();
  const Cracks& c = m.state.cracks;
  int k = 0;
  while (c.plane0[k].x < 0)
    ++k;
  return c.upper[k].y - c.lower[k].y;
}

// J of a crack of 12 mm from the left edge is 43.0 J/m^2 on cells of a quarter of the size, wherever its drawn end
// lies: beyond the edge, on it, or next to it. A crack that was held together at its mouth had 15.6.
TEST(Mouths, GiveTheJOfAnEdgeCrack) {
  const ChosenSpace space;
  for (const double from : {-22e-3, -20e-3, -19.8e-3}) {
    const double J = last_J(pulled_plate(crack("edge", {{from, 0}, {-8e-3, 0}}), 4), space);
    gates::report(fmt::format("crack drawn from {:.1f} mm: J over its reference, less 1", from * 1e3), J / 43.0 - 1,
                  "0.03");
    EXPECT_NEAR(J, 43.0, 0.03 * 43.0);
  }
}

TEST(Mouths, OpenAtAWallAlsoOnAGridLine) {
  for (const ShapeFunction shape : {ShapeFunction::ugimp, ShapeFunction::bspline}) {
    const double on = opening_at_wall(shape, 0), off = opening_at_wall(shape, 1e-4);
    gates::report(fmt::format("{}: opening at a wall of a crack on a grid line over that beside it", name_of(shape)),
                  on / off, "0.98 to 1.02");
    EXPECT_NEAR(on / off, 1, 0.02);
    EXPECT_GT(off, 0);
  }
}

}  // namespace
}  // namespace riven
