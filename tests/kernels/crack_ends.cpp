// Velocity fields around the end of a crack that lies on another one (beyond_end.hpp).
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "core/fracture/beyond_end.hpp"
#include "core/state/junctions.hpp"
#include "kernels/contact_meetings.hpp"
#include "tests/kernels/crack_scene.hpp"

namespace riven {
namespace {

using namespace crack_scene;

constexpr int cells = 12;

/// A crack that ends somewhere on another one, its host, at any angle, and particles, three along an axis of a cell.
struct Tee {
  Cracks cracks;
  Vec2 place;       ///< of the end, cells
  Vec2 host, ways;  ///< unit vectors along the host, and along the crack away from its end
  std::vector<Vec2> particles;

  explicit Tee(int number) {
    std::mt19937 random(static_cast<unsigned>(number));
    const auto pick = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    const bool on_lines = number % 4 == 0;  // of the grid
    place = on_lines ? Vec2{6, 6} : Vec2{pick(5, 7), pick(5, 7)};
    const double angle = on_lines ? number / 4 % 4 * std::acos(0.) : pick(0, 6.3),
                 between = on_lines ? 1.5707963267948966 : pick(0.7, 2.4);
    host = {std::round(std::cos(angle) * 1e12) / 1e12, std::round(std::sin(angle) * 1e12) / 1e12};
    ways = std::cos(between) * host + (number % 2 ? 1 : -1) * std::sin(between) * turned(host);
    if (on_lines)
      ways = {std::round(ways.x), std::round(ways.y)};
    std::vector<std::vector<Vec2>> lines{{place - 4.5 * host, place + 4.3 * host}, {place, place + 4.4 * ways}};
    const bool last = number / 2 % 2, second = number / 3 % 2;
    if (last)
      std::swap(lines[1][0], lines[1][1]);
    if (!second)
      std::swap(lines[0], lines[1]);
    cracks = cracks_of(lines, 0.5);
    const int on = second ? 0 : 1;
    const double along = 4.5 / 8.8 * (cracks.start[on + 1] - cracks.start[on] - 1);
    cracks.junctions.push_back({1 - on, last, on, static_cast<int>(along), along - std::floor(along)});
    tie_junctions(cracks, 1);
    for (int j = 0; j < 3 * (cells - 4); ++j)
      for (int i = 0; i < 3 * (cells - 4); ++i)
        particles.push_back({2 + (i + pick(0, 1)) / 3, 2 + (j + pick(0, 1)) / 3});
  }

