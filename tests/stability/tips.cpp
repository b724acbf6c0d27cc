// Tips anywhere in a cell, and tips that move.
#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "tests/physics/plates.hpp"
#include "tests/physics/strip.hpp"
#include "tests/spaces.hpp"
#include "tests/stability/gates.hpp"

namespace riven {
namespace {

using namespace test;
using namespace hard_cases;

constexpr double mm = 1e-3;

std::string length(double x) {
  return fmt::format("{:.9g} mm", 1e3 * x);
}

/// The edge crack of `sent` with its tip moved by a part of a cell from where it is shipped. The grips are as thick as
/// a cell.
Scene moved_tip(double cell, Vec2 cells) {
  const Vec2 tip = Vec2{25 * mm, 0} + cell * cells;
  const std::string y = length(tip.y), grip = length(std::max(cell, 1 * mm) + 50 * mm);
  return gates::shipped(
      "sent",
      {fmt::format("grid.cell={}", length(cell)), "grid.lower=[\"-8 mm\", \"-56 mm\"]",
       "grid.upper=[\"56 mm\", \"56 mm\"]",
       fmt::format("crack.H.points=[[\"-1 mm\", \"{}\"], [\"{}\", \"{}\"]]", y, length(tip.x), y),
       fmt::format("grip.top.rectangle.upper.1={}", grip), fmt::format("grip.bottom.rectangle.lower.1=-{}", grip)});
}

double J_of_moved_tip(double cell, Vec2 cells) {
  gates::Plate plate(moved_tip(cell, cells));
  plate.hold();
  return plate.tip(8).J;
}

/// How far the grips have moved when the crack begins to grow, m.
double start_of_moved_tip(double cell, Vec2 cells) {
  Scene s = moved_tip(cell, cells);
  s.fracture.contour = 8;
  s.growth = GrowthRule{};
  s.growth->criterion = GrowthCriterion::critical_j;
  s.growth->toughness = 5e3;
  const ChosenSpace space;
  Simulation m(s, space);
  while (m.state.events.empty() && !m.finished())
    m.step();
  EXPECT_FALSE(m.state.events.empty());
  return m.state.constraints.owners[0].travel.y;
}

/// Largest less smallest over the mean at the nine places at thirds of a cell.
template <class Measure>
double spread_over_nine_places(double cell, const Measure& measure) {
  double low = std::numeric_limits<double>::infinity(), high = 0, sum = 0;
  for (const double y : {-1. / 3, 0., 1. / 3})
    for (const double x : {-1. / 3, 0., 1. / 3}) {
      const double figure = measure(cell, Vec2{x, y});
      fmt::print("tip moved by {:+.3f} {:+.3f} cells: {:.5g}\n", x, y, figure);
      low = std::min(low, figure);
      high = std::max(high, figure);
      sum += figure / 9;
    }
  return (high - low) / sum;
}

/// J itself changes by 0.2 % per cell of crack length here.
TEST(TipOnTheGrid, MayBeAnywhereInACell) {
  below("tip at nine places of a cell of 2 mm: spread of J, 8-cell contour",
        spread_over_nine_places(2 * mm, J_of_moved_tip), 0.04);
}

TEST(TipOnTheGrid, StartsAtTheSameLoadAnywhereInACell) {
  below("tip at nine places of a cell of 2 mm: spread of the load at which it starts",
        spread_over_nine_places(2 * mm, start_of_moved_tip), 0.05);
}

TEST(TipOnTheGrid, DISABLED_MayBeAnywhereInAHalfMillimetreCell) {
  below("tip at nine places of a cell of 0.5 mm: spread of J, 8-cell contour",
        spread_over_nine_places(0.5 * mm, J_of_moved_tip), 0.04);
}

/// The clamps stretch the strip and then hold it, brought to rest until `held`, s; the crack creeps at `speed`, m/s.
Scene creeping_crack(double held, double speed) {
  const auto pull = [](double t) { return t < 0.1e-3 ? 1 - std::cos(2e4 * std::numbers::pi * t) : 0; };
  Scene s = Strip::scene(20 * mm, 400, {0.6, pull, ""});
  s.end_time = 2e-3;
  s.growth->speed_limit = speed;
  s.fracture.contour = 8;
  s.grid_damping = TimeFunction{4e4, [held](double t) { return t < held ? 1. : 0.; }, ""};
  return s;
}

TEST(MovingTip, KeepsItsJAndLeavesFacesWithoutTraction) {
  constexpr double held = 0.3e-3;
  const Scene s = creeping_crack(held, 40);
  const ChosenSpace space;
  Simulation m(s, space);
  std::vector<double> J;
  double length = 0, returned = 0, off = 0, front = 0;
  Account account(m);
  const auto& p = m.state.particles;
  std::map<int, double> borne;  // Pa, by particles beside the line of the crack at most so far
  while (front < 45 * mm && !m.finished()) {
    run(m, account, 1, 20);
    for (int i = 0; i < p.count(); ++i)
      if (std::abs(p.x0[1][i]) < 0.5 * mm)
        borne[p.id[i]] = std::max(borne[p.id[i]], Strip::density * p.stress[1][i]);
    const Tip& tip = m.state.tips[0];
    if (tip.length > length) {
      const Vec2 at = m.state.cracks.plane[m.state.cracks.end_point(0, true)];
      length = tip.length;
      returned = std::max(returned, front - at.x);
      front = at.x;
      off = std::max(off, std::abs(at.y));
      if (m.state.clock.time > held)
        J.push_back(tip.J);
    }
  }
  double jump = 0;
  for (size_t k = 1; k < J.size(); ++k)
    jump = std::max(jump, std::abs(J[k] / J[k - 1] - 1));
  const double ahead = Strip::stress_ahead(Strip::strain(m));
  double over_ahead = 0, over_borne = 0, squares = 0;
  int behind = 0;
  for (int i = 0; i < p.count(); ++i)
    if (std::abs(p.x0[1][i]) < 0.5 * mm && p.x0[0][i] > 8 * mm && p.x0[0][i] < front - 8 * mm) {
      const double left = std::abs(Strip::density * p.stress[1][i]);
      over_ahead = std::max(over_ahead, left / ahead);
      squares += std::pow(left / ahead, 2);
      ++behind;
      if (p.x0[0][i] > 20 * mm)
        over_borne = std::max(over_borne, left / borne.at(p.id[i]));
    }
  note("moving tip: segments of half a cell", static_cast<double>(J.size()));
  EXPECT_GT(J.size(), 20u);
  below("moving tip: jump of J from segment to segment", jump, 0.15);
  below("moving tip: way back, cells", returned / mm, 1e-9);
  below("moving tip: off its line, cells", off / mm, 0.05);
  // largest beside the last half cell of the crack as drawn, where the tip stood while the strip was stretched
  note("moving tip: stress across the faces behind it, largest over that of the strip ahead", over_ahead);
  below("moving tip: stress across the faces behind it, root mean square over that of the strip ahead",
        std::sqrt(squares / behind), 0.01);
  below("moving tip: stress across the faces that it left, largest over what the same particle bore", over_borne, 0.01);
  below("moving tip: momentum error", account.momentum, 1e-12);
}

}  // namespace
}  // namespace riven
