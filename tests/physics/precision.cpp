// Runs in float beside the same in double. Positions, deformation gradients and det F are in double in both;
// velocities, stresses, masses and the grid round to 6e-8 of their size, and that is all by which the two may differ.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "core/error.hpp"
#include "core/state/make_state.hpp"
#include "io/run_scene.hpp"
#include "io/vtkhdf.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/tally.hpp"
#include "tests/io/results_sample.hpp"
#include "tests/physics/scene_gates.hpp"
#include "tests/physics/scenes.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace test;
using gates::report;
constexpr double pi = std::numbers::pi;

/// The scene with the precision of Real.
template <class Real>
Scene in(Scene s) {
  s.precision = precision_of<Real>;
  return s;
}

/// What particles have come to, by id.
struct Snapshot {
  std::vector<Vec2> x;
  std::vector<double> stress[3];
  double momentum_error = 0, angular_error = 0;
};

template <class Real>
Snapshot snapshot(const SimulationOf<Real>& m) {
  const auto& p = m.state.particles;
  const size_t n = static_cast<size_t>(p.count());
  Snapshot s;
  s.x.resize(n);
  for (int c = 0; c < 3; ++c)
    s.stress[c].resize(n);
  for (int i = 0; i < p.count(); ++i) {
    const size_t id = static_cast<size_t>(p.id[i]);
    s.x[id] = {p.x[0][i], p.x[1][i]};
    for (int c = 0; c < 3; ++c)
      s.stress[c][id] = p.stress[c][i];
  }
  s.momentum_error = m.state.ledger.momentum.error();
  s.angular_error = m.state.ledger.momentum.angular_error();
  return s;
}

/// A free square of 40 cells that turns, and stretches and shears in waves as long as its edge.
Scene swirling_block(LawKind law, StressUpdate update) {
  Scene s = empty_scene(1. / 40, {{-0.5, -0.5}, {1.5, 1.5}}, law);
  s.bodies = {body("block", Rectangle{{0, 0}, {1, 1}})};
  s.bodies[0].spin = 3;
  s.stress_update = update;
  return s;
}

template <class Real>
Snapshot swirl(const Scene& scene, const SpaceCase& where) {
  Scene s = in<Real>(scene);
  s.deterministic = where.scatter == ScatterKind::ordered;
  s.scatter = where.scatter;
  const exec::Space space(where.kind, where.threads);
  SimulationOf<Real> m(s, space);
  auto& p = m.state.particles;
  for (int i = 0; i < p.count(); ++i) {
    const double X = 2 * pi * p.x[0][i], Y = 2 * pi * p.x[1][i];
    p.v[0][i] += Real(0.3 * std::sin(X) * std::cos(Y));
    p.v[1][i] += Real(0.3 * std::cos(X) * std::sin(Y));
  }
  tally(space, m.plan, m.state);
  for (int n = 0; n < 200; ++n)
    m.step();
  m.take_stock();
  return snapshot(m);
}