  /// 0: behind the host; 1, 2: before it, on either side of the crack.
  int part(Vec2 x) const {
    const Vec2 r = x - place;
    if (cross(host, r) * cross(host, ways) < 0)
      return 0;
    return cross(ways, r) > 0 ? 1 : 2;
  }
};

template <class Shape>
void find(const Lattice& l, const Particles<double, 2>& p, const Cracks& cracks, CrackFields& f,
          const double* tile_move = nullptr) {
  const exec::Space serial;
  const auto domain = quarter_cells(l);
  if (hash_due(serial, l, cracks, f))
    hash_cracks<Shape>(serial, l, cracks, f);
  determine_fields<Shape>(serial, p, &domain, l, cracks, f, tile_move);
}

template <class Shape>
void check_parts() {
  const Lattice l = unit_cells(cells, cells);
  const auto domain = quarter_cells(l);
  long behind = 0, all_three = 0;
  for (int number = 0; number < 80; ++number) {
    const Tee tee(number);
    const auto p = sorted_particles<Shape>(l, tee.particles, in_order(tee.particles.size()));
    CrackFields f;
    find<Shape>(l, p, tee.cracks, f);
    std::map<std::pair<int, int>, std::array<Vec2, 3>> seen;  // node and field: a particle of each part
    std::map<std::pair<int, int>, unsigned> parts;
    for (int k = 0; k < p.count(); ++k) {
      const Vec2 x{p.x[0][k], p.x[1][k]};
      const Vec2 X = x - l.origin;
      const auto ax = Shape::axis(X.x, domain.axis[0]), ay = Shape::axis(X.y, domain.axis[1]);
      for (int n = 0; n < Shape::width * Shape::width; ++n) {
        const int i = ax.base + n % Shape::width, j = ay.base + n / Shape::width;
        if (ax.s[n % Shape::width] == 0 || ay.s[n / Shape::width] == 0 || norm(l.position(i, j) - tee.place) > 1.5)
          continue;
        const std::pair at{j * l.nx + i, CrackFields::field_of(f.fields[k], n)};
        seen[at][static_cast<size_t>(tee.part(x))] = x;
        parts[at] |= 1u << tee.part(x);
      }
    }
    for (const auto& [at, mask] : parts)
      EXPECT_TRUE(mask == 1 || mask == 2 || mask == 4)
          << "scene " << number << ": parts " << mask << " share field " << at.second << " of node " << at.first % l.nx
          << ", " << at.first / l.nx;
    for (const NodeCracks& n : f.nodes) {
      if (n.behind == 0)
        continue;
      ++behind;
      const Vec2 x = l.position(n.node);
      EXPECT_TRUE(tee.part(x) == 0 || std::fabs(cross(tee.host, x - tee.place)) < 1e-9) << "scene " << number;
      all_three += parts.count({n.node, n.host()}) && parts.count({n.node, n.host() + n.ending()});
    }
    EXPECT_EQ(f.warning_both_sides, 0) << "scene " << number;
  }
  EXPECT_GT(behind, 80);
  EXPECT_GT(all_three, 60);
}

TEST(CrackEnds, PartTheSolidInThreeForNodesBehindTheHost) {
  check_parts<Linear>();
  check_parts<UGimp>();
  check_parts<BSpline>();
}

/// Fields that are kept while particles and cracks move are those found afresh.
TEST(CrackEnds, AreSeenByMovingParticlesAsAfresh) {
  const Lattice l = unit_cells(cells, cells);
  long kept = 0, turned = 0;
  for (int number = 0; number < 40; ++number) {
    Tee tee(number);
    std::mt19937 random(static_cast<unsigned>(number));
    const double size = std::array{0.0003, 0.003, 0.02}[static_cast<size_t>(number % 3)];
    std::uniform_real_distribution<double> any(-size, size);
    auto p = sorted_particles<UGimp>(l, tee.particles, in_order(tee.particles.size()));
    exec::Array<double> tile_move(l.tiles_x() * l.tiles_y());
    CrackFields f;
    std::vector<std::uint32_t> before(tee.particles.size());
    for (int step = 0; step < 30; ++step) {
      find<UGimp>(l, p, tee.cracks, f, tile_move.data());
      CrackFields fresh;
      find<UGimp>(l, p, tee.cracks, fresh);
      for (long k = 0; k < p.count(); ++k) {
        ASSERT_EQ(f.fields[k], fresh.fields[k]) << number << ", step " << step;
        std::uint32_t& was = before[static_cast<size_t>(k)];
        turned += step > 0 && was != f.fields[k];
        was = f.fields[k];
      }
      for (const NodeCracks& n : f.nodes)
        ASSERT_EQ(n.behind, fresh.nodes[fresh.node_index[n.node]].behind) << number << ", step " << step;
      each_known(f, p.tiles, [&](int k, const CrossingMemory& m) {
        kept += m.count > 0 && !(m.x == Vec2{p.x[0][k], p.x[1][k]});
      });
      tile_move.zero();
      for (int t = 0; t < l.tiles_x() * l.tiles_y(); ++t)
        for (int k = p.tiles.start[t]; k < p.tiles.start[t + 1]; ++k) {
          const Vec2 move{any(random), any(random)};
          p.x[0][k] += move.x;
          p.x[1][k] += move.y;
          tile_move[t] = std::max({tile_move[t], std::fabs(move.x), std::fabs(move.y)});
        }
      for (Vec2& at : tee.cracks.plane)
        at += 0.5 * Vec2{any(random), any(random)};
      tie_junctions(tee.cracks, 1);
    }
  }
  EXPECT_GT(kept, 20000);
  EXPECT_GT(turned, 100);
}

/// Both parts before the host press on what is behind it, across the host, and on each other across the crack.
TEST(CrackEnds, LetBothPartsMeetTheOneBehind) {
  const NodeNormals normals{{{0, -1}, {1, 0}}, {{0, -1}, {1, 0}}};
  const ContactSettings laws[2] = {{ContactLaw::frictionless}, {ContactLaw::coulomb, 0.3}};
  for (const int host : {0, 1}) {
    NodeCracks n;
    n.crack[0] = 0;
    n.crack[1] = 1;
    n.side[0] = n.side[1] = Side::above;
    n.behind = static_cast<std::uint8_t>(1 + host + most_held * (1 - host));
    ASSERT_EQ(n.host(), 1 << host);
    ASSERT_EQ(n.ending(), 1 << (1 - host));
    double mass[4] = {1, 0, 0, 2};
    mass[n.host()] = 3;
    const auto count = [&](int above, int below) {
      int found = 0;
      for (const Meeting& m : find_meetings<2>(n, {&normals, nullptr}, mass, laws))
        found += m.above == above && m.below == below && m.k == (m.above == 3 && m.below != 0 ? 1 - host : host) &&
                 m.normal == normals.now[m.k];
      return found;
    };
    EXPECT_EQ(find_meetings<2>(n, {&normals, nullptr}, mass, laws).count, 3);
    EXPECT_EQ(count(n.host(), 0), 1);
    EXPECT_EQ(count(3, 0), 1);
    EXPECT_EQ(count(3, n.host()), 1);
    mass[n.host()] = 0;  // without the one part, the other still meets what is behind by the host's law and normal
    EXPECT_EQ(find_meetings<2>(n, {&normals, nullptr}, mass, laws).count, 1);
    EXPECT_EQ(count(3, 0), 1);
  }
}

}  // namespace
}  // namespace riven
