// Fields kept from step to step while a plate runs, against fields found afresh: the moves that the particle kernels
// noticed must be enough to know what has to be traced again.
#include <gtest/gtest.h>

#include <cmath>

#include "kernels/assign_fields.hpp"
#include "kernels/hash_cracks.hpp"
#include "kernels/simulation.hpp"
#include "kernels/sort_particles.hpp"
#include "tests/kernels/crack_scene.hpp"

namespace riven {
namespace {

/// A plate that stretches and turns; its cracks lie on grid lines, along diagonals of cells and askew, and cross.
Scene plate(StressUpdate update) {
  Scene s;
  s.name = s.title = "plate";
  s.end_time = 1;
  s.cell = 1e-3;
  s.grid = {{-4e-3, -4e-3}, {28e-3, 28e-3}};
  s.stress_update = update;
  s.materials.push_back({"solid", LawKind::linear_elastic, 2.5e9, 0.33, 1000});
  Body body;
  body.name = "body";
  body.region = Rectangle{{0, 0}, {24e-3, 24e-3}};
  s.bodies.push_back(body);
  const auto crack = [&](std::vector<Vec2> points) {
    CrackLine c;
    c.name = "crack " + std::to_string(s.cracks.size());
    c.points = std::move(points);
    s.cracks.push_back(c);
  };
  crack({{0, 12e-3}, {13e-3, 12e-3}});
  crack({{6e-3, 4e-3}, {6e-3, 20e-3}});
  crack({{10e-3, 10e-3}, {18e-3, 18e-3}});
  crack({{12.3e-3, 5.1e-3}, {17.9e-3, 7.7e-3}, {20.2e-3, 13.4e-3}});
  s.contact.law = ContactLaw::frictionless;
  return s;
}

void check(StressUpdate update) {
  const Scene scene = plate(update);
  const exec::Space serial;
  Simulation m(scene, serial);
  auto& p = m.state.particles;
  for (long i = 0; i < p.count(); ++i) {
    const double x = p.x[0][i] - 12e-3, y = p.x[1][i] - 12e-3;
    p.v[0][i] = -2500 * y + 5 * std::sin(700 * y);
    p.v[1][i] = 2500 * x + 800 * y;
  }
  long compared = 0, crossing = 0, sorts = 0;
  for (int step = 0; step < 400; ++step) {
    m.step();
    auto& s = m.state;
    sorts += sort_due(m.plan, s);
    if (sort_due(m.plan, s) || hash_due(serial, s.grid.lattice, s.cracks, s.fields))
      continue;
    CrackFields kept = s.fields, fresh;
    determine_fields<UGimp>(serial, p, s.domains.data(), s.grid.lattice, s.cracks, kept, s.watch.tile_move.data());
    hash_cracks<UGimp>(serial, s.grid.lattice, s.cracks, fresh);
    determine_fields<UGimp>(serial, p, s.domains.data(), s.grid.lattice, s.cracks, fresh);
    for (long i = 0; i < p.count(); ++i) {
      ASSERT_EQ(kept.fields[i], fresh.fields[i]) << "particle " << p.id[i] << ", step " << step;
      crossing += fresh.fields[i] != 0;
    }
    for (const NodeCracks& n : fresh.nodes) {
      if (n.crack[0] < 0)
        continue;
      const NodeCracks& k = kept.nodes[kept.node_index[n.node]];
      for (int c = 0; c < most_held; ++c)
        ASSERT_TRUE(n.crack[c] == k.crack[c] && n.side[c] == k.side[c] &&
                    (n.crack[c] < 0 || crack_scene::normals_of(fresh, fresh.node_index[n.node], c) ==
                                           crack_scene::normals_of(kept, kept.node_index[n.node], c)))
            << "node " << n.node << ", step " << step;
    }
    ++compared;
  }
  EXPECT_GT(compared, 300);
  EXPECT_GT(crossing, 100 * compared);
  EXPECT_GT(sorts, 2);
}

TEST(CrackFieldsRunning, AreThoseFoundAfreshWithUsl) {
  check(StressUpdate::usl);
}
TEST(CrackFieldsRunning, AreThoseFoundAfreshWithUsavg) {
  check(StressUpdate::usavg);
}

}  // namespace
}  // namespace riven
