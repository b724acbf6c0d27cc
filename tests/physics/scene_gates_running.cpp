// J of tips that run. In a strip that is held stretched the release is known, at any speed; and until two offset
// cracks, which run at up to 0.7 of the shear wave speed, are abreast, J at one time is that of every contour, as
// inertia between them has its part. The control leaves that out.
#include <cmath>
#include <tuple>

#include "core/scene/schedule.hpp"
#include "io/probes.hpp"
#include "tests/physics/scene_gates.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace gates;

/// What readings of one tip said of J while it ran, J/m^2.
class Means {
 public:
  explicit Means(size_t readings) : sum_(readings), square_(readings) {}
  void add(const State<double, 2>& s, size_t tip) {
    ++rows_;
    for (size_t k = 0; k < sum_.size(); ++k) {
      const double J = s.readings[k][tip].J;
      sum_[k] += J;
      square_[k] += J * J;
    }
  }
  double mean(size_t k) const { return sum_[k] / rows_; }
  double swing(size_t k) const { return std::sqrt(std::max(0., square_[k] / rows_ - mean(k) * mean(k))); }

 private:
  int rows_ = 0;
  std::vector<double> sum_, square_;
};

FractureRules rules(FractureRules r, int contour, AreaTerm area = AreaTerm::automatic) {
  r.contour = contour;
  r.area = area;
  return r;
}

TEST(RunningTip, ReleasesTheSameByAllContours) {
  Scene s = shipped("offset_cracks", {"grid.cell=1 mm", "output.frames=0"});
  s.readings = {{"4", rules(s.fracture, 4)},
                {"8", rules(s.fracture, 8)},
                {"16", rules(s.fracture, 16)},
                {"8 without", rules(s.fracture, 8, AreaTerm::never)},
                {"16 without", rules(s.fracture, 16, AreaTerm::never)}};
  s.output.history_every = 0.4e-6;
  const test::ChosenSpace space;
  Simulation m(s, space);
  const Tip& tip = m.state.tips[m.state.tips[0].open ? 0 : 1];
  const auto place = static_cast<size_t>(&tip - m.state.tips.data());
  Means J(s.readings.size());
  for (long seen = -1; tip.length < 18e-3 && m.state.clock.time < 0.5e-3;) {
    m.step();
    if (tip.speed == 0 || m.state.readings[0].empty() || m.state.readings[0][place].step == seen)
      continue;
    seen = m.state.readings[0][place].step;
    if (tip.step == seen)
      J.add(m.state, place);
  }
  EXPECT_GE(tip.length, 18e-3);
  const double apart = J.mean(2) / J.mean(1) - 1, near = J.mean(2) / J.mean(0) - 1,
               apart_without = J.mean(4) / J.mean(3) - 1;
  report("tip that runs: mean J by 16 cells over that by 8, less 1", apart, "0.02");
  report("tip that runs: mean J by 16 cells over that by 4, less 1", near, "0.1");
  report("tip that runs, without inertia: mean J by 16 cells over that by 8, less 1", apart_without, "more than 0.05");
  EXPECT_LT(std::abs(apart), 0.02);
  EXPECT_LT(std::abs(near), 0.1);
  EXPECT_GT(apart_without, 0.05);
}

// `running_strip` at 0.2 to 0.8 of the Rayleigh speed, over 40 mm of its middle. What the strip ahead holds is half of
// the stress there times the way of the clamps. By 4 cells the fastest tip is too near.
TEST(RunningTip, ReleasesWhatTheStripAheadHolds) {
  constexpr double c_R = 900, travel = 96e-6, last_at_rest = 0.298e-3;
  for (const double share : {0.2, 0.4, 0.6, 0.8}) {
    Scene s = shipped("running_strip", {fmt::format("growth.speed_limit={} m/s", share * c_R), "output.frames=0"});
    s.readings = {{"4", rules(s.fracture, 4)}, {"16", rules(s.fracture, 16)}};
    const test::ChosenSpace space;
    Simulation m(s, space);
    const Probes probes(m);
    const Tip& tip = m.state.tips[m.state.tips[0].open ? 0 : 1];
    const auto place = static_cast<size_t>(&tip - m.state.tips.data());
    Means J(s.readings.size());
    double held = 0, drive = 0;
    int rows = 0;
    while (tip.length < 65e-3 && !m.finished()) {
      const double before = m.state.clock.time;
      m.step();
      if (before < last_at_rest && m.state.clock.time >= last_at_rest)
        held = 0.5 * probes.read(m)[0] * travel;
      if (!report_due(s, before, m.state.clock.time) || tip.length < 25e-3)
        continue;
      J.add(m.state, place);
      drive += tip.release;
      ++rows;
    }
    ASSERT_GT(rows, 20);
    drive /= rows;
    const auto of_held = [&](const char* what, double value, const char* limit) {
      report(fmt::format("strip, tip at {} c_R: {} over what is held, less 1", share, what), value / held - 1, limit);
    };
    of_held("mean J by 4 cells", J.mean(0), share < 0.7 ? "0.05" : "-0.2 to 0");
    of_held("mean J by 16 cells", J.mean(1), "0.05");
    report(fmt::format("strip, tip at {} c_R: swing of J by 16 cells over what is held", share), J.swing(1) / held,
           "0.12");
    of_held("mean of what drives the tip", drive, "0.06");
    EXPECT_NEAR(held, 646.4, 0.02 * 646.4);
    EXPECT_NEAR(J.mean(0), (share < 0.7 ? 1 : 0.9) * held, (share < 0.7 ? 0.05 : 0.1) * held);
    EXPECT_NEAR(J.mean(1), held, 0.05 * held);
    EXPECT_LT(J.swing(1), 0.12 * held);
    EXPECT_NEAR(drive, held, 0.06 * held);
  }
}

// What drives a tip swings by 40 % with each of its segments: by the peaks alone it would run through a strip that
// holds 0.85 of its toughness. Its start, when the faces are let go, is no quiet one.
TEST(RunningTip, StopsWhereTheStripHoldsLessThanItsToughness) {
  constexpr double held = 639;  // J/m^2, as the strip is stretched on these cells
  for (const auto& [ratio, least, most] : {std::tuple{0.9, 0., 6e-3}, {0.95, 0., 10e-3}, {1.05, 40e-3, 1.}}) {
    const Scene s = shipped("running_strip", {fmt::format("growth.toughness={} J/m^2", held / ratio),
                                              "growth.speed_limit=900 m/s", "solver.time=0.55 ms", "output.frames=0"});
    const test::ChosenSpace space;
    Simulation m(s, space);
    const Tip& tip = m.state.tips[m.state.tips[0].open ? 0 : 1];
    while (!m.finished())
      m.step();
    report(fmt::format("strip that holds {} of the toughness: way of the tip, mm", ratio), 1e3 * tip.length,
           fmt::format("{} to {}", 1e3 * least, 1e3 * most));
    EXPECT_GE(tip.length, least);
    EXPECT_LE(tip.length, most);
  }
}

}  // namespace
}  // namespace riven
