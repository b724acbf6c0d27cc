// The crack patch test: "An algorithm passes the test if the results of the two analyses are numerically identical"
// (J.A. Nairn, CMES 4 (2003) 649-664, section 3.1). Either half of the whole beam, cut by a crack, against that half
// alone with symmetry conditions on the ligament, on one grid, at every step.
#include <array>
#include <cmath>

#include "tests/physics/scene_gates.hpp"

namespace riven {
namespace {

using namespace gates;

constexpr int row = 100, half_rows = 18;  // particles of the beam

/// Largest difference so far between each field of two runs, over the largest value of that field so far.
class Distance {
 public:
  void compare(const Simulation& whole, const Simulation& half, int first_id) {
    const auto &p = whole.state.particles, &q = half.state.particles;
    const std::vector<int> at = by_id(p), to = by_id(q);
    const std::array<std::array<const exec::Array<double>*, 3>, 3> a{
        {{&p.x[0], &p.x[1], nullptr}, {&p.v[0], &p.v[1], nullptr}, {&p.stress[0], &p.stress[1], &p.stress[2]}}};
    const std::array<std::array<const exec::Array<double>*, 3>, 3> b{
        {{&q.x[0], &q.x[1], nullptr}, {&q.v[0], &q.v[1], nullptr}, {&q.stress[0], &q.stress[1], &q.stress[2]}}};
    for (size_t f = 0; f < 3; ++f) {
      double difference = 0;
      for (size_t c = 0; c < 3 && a[f][c]; ++c)
        for (size_t i = 0; i < to.size(); ++i) {
          const double u = (*a[f][c])[at[i + static_cast<size_t>(first_id)]], v = (*b[f][c])[to[i]];
          difference = std::max(difference, std::abs(u - v));
          largest_[f] = std::max(largest_[f], std::abs(v));
        }
      if (largest_[f] > 0)
        worst_ = std::max(worst_, difference / largest_[f]);
    }
  }
  double worst() const { return worst_; }

 private:
  std::array<double, 3> largest_{};
  double worst_ = 0;
};

/// The lower half beam: the mirror image of the scene `dcb_half`.
const std::vector<std::string> lower_half{R"(body.beam.rectangle={lower=["0 mm", "-18 mm"], upper=["100 mm", "0 mm"]})",
                                          R"(load.up.rectangle={lower=["99 mm", "-18 mm"], upper=["100 mm", "0 mm"]})",
                                          "load.up.force_y=-0.4 mN", R"(probe.lift.point=["99.5 mm", "-9.5 mm"])"};

struct Halves {
  double upper, lower;
};

Halves run(exec::Kind kind, ScatterKind scatter, bool node_visibility, double end_time) {
  const exec::Space space(kind, kind == exec::Kind::serial ? 1 : 2);
  Scene scene[3] = {shipped("dcb"), shipped("dcb_half"), shipped("dcb_half", lower_half)};
  for (Scene& s : scene) {
    s.scatter = scatter;
    s.deterministic = scatter == ScatterKind::ordered;
    s.end_time = end_time;
  }
  Simulation whole(scene[0], space), upper(scene[1], space), lower(scene[2], space);
  EXPECT_EQ(whole.state.particles.count(), 2 * half_rows * row);
  EXPECT_EQ(upper.state.particles.count(), half_rows * row);
  if (node_visibility)
    insert_task(whole, "particle to grid", true, [](Simulation& m) {
      Grid<double>& g = m.state.grid;
      for (int n = g.lattice.nodes(); n < g.slots(); ++n) {
        g.mass[n] = 0;
        std::fill_n(g.q.begin() + 4L * n, 4, 0.0);
      }
    });
  Distance of_upper, of_lower;
  while (!whole.finished()) {
    whole.step();
    upper.step();
    lower.step();
    of_upper.compare(whole, upper, half_rows * row);
    of_lower.compare(whole, lower, 0);
  }
  EXPECT_EQ(whole.state.clock.step, upper.state.clock.step);
  return {of_upper.worst(), of_lower.worst()};
}

struct Way {
  exec::Kind kind;
  ScatterKind scatter;
};

class CrackPatchTest : public ::testing::TestWithParam<Way> {};

/// Runs one way and holds both halves to the limit. The whole 250 ms serially, 50 ms elsewhere.
void hold(Way way, double limit) {
  const Halves h = run(way.kind, way.scatter, false, way.kind == exec::Kind::serial ? 0.25 : 0.05);
  const std::string name =
      fmt::format("{}, {} scatter", exec::name(way.kind), way.scatter == ScatterKind::ordered ? "ordered" : "atomic");
  report("crack patch test, upper half, " + name, h.upper, fmt::format("{:g}", limit));
  report("crack patch test, lower half, " + name, h.lower, fmt::format("{:g}", limit));
  EXPECT_LE(h.upper, limit);
  EXPECT_LE(h.lower, limit);
}

TEST_P(CrackPatchTest, EachHalfMovesAsTheHalfModelAtEveryStep) {
  hold(GetParam(), GetParam().scatter == ScatterKind::ordered ? 1e-12 : 1e-9);
}

INSTANTIATE_TEST_SUITE_P(
    Everywhere, CrackPatchTest,
    ::testing::Values(Way{exec::Kind::serial, ScatterKind::ordered}, Way{exec::Kind::serial, ScatterKind::atomic},
                      Way{exec::Kind::openmp, ScatterKind::ordered}, Way{exec::Kind::openmp, ScatterKind::atomic},
                      Way{exec::Kind::stdpar, ScatterKind::ordered}, Way{exec::Kind::stdpar, ScatterKind::atomic}),
    [](const auto& of) {
      return std::string(exec::name(of.param.kind)) +
             (of.param.scatter == ScatterKind::ordered ? "_ordered" : "_atomic");
    });

/// Particles that see a node only when no crack lies between: the control, which must fail.
TEST(CrackPatchTest, NodeVisibilityFails) {
  const Halves h = run(exec::Kind::serial, ScatterKind::ordered, true, 0.02);
  const double worst = std::max(h.upper, h.lower);
  report("crack patch test, node visibility (must fail)", worst, "> 1e-3");
  EXPECT_GT(worst, 1e-3);
}

}  // namespace
}  // namespace riven