TEST(Precision, ASwirlingBlockInFloatKeepsMomentumAndStaysByTheOneInDouble) {
  for (const auto& [law, update] :
       {std::pair{LawKind::linear_elastic, StressUpdate::usavg}, std::pair{LawKind::neo_hookean, StressUpdate::usl}}) {
    const Scene scene = swirling_block(law, update);
    const Snapshot exact = swirl<double>(scene, {exec::Kind::serial, 1, ScatterKind::ordered});
    double scale = 0;
    for (int c = 0; c < 3; ++c)
      for (const double s : exact.stress[c])
        scale = std::max(scale, std::abs(s));
    Snapshot first;
    for (const SpaceCase& where : space_cases()) {
      const Snapshot now = swirl<float>(scene, where);
      double off = 0, stress = 0;
      for (size_t i = 0; i < now.x.size(); ++i) {
        off = std::max(off, norm(now.x[i] - exact.x[i]));
        for (int c = 0; c < 3; ++c)
          stress = std::max(stress, std::abs(now.stress[c][i] - exact.stress[c][i]));
      }
      if (first.x.empty()) {
        first = now;
        report(fmt::format("{}, float beside double: positions, cells", name_of(law)), off / scene.cell, "1e-5");
        report(fmt::format("{}, float beside double: stress over its largest", name_of(law)), stress / scale, "1e-4");
        report(fmt::format("{}, float: momentum error", name_of(law)), now.momentum_error, "1e-7");
        report(fmt::format("{}, float beside double: angular momentum error", name_of(law)),
               now.angular_error - exact.angular_error, "1e-7");
      } else if (where.same_bits()) {
        for (size_t i = 0; i < now.x.size(); ++i) {
          ASSERT_EQ(now.x[i].x, first.x[i].x) << where.name();
          ASSERT_EQ(now.stress[2][i], first.stress[2][i]) << where.name();
        }
      }
      EXPECT_GT(off, 0) << where.name() << ": the run must have been in float";
      EXPECT_LT(off, 1e-5 * scene.cell) << where.name();
      EXPECT_LT(stress, 1e-4 * scale) << where.name();
      EXPECT_LT(now.momentum_error, 1e-7) << where.name();
      EXPECT_NEAR(now.angular_error, exact.angular_error, 1e-7) << where.name() << ": what the time step leaves";
      EXPECT_LT(exact.momentum_error, 1e-12) << "the one in double";
    }
  }
}

/// A free bar between smooth walls that swings along itself as u = A cos(pi x / L) cos(w t), w = pi c / L, with a
/// strain of 1e-6: a particle moves by 1e-5 of a cell or less, and by 1e-8 in a step, 1000 cells from the origin.
struct Swing {
  double period = 0;     ///< measured, over the closed form's
  double amplitude = 0;  ///< of the last swing, over the first one's
};

template <class Real>
Swing swing(LawKind law, StressUpdate update) {
  constexpr double strain = 1e-6, L = 1, h = L / 40, far = 1000 * h;
  Scene s = in<Real>(empty_scene(h, {{far, 0}, {far + L, 4 * h}}, law));
  s.materials[0].nu = 0;
  s.stress_update = update;
  s.bodies = {body("bar", Rectangle{{far, 0}, {far + L, 4 * h}})};
  s.symmetry = {{1, 0, +1}, {1, 4 * h, -1}};
  Probe keep;  // makes the particles remember where they started
  keep.kind = Probe::Kind::displacement;
  s.probes = {keep};
  const double c = std::sqrt(s.materials[0].E / s.materials[0].density), omega = pi * c / L;
  const double amplitude = strain * L / pi;
  const ChosenSpace space;
  SimulationOf<Real> m(s, space);
  auto& p = m.state.particles;
  for (int i = 0; i < p.count(); ++i)
    p.v[0][i] = Real(amplitude * omega * std::cos(pi * (p.x[0][i] - far) / L));
  tally(space, m.plan, m.state);
  // how far the bar has swung: u fitted to the mode
  const auto swung = [&] {
    double sum = 0, norm = 0;
    for (int i = 0; i < p.count(); ++i) {
      const double mode = std::cos(pi * (p.x0[0][i] - far) / L);
      sum += mode * (p.x[0][i] - p.x0[0][i]);
      norm += mode * mode;
    }
    return sum / norm / amplitude;
  };
  double before = 0, most = 0;
  std::vector<double> crossing, peak;
  while (crossing.size() < 11) {
    m.step();
    const double now = swung();
    most = std::max(most, std::abs(now));
    if (before * now < 0) {
      crossing.push_back(m.state.clock.time - m.state.clock.dt * now / (now - before));
      peak.push_back(most);
      most = 0;
    }
    before = now;
  }
  m.take_stock();
  return {(crossing.back() - crossing.front()) / 10 * omega / pi, peak.back() / peak.front()};
}

