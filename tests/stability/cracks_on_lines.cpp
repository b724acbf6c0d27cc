// Cracks where ties have to be broken: on a row of nodes, on a row of particles, and through the corners of cells.
#include <array>
#include <random>

#include "core/fracture/crossing.hpp"
#include "io/crack_opening.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/particle_to_grid.hpp"
#include "tests/kernels/crack_reference.hpp"
#include "tests/spaces.hpp"
#include "tests/stability/gates.hpp"

namespace riven {
namespace {

using namespace test;
using namespace hard_cases;

/// A beam of 16 x 8 cells whose arms are pulled apart at the end where its crack opens, by forces that rise in 50
/// steps.
Scene cantilevers(double h, double offset, ContactLaw law) {
  Scene s = empty_scene(h, {{-8 * h, -12 * h}, {24 * h, 12 * h}});
  s.bodies = {body("beam", Rectangle{{0, -4 * h}, {16 * h, 4 * h}})};
  s.contact.law = law;
  s.cracks = {crack("middle", {{-h, offset * h}, {8.3 * h, offset * h}})};
  for (const double side : {-1., 1.}) {
    Load pull;
    pull.name = side < 0 ? "down" : "up";
    pull.region = side < 0 ? Rectangle{{0, -4 * h}, {h, 0}} : Rectangle{{0, 0}, {h, 4 * h}};
    pull.value[1] = TimeFunction{side * 2e3 * h, [h](double t) { return std::min(1., t / h); }, ""};
    s.loads.push_back(pull);
  }
  return s;
}

/// Places, velocities and stresses, by id.
std::vector<std::vector<double>> fields_of(const Simulation& m) {
  const auto& p = m.state.particles;
  std::vector<std::vector<double>> all;
  for (const auto* a : {&p.x[0], &p.x[1], &p.v[0], &p.v[1], &p.stress[0], &p.stress[1], &p.stress[2]}) {
    all.emplace_back(static_cast<size_t>(p.count()));
    for (int i = 0; i < p.count(); ++i)
      all.back()[static_cast<size_t>(p.id[i])] = (*a)[i];
  }
  return all;
}

double largest_difference(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b) {
  double most = 0;
  for (size_t f = 0; f < a.size(); ++f) {
    double apart = 0, size = 0;
    for (size_t i = 0; i < a[f].size(); ++i) {
      apart = std::max(apart, std::abs(a[f][i] - b[f][i]));
      size = std::max(size, std::abs(a[f][i]));
    }
    most = std::max(most, apart / size);
  }
  return most;
}

struct Opened {
  std::vector<std::vector<double>> fields;
  double opening = 0;   ///< of the mouth, cells
  long both_sides = 0;  ///< pairs of particle and node on the wrong side of the node
};

Opened open(double h, double offset, ContactLaw law) {
  const Scene s = cantilevers(h, offset, law);
  const ChosenSpace space;
  Simulation m(s, space);
  Account account(m);
  run(m, account, 300, 50);
  Opened r{fields_of(m), extreme_opening(m.scene, m.state.cracks, 0) / h, m.state.fields.warning_both_sides};
  EXPECT_LT(account.momentum, 1e-12);
  return r;
}

TEST(CrackOnNodes, IsTheSameAtAnyOffsetThatRoundingMakes) {
  for (const double h : {0.125, 0.1})
    for (const ContactLaw law : {ContactLaw::ignored, ContactLaw::frictionless}) {
      const Opened on = open(h, 0, law);
      double apart = 0;
      long both_sides = on.both_sides;
      for (const double offset : {1e-16, 1e-12, 1e-6})
        for (const double sign : {-1., 1.}) {
          const Opened r = open(h, sign * offset, law);
          apart = std::max(apart, largest_difference(on.fields, r.fields));
          both_sides += r.both_sides;
        }
      const std::string row = "crack on nodes, cells of " + fmt::format("{} m, contact {}", h, name_of(law));
      above(row + ": opening of the mouth, cells", on.opening, 0.01);
      below(row + ": fields at offsets of 1e-16 to 1e-6 cells", apart, 1e-9);
      below(row + ": pairs on both sides of their node", static_cast<double>(both_sides), 1);
    }
}

/// Which of the eight rows of the table of signs (core/fracture/crossing.hpp), four from above and four from below, the
/// paths from particles to nodes of a scene meet.
std::array<long, 8> signs_met(const Simulation& m) {
  using Signs = std::array<int, 4>;
  constexpr std::array<Signs, 4> above{Signs{-1, 1, 1, -1}, Signs{-1, 1, 1, 0}, Signs{0, 1, 1, 0}, Signs{-1, 0, 1, 0}};
  std::array<long, 8> met{};
  const auto& p = m.state.particles;
  const Lattice& l = m.state.grid.lattice;
  const Cracks& c = m.state.cracks;
  for (int i = 0; i < p.count(); ++i) {
    const Vec2 x{p.x[0][i], p.x[1][i]};
    const auto a = UGimp::axis((x.x - l.origin.x) / l.h, m.state.domains[0].axis[0]);
    const auto b = UGimp::axis((x.y - l.origin.y) / l.h, m.state.domains[0].axis[1]);
    for (int n = 0; n < 9; ++n)
      for (int k = 0; k + 1 < c.points(); ++k) {
        const Vec2 node = l.position(a.base + n % 3, b.base + n / 3), from = c.plane[k], to = c.plane[k + 1];
        const Signs s{orientation(x, node, from), orientation(x, node, to), orientation(from, to, x),
                      orientation(from, to, node)};
        for (size_t row = 0; row < 4; ++row) {
          Signs mirrored = above[row];
          for (int& sign : mirrored)
            sign = -sign;
          met[row] += s == above[row];
          met[4 + row] += s == mirrored;
        }
      }
  }
  return met;
}

/// With the crack on a row of nodes, and with it just off one, so that both tables are gone through.
TEST(CrackOnNodes, MeetsAllPatternsOfSigns) {
  const ChosenSpace space;
  Scene s = cantilevers(0.125, 0, ContactLaw::ignored);
  s.cracks[0].points[1].x = 8 * s.cell;
  const Scene off = cantilevers(0.125, 0.3, ContactLaw::ignored);
  const Simulation on_nodes(s, space), between(off, space);
  const auto on = signs_met(on_nodes), beside = signs_met(between);
  double met = 0;
  for (size_t k = 0; k < 8; ++k)
    met += on[k] + beside[k] > 0;
  above("crack on nodes: patterns of signs met, of 8", met, 7.5);
}

/// Of particles that lie on the crack: how many take nodes on both sides of it as theirs, or take the other side than
/// the rest.
long undecided(const Simulation& m) {
  const auto& p = m.state.particles;
  const Lattice& l = m.state.grid.lattice;
  const double y = m.state.cracks.plane[0].y;
  long wrong = 0, seen = 0;
  int side_of_all = 0;
  for (int i = 0; i < p.count(); ++i) {
    if (p.x[1][i] != y || p.x[0][i] > 7 * l.h)
      continue;
    const auto a = UGimp::axis((p.x[0][i] - l.origin.x) / l.h, m.state.domains[0].axis[0]);
    const auto b = UGimp::axis((p.x[1][i] - l.origin.y) / l.h, m.state.domains[0].axis[1]);
    int crossed[2] = {0, 0}, own[2] = {0, 0};
    for (int n = 0; n < 9; ++n) {
      if (a.s[n % 3] * b.s[n / 3] == 0)
        continue;
      const bool above = l.position(0, b.base + n / 3).y > y;
      (CrackFields::field_of(m.state.fields.fields[i], n) != 0 ? crossed : own)[above] += 1;
    }
    ++seen;
    const int side = own[1] > 0 ? 1 : -1;
    wrong += (own[0] > 0 && own[1] > 0) || (crossed[0] > 0 && crossed[1] > 0) || crossed[0] + crossed[1] == 0;
    if (side_of_all == 0)
      side_of_all = side;
    wrong += side != side_of_all;
  }
  EXPECT_GT(seen, 10);
  return wrong;
}

TEST(CrackThroughParticles, HasAParticleOnOneSide) {
  const double h = 0.125;
  for (const double row : {-0.25, 0.25}) {
    const Scene s = cantilevers(h, row, ContactLaw::frictionless);
    const ChosenSpace space;
    Simulation m(s, space);
    Account account(m);
    long wrong = -1;
    gates::insert_task(m, "determine fields", true, [&](Simulation& sim) {
      if (wrong < 0)
        wrong = undecided(sim);
    });
    m.step();
    const std::string name = fmt::format("crack through the particles at {} cells", row);
    below(name + ": particles on both sides", static_cast<double>(wrong), 1);
    run(m, account, 299, 50);
    above(name + ": opening of the mouth, cells", extreme_opening(m.scene, m.state.cracks, 0) / h, 0.01);
    expect_kept(name, account, m);
  }
}

/// Zig-zags of period 0.7 cells through corners and edges of cells, against exact arithmetic; and no force, nor
/// momentum, where there is no mass.
TEST(ZigZag, HasTheFieldsOfExactArithmetic) {
  using crack_reference::Line;
  using crack_reference::Point;
  constexpr long long cell = 1024;
  constexpr int cells = 8;
  const Lattice l = crack_scene::unit_cells(cells, cells);
  const Point origin{-Lattice::ghosts * cell, -Lattice::ghosts * cell};
  std::mt19937 random(1);
  const auto pick = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  long wrong = 0, crossing = 0;
  for (int set = 0; set < 200; ++set) {
    const long long x = 128 * pick(6, 9), y = 128 * pick(24, 40), height = 64 * pick(1, 20), slope = 64 * pick(-5, 5);
    Line line;
    for (int k = 0; k < 18; ++k)  // half a period of 0.35 cells
      line.push_back({x + k * 358, y + (k % 2) * height + k * slope / 4});
    if (set % 2 == 1)
      for (Point& p : line)
        std::swap(p.x, p.y);
    std::vector<Point> particles;
    std::vector<Vec2> places, points;
    for (int j = 0; j < 2 * cells; ++j)
      for (int i = 0; i < 2 * cells; ++i) {
        particles.push_back({cell / 4 + i * cell / 2, cell / 4 + j * cell / 2});
        places.push_back({0.25 + 0.5 * i, 0.25 + 0.5 * j});
      }
    points.reserve(line.size());
    for (const Point p : line)
      points.push_back({double(p.x) / cell, double(p.y) / cell});
    const auto p = crack_scene::sorted_particles<UGimp>(l, places, crack_scene::in_order(places.size()));
    const Cracks cracks = crack_scene::cracks_of({points});
    const auto domain = crack_scene::quarter_cells(l);
    const ChosenSpace space;
    CrackFields f;
    hash_cracks<UGimp>(space, l, cracks, f);
    determine_fields<UGimp>(space, p, &domain, l, cracks, f);
    const auto exact = crack_reference::determine<UGimp>(l, domain, particles, {line}, 1. / cell, origin);
    for (int i = 0; i < p.count(); ++i) {
      wrong += f.fields[i] != exact.word[static_cast<size_t>(p.id[i])];
      crossing += f.fields[i] != 0;
    }
  }
  EXPECT_GT(crossing, 1000);
  below("zig-zag, period 0.7 cells, 200 sets: particles with other fields than exact", static_cast<double>(wrong), 1);
}

TEST(ZigZag, LeavesNoFieldWithoutMass) {
  const double h = 0.125;
  Scene s = cantilevers(h, 0, ContactLaw::frictionless);
  s.cracks[0].points.clear();
  for (int k = 0; k < 24; ++k)
    s.cracks[0].points.push_back({(-1 + 0.35 * k) * h, (k % 2 ? 0.35 : -0.35) * h});
  const ChosenSpace space;
  Simulation m(s, space);
  Account account(m);
  double orphans = 0;
  gates::insert_task(m, "stress before, forces", true, [&](Simulation& sim) {
    const Grid<double>& g = sim.state.grid;
    for (int n = 0; n < g.slots(); ++n)
      for (int k = 0; k < 4; ++k)
        orphans += !(g.mass[n] > 0) && g.q[4 * n + k] != 0;
  });
  run(m, account, 1000);
  below("zig-zag, 1000 steps: fields without mass that bear a force", orphans, 1);
  above("zig-zag, 1000 steps: opening of the mouth, cells", extreme_opening(m.scene, m.state.cracks, 0) / h, 0.01);
  expect_kept("zig-zag, 1000 steps", account, m);
}

/// A block that expands until it just reaches a node next to a crack beside it: forces there move next to no mass.
TEST(CrackBesideABody, StaysWhereItIs) {
  Scene s = empty_scene(1, {{-6, -6}, {16, 16}});
  s.bodies = {body("block", Rectangle{{0, 0}, {8, 8}})};
  s.cracks = {crack("beside", {{9.125, 2.3}, {10, 5.4}})};
  const ChosenSpace space;
  Simulation m(s, space);
  auto& p = m.state.particles;
  for (int i = 0; i < p.count(); ++i)
    p.v[0][i] = 1e-4 * (p.x[0][i] - 4);
  double most = 0;
  for (int n = 0; n < 100; ++n) {
    m.step();
    const Cracks& c = m.state.cracks;
    for (int k = 0; k < c.points(); ++k)
      most = std::max(most, norm(c.plane[k] - c.plane0[k]));
  }
  below("crack beside a body that barely reaches its nodes: farthest move, cells", most, 0.01);
}

}  // namespace
}  // namespace riven