TEST(Precision, ABarInFloatSwingsAtAStrainOfAMillionth) {
  for (const LawKind law : {LawKind::linear_elastic, LawKind::neo_hookean})
    for (const StressUpdate update : {StressUpdate::usl, StressUpdate::usavg}) {
      const Swing s = swing<float>(law, update), exact = swing<double>(law, update);
      const std::string what = fmt::format("{}, {}: ", name_of(law), name_of(update));
      report(what + "period in float over the closed form's, less 1", s.period - 1, "3e-3");
      report(what + "period in float over that in double, less 1", s.period / exact.period - 1, "1e-6");
      report(what + "last swing in float over the first one's, less 1", s.amplitude - 1, "1e-2");
      EXPECT_NEAR(s.period, 1, 3e-3) << what;
      EXPECT_NEAR(s.period / exact.period, 1, 1e-6) << what;
      EXPECT_NEAR(s.amplitude, exact.amplitude, 1e-4) << what;
      EXPECT_NEAR(s.amplitude, 1, 1e-2) << what;
    }
}

template <class Real>
std::vector<Tip> tips_of_two_cracks() {
  const Scene s = in<Real>(gates::shipped("sent_h_and_v", {"grid.cell=1 mm", "solver.time=0.4 ms"}));
  const exec::Space space(exec::Kind::openmp, 2);
  SimulationOf<Real> m(s, space);
  while (!m.finished())
    m.step();
  m.take_stock();
  return m.state.tips;
}

TEST(Precision, JAndKInFloatAreThoseInDouble) {
  const std::vector<Tip> one = tips_of_two_cracks<float>(), two = tips_of_two_cracks<double>();
  ASSERT_EQ(one.size(), 3u);
  ASSERT_EQ(two.size(), 3u);
  double J = 0, K = 0, off_J = 0, off_K = 0;
  for (size_t k = 0; k < 3; ++k) {
    J = std::max(J, std::abs(two[k].J));
    K = std::max(K, std::hypot(two[k].K_I, two[k].K_II));
    off_J = std::max(off_J, std::abs(one[k].J - two[k].J));
    off_K = std::max(off_K, std::hypot(one[k].K_I - two[k].K_I, one[k].K_II - two[k].K_II));
  }
  EXPECT_GT(J, 10) << "the plate must be loaded for this to prove anything";
  report("two cracks, float beside double: J over the largest", off_J / J, "1e-4");
  report("two cracks, float beside double: K over the largest", off_K / K, "1e-4");
  EXPECT_GT(off_J, 0);
  EXPECT_LT(off_J, 1e-4 * J);
  EXPECT_LT(off_K, 1e-4 * K);
}

template <class Real>
std::vector<CrackEvent> events_of_growth() {
  const Scene s = in<Real>(gates::shipped("collinear_growth", {"grid.cell=1 mm"}));
  const exec::Space space(exec::Kind::openmp, 2);
  SimulationOf<Real> m(s, space);
  const auto open = [](const Tip& t) { return t.open; };
  while (!m.finished() && std::any_of(m.state.tips.begin(), m.state.tips.end(), open))
    m.step();
  m.take_stock();
  return m.state.events;
}

TEST(Precision, CracksInFloatGrowByTheSameEvents) {
  const std::vector<CrackEvent> one = events_of_growth<float>(), two = events_of_growth<double>();
  ASSERT_EQ(one.size(), two.size());
  ASSERT_GE(two.size(), 3u) << "both cracks start, and they meet";
  const double cell = gates::shipped("collinear_growth", {"grid.cell=1 mm"}).cell;
  double late = 0, apart = 0;
  for (size_t k = 0; k < two.size(); ++k) {
    EXPECT_EQ(one[k].kind, two[k].kind);
    EXPECT_EQ(one[k].crack, two[k].crack);
    EXPECT_EQ(one[k].last, two[k].last);
    late = std::max(late, std::abs(one[k].time - two[k].time) / two[k].time);
    apart = std::max(apart, norm(one[k].place - two[k].place));
  }
  report("growth, float beside double: largest difference of an event's time, relative", late, "1e-4");
  report("growth, float beside double: largest distance of an event's place, cells", apart / cell, "0.05");
  EXPECT_LT(late, 1e-4);
  EXPECT_LT(apart, 0.05 * cell);
}

template <class Real>
std::pair<double, double> bytes_of_block(LawKind law) {
  const Scene s = in<Real>(swirling_block(law, StressUpdate::usl));
  const ChosenSpace space;
  const SimulationOf<Real> m(s, space);
  double particles = 0, grid = 0;
  for (const ArrayReport& a : list_arrays(m.state))
    (a.name.rfind("particles", 0) == 0 ? particles : grid) += static_cast<double>(a.bytes);
  const auto n = static_cast<double>(m.state.particles.count());
  return {particles / n, grid / n};
}

/// Two places, two velocities, three stresses, a mass, body and id; det F or F of four: 77 or 101 bytes in double.
TEST(Precision, FloatTakesLessMemory) {
  for (const auto& [law, expected] : {std::pair{LawKind::linear_elastic, 53.}, std::pair{LawKind::neo_hookean, 77.}}) {
    const auto one = bytes_of_block<float>(law), two = bytes_of_block<double>(law);
    EXPECT_NEAR(one.first, expected, 1) << "allocated with some padding";
    EXPECT_NEAR(two.first, expected + 24, 1);
    EXPECT_NEAR(one.second, 0.5 * two.second, 0.01 * two.second) << "nodes hold half as much";
  }
}

TEST(Precision, ResultsOfARunInFloatAreReadAsThoseInDouble) {
  Scene s = in<float>(swirling_block(LawKind::neo_hookean, StressUpdate::usl));
  s.bodies[0].velocity = {0.25, 0};
  s.end_time = 5e-3;
  s.output.frames = 1;
  Probe probe;
  probe.name = "corner";
  probe.kind = Probe::Kind::velocity;
  probe.axis = 0;
  probe.point = {0.5, 0.5};
  s.probes = {probe};
  const ChosenSpace space;
  SimulationOf<float> m(s, space);
  const sample::Folder folder;
  const Summary summary = run_scene(m, {folder.path(), true});
  EXPECT_EQ(summary.precision, "float");
  EXPECT_EQ(summary.status, "done");
  ASSERT_EQ(summary.probes.size(), 1u);
  EXPECT_NEAR(summary.probes[0].value, 0.25, 0.2);
  const PolyData frame = read_vtkhdf(folder.path() / "frames" / "particles_000001.vtkhdf").data;
  ASSERT_EQ(frame.points.size(), 3 * static_cast<size_t>(m.state.particles.count()));
  const auto& p = m.state.particles;
  for (int i = 0; i < p.count(); ++i)
    ASSERT_EQ(frame.points[3 * static_cast<size_t>(p.id[i])], p.x[0][i]);
}

/// What ends a run of a block that flies out of the grid.
template <class Real>
Trouble trouble_of_flight() {
  Scene s = in<Real>(swirling_block(LawKind::linear_elastic, StressUpdate::usl));
  s.bodies[0].velocity = {20, 0};
  s.end_time = 0.1;
  const ChosenSpace space;
  SimulationOf<Real> m(s, space);
  try {
    while (!m.finished())
      m.step();
  } catch (const Error& e) {
    return e.trouble();
  }
  ADD_FAILURE() << "ran without an error";
  return {};
}

TEST(Precision, ARunInFloatStopsForTheReasonOfOneInDouble) {
  const Trouble one = trouble_of_flight<float>(), two = trouble_of_flight<double>();
  EXPECT_EQ(two.what, "a particle left the grid");
  EXPECT_EQ(one.code, two.code);
  EXPECT_EQ(one.what, two.what);
  EXPECT_EQ(one.where, two.where) << "the same particle, step and place";
  EXPECT_EQ(one.limit, two.limit);
  EXPECT_EQ(one.suggestion, two.suggestion);
}

/// A simulation in one precision of a scene that says the other.
TEST(Precision, IsThatOfTheScene) {
  const Scene in_double = swirling_block(LawKind::linear_elastic, StressUpdate::usl), in_float = in<float>(in_double);
  const ChosenSpace space;
  EXPECT_THROW(SimulationOf<float>(in_double, space), Error);
  EXPECT_THROW(Simulation(in_float, space), Error);
}

}  // namespace
}  // namespace riven
