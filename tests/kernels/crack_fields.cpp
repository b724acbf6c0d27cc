// The three passes hash, trace and assign against exact arithmetic and brute force, on random sets of cracks.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <random>

#include "tests/kernels/crack_reference.hpp"

namespace riven {
namespace {

using namespace crack_scene;
using crack_reference::Line;
using crack_reference::Point;

constexpr int cells = 6, per_cell = 64;  // coordinates are whole numbers of 1/64 cell

struct Case {
  std::vector<Line> cracks;
  std::vector<Point> particles;
  long long scale = 1;  ///< coordinates are whole numbers of 1/scale of that
  double unit() const { return 1.0 / double(per_cell * scale); }
  Vec2 real(Point p) const { return {double(p.x) * unit(), double(p.y) * unit()}; }
};

/// Cracks of six kinds in turn, and particles, some of them on cracks and nodes.
Case random_case(int number) {
  std::mt19937_64 random(static_cast<std::uint64_t>(number));
  const auto pick = [&](long long low, long long high) {
    return std::uniform_int_distribution<long long>(low, high)(random);
  };
  constexpr long long edge = cells * per_cell;
  const auto anywhere = [&] { return Point{pick(20, edge - 20), pick(20, edge - 20)}; };
  const auto on_node = [&] { return Point{per_cell * pick(1, cells - 1), per_cell * pick(1, cells - 1)}; };
  Case c;
  const long long count = pick(1, 4);
  for (long long n = 0; n < count; ++n) {
    Line line;
    switch ((number + n) % 6) {
      case 0:  // kinks
        line.push_back(anywhere());
        for (long long k = pick(1, 6); k > 0; --k)
          line.push_back({line.back().x + pick(-60, 60), line.back().y + pick(-60, 60)});
        break;
      case 1: {  // on a grid line, with joints and tips on nodes and between them
        const long long y = per_cell * pick(1, cells - 1), piece = std::array{16, 32, 64, 96}[pick(0, 3)];
        const long long x = pick(0, 1) ? per_cell * pick(1, 3) : pick(30, 200);
        for (long long k = 0, pieces = pick(1, 5); k <= pieces; ++k)
          line.push_back({x + k * piece, y});
        if (pick(0, 1))
          for (Point& p : line)
            std::swap(p.x, p.y);
        break;
      }
      case 2:  // from node to node, the second part turning
        line = {on_node(), on_node()};
        if (pick(0, 1))
          line.push_back(on_node());
        break;
      case 3: {  // zig-zag of period 0.7 cells
        const long long x = pick(20, 150), y = pick(100, 250), height = pick(4, 40);
        for (long long k = 0; k <= 8; ++k)
          line.push_back({x + k * 22, y + (k % 2) * height});
        break;
      }
      case 4:  // two long cracks that may cross
        line = {anywhere(), anywhere()};
        break;
      default:  // a coarse lattice, to meet many ties; lines may fold back
        for (long long k = pick(2, 5); k > 0; --k)
          line.push_back({16 * pick(2, 22), 16 * pick(2, 22)});
    }
    for (Point& p : line)
      p = {std::clamp(p.x, 1ll, edge - 1), std::clamp(p.y, 1ll, edge - 1)};
    line.erase(std::unique(line.begin(), line.end()), line.end());
    if (line.size() > 1)
      c.cracks.push_back(line);
  }
  if (c.cracks.empty())
    c.cracks.push_back({{100, 100}, {200, 130}});
  for (int k = 0; k < 40; ++k)
    c.particles.push_back({16 * pick(2, 22) + 8 * pick(0, 1), 16 * pick(2, 22)});
  for (int k = 0; k < 30; ++k)
    c.particles.push_back(anywhere());
  for (const Line& line : c.cracks) {
    c.particles.push_back(line[static_cast<size_t>(pick(0, static_cast<long long>(line.size()) - 1))]);
    c.particles.push_back({(line[0].x + line[1].x) / 2, (line[0].y + line[1].y) / 2});
  }
  c.particles.push_back(on_node());
  return c;
}

std::vector<Vec2> positions(const Case& c) {
  std::vector<Vec2> x;
  for (Point p : c.particles)
    x.push_back(c.real(p));
  return x;
}

Cracks cracks_of(const Case& c) {
  std::vector<std::vector<Vec2>> lines;
  for (const Line& line : c.cracks) {
    lines.emplace_back();
    for (Point p : line)
      lines.back().push_back(c.real(p));
  }
  return crack_scene::cracks_of(lines);
}

std::vector<std::uint32_t> words_by_id(const Particles<double, 2>& p, const CrackFields& f) {
  std::vector<std::uint32_t> words(static_cast<size_t>(p.count()));
  for (long i = 0; i < p.count(); ++i)
    words[static_cast<size_t>(p.id[i])] = f.fields[i];
  return words;
}

/// Differences from the reference, as text; empty when there are none.
template <class Shape>
std::string compare(const Lattice& l, const Case& c, const Particles<double, 2>& p, const CrackFields& f,
                    const long (&before)[2]) {
  const long long corner = -Lattice::ghosts * per_cell * c.scale;
  const Point origin{corner, corner};
  const auto exact = crack_reference::determine<Shape>(l, quarter_cells(l), c.particles, c.cracks, c.unit(), origin);
  const auto words = words_by_id(p, f);
  for (size_t id = 0; id < words.size(); ++id)
    if (words[id] != exact.word[id])
      return "particle " + std::to_string(id) + " at " + std::to_string(c.particles[id].x) + ", " +
             std::to_string(c.particles[id].y) + ": " + std::to_string(words[id]) + ", exactly " +
             std::to_string(exact.word[id]);
  const long warnings[2] = {f.warning_both_sides - before[0], f.warning_fourth_crack - before[1]};
  for (int kind = 0; kind < 2; ++kind) {
    if (warnings[kind] != exact.warning[kind])
      return "warnings of kind " + std::to_string(kind + 1);
    if (before[kind] == 0 && warnings[kind] > 0 && !(f.warning_place[kind] == exact.first[kind]))
      return "place of warning " + std::to_string(kind + 1);
  }
  size_t held = 0;
  for (const NodeCracks& n : f.nodes) {
    if (n.crack[0] < 0)
      continue;
    ++held;
    const auto it = exact.node.find(n.node);
    if (it == exact.node.end())
      return "node " + std::to_string(n.node) + " holds a crack that it should not";
    const auto& e = it->second;
    const long flagged = f.node_index[n.node];
    const int candidates = f.candidate_start[flagged + 1] - f.candidate_start[flagged];
    for (int k = 0; k < most_held; ++k) {
      const auto m = static_cast<size_t>(k);
      if ((n.crack[m] >= 0) != (m < e.crack.size()))
        return "number of cracks of node " + std::to_string(n.node);
      if (n.crack[m] < 0)
        continue;
      if (n.crack[m] != e.crack[m] || n.side[m] != e.side[m])
        return "crack or side of node " + std::to_string(n.node);
      // one point for each piece of up to 0.6 cells: off the integral by 0.044 at most on these sets, whose kinks are
      // sharp
      const double length = norm(e.normal[m]);
      const Vec2 normal = normals_of(f, flagged, k)[0];
      if (length > 0.3 && norm(normal - e.normal[m] * (1 / length)) > 0.06)
        return "normal of node " + std::to_string(n.node) + " off by " +
               std::to_string(norm(normal - e.normal[m] * (1 / length)));
      if (std::fabs(norm(normal) - 1) > 1e-12)
        return "length of the normal of node " + std::to_string(n.node);
      if (k >= candidates)
        return "no slots for crack " + std::to_string(k) + " of node " + std::to_string(n.node);
    }
  }
  return held == exact.node.size() ? "" : "nodes that hold cracks";
}

template <class Shape>
void run(const exec::Space& space, const Lattice& l, const Particles<double, 2>& p, const Cracks& cracks,
         CrackFields& f, const double* tile_move = nullptr) {
  const auto domain = quarter_cells(l);
  if (hash_due(space, l, cracks, f))
    hash_cracks<Shape>(space, l, cracks, f);
  determine_fields<Shape>(space, p, &domain, l, cracks, f, tile_move);
}

/// Checks one case, then with all cracks moved by less than the hash's margin, so that an old hash serves.
template <class Shape>
std::string check(const exec::Space& space, int number, long (&seen)[3]) {
  Case c = random_case(number);
  const Lattice l = unit_cells(cells, cells);
  const auto p = sorted_particles<Shape>(l, positions(c), in_order(c.particles.size()));
  Cracks cracks = cracks_of(c);
  CrackFields f;
  run<Shape>(space, l, p, cracks, f);
  if (std::string s = compare<Shape>(l, c, p, f, {0, 0}); !s.empty())
    return s;
  const long before[2] = {f.warning_both_sides, f.warning_fourth_crack};
  std::mt19937_64 random(static_cast<std::uint64_t>(number));
  long k = 0;
  for (Line& line : c.cracks)
    for (Point& at : line) {
      at.x += static_cast<long long>(random() % 31) - 15;
      at.y += static_cast<long long>(random() % 31) - 15;
      cracks.plane[k++] = c.real(at);
    }
  if (hash_due(space, l, cracks, f))
    return "hash due within its margin";
  run<Shape>(space, l, p, cracks, f);
  if (std::string s = compare<Shape>(l, c, p, f, before); !s.empty())
    return "moved: " + s;
  cracks.plane[0].x += 0.75;
  if (!hash_due(space, l, cracks, f))
    return "hash not due beyond its margin";
  seen[0] += f.warning_both_sides;
  seen[1] += f.warning_fourth_crack;
  for (const std::uint8_t held : f.held)
    seen[2] += held == most_held;
  return "";
}

template <class Shape>
void check_all(int first) {
  const exec::Space serial;
  long seen[3] = {0, 0, 0};
  for (int number = first; number < 10000; number += 3) {
    const std::string wrong = check<Shape>(serial, number, seen);
    ASSERT_EQ(wrong, "") << "crack set " << number;
  }
  EXPECT_GT(seen[0], 1000);  // the sets reach the cases that the warnings are about
  EXPECT_GT(seen[1], 100);
  EXPECT_GT(seen[2], 1000);  // nodes with three cracks
}

// 10,000 crack sets, each with an old and a fresh hash, shared among the shape functions
TEST(CrackFields, EqualExactParityOnRandomCracksLinear) {
  check_all<Linear>(0);
}
TEST(CrackFields, EqualExactParityOnRandomCracksUGimp) {
  check_all<UGimp>(1);
}
TEST(CrackFields, EqualExactParityOnRandomCracksBSpline) {
  check_all<BSpline>(2);
}

TEST(CrackFields, EqualExactParityNextToTies) {
  // the same sets, all coordinates off by less than single precision tells apart
  const exec::Space serial;
  const Lattice l = unit_cells(cells, cells);
  for (int number = 0; number < 2000; ++number) {
    Case c = random_case(number);
    c.scale = 1ll << 26;
    std::mt19937_64 random(static_cast<std::uint64_t>(number));
    const auto off = [&](Point& p) {
      p = {p.x * c.scale + static_cast<long long>(random() % 5) - 2,
           p.y * c.scale + static_cast<long long>(random() % 5) - 2};
    };
    for (Line& line : c.cracks)
      for (Point& p : line)
        off(p);
    for (Point& p : c.particles)
      off(p);
    const auto p = sorted_particles<UGimp>(l, positions(c), in_order(c.particles.size()));
    CrackFields f;
    run<UGimp>(serial, l, p, cracks_of(c), f);
    ASSERT_EQ(compare<UGimp>(l, c, p, f, {0, 0}), "") << "crack set " << number;
  }
}

TEST(CrackFields, NormalsFollowACurvedCrack) {
  // a circle of radius R in segments of half a cell: its normals are radial, and the mean of B over the crack keeps
  // that to second order in the angle under which the cell is seen from the centre
  const Lattice l = unit_cells(24, 24);
  const Vec2 centre{12.1, 11.7};
  std::vector<Vec2> particles;
  particles.reserve(48L * 48);
  for (int j = 0; j < 48; ++j)
    for (int i = 0; i < 48; ++i)
      particles.push_back({0.5 * i + 0.25, 0.5 * j + 0.25});
  const auto p = sorted_particles<UGimp>(l, particles, in_order(particles.size()));
  double worst[2];
  for (int k = 0; k < 2; ++k) {
    const double R = 4 * (k + 1), step = 0.5 / R;
    std::vector<Vec2> arc;
    for (double angle = -2; angle <= 2; angle += step)
      arc.push_back(centre + R * Vec2{std::cos(angle), std::sin(angle)});
    const Cracks cracks = crack_scene::cracks_of({arc});
    CrackFields f;
    run<UGimp>(exec::Space(), l, p, cracks, f);
    worst[k] = 0;
    int held = 0;
    for (const NodeCracks& n : f.nodes) {
      const Vec2 r = l.position(n.node) - centre;
      if (n.crack[0] < 0 || std::fabs(std::atan2(r.y, r.x)) > 2 - 2 / R)  // away from the tips
        continue;
      ++held;
      const Vec2 normal = f.normals[f.node_index[n.node]].now[0];
      EXPECT_NEAR(norm(normal), 1, 1e-14);
      worst[k] = std::max(worst[k], norm(normal - r * (1 / norm(r))));
    }
    EXPECT_GT(held, 20);
  }
  EXPECT_LT(worst[0], 0.03 / 4);
  EXPECT_LT(worst[1], 0.03 / 8);
}

bool same_nodes(const CrackFields& a, const CrackFields& b) {
  if (a.nodes.size() != b.nodes.size())
    return false;
  for (long f = 0; f < a.nodes.size(); ++f) {
    const NodeCracks &x = a.nodes[f], &y = b.nodes[f];
    if (x.node != y.node)
      return false;
    for (int m = 0; m < most_held; ++m)
      if (x.crack[m] != y.crack[m] || x.side[m] != y.side[m] ||
          (x.crack[m] >= 0 && normals_of(a, f, m) != normals_of(b, f, m)))
        return false;
  }
  return true;
}

TEST(CrackFields, DoNotDependOnOrderThreadsOrSpace) {
  struct Where {
    exec::Kind kind;
    int threads;
  };
  const Lattice l = unit_cells(cells, cells);
  for (const Where where : {Where{exec::Kind::serial, 1}, Where{exec::Kind::openmp, 1}, Where{exec::Kind::openmp, 2},
                            Where{exec::Kind::openmp, 4}, Where{exec::Kind::stdpar, 1}, Where{exec::Kind::stdpar, 2},
                            Where{exec::Kind::stdpar, 4}}) {
    const exec::Space serial, space(where.kind, where.threads);
    for (int number = 0; number < 36; ++number) {
      const Case c = random_case(number);
      const Cracks cracks = cracks_of(c);
      std::vector<int> ids = in_order(c.particles.size());
      const auto p = sorted_particles<UGimp>(l, positions(c), ids);
      std::shuffle(ids.begin(), ids.end(), std::mt19937(static_cast<unsigned>(number)));
      const auto q = sorted_particles<UGimp>(l, positions(c), ids);
      CrackFields a, b;
      run<UGimp>(serial, l, p, cracks, a);
      run<UGimp>(space, l, q, cracks, b);
      ASSERT_EQ(words_by_id(p, a), words_by_id(q, b)) << number;
      ASSERT_TRUE(same_nodes(a, b)) << number;
      ASSERT_EQ(a.warning_both_sides, b.warning_both_sides);
      ASSERT_EQ(a.warning_fourth_crack, b.warning_fourth_crack);
      ASSERT_TRUE(a.warning_place[0] == b.warning_place[0] && a.warning_place[1] == b.warning_place[1]);
      ASSERT_EQ(a.extra_slots, b.extra_slots);
      for (int n = 0; n < l.nodes(); ++n)
        ASSERT_EQ(a.extra[n], b.extra[n]);
    }
  }
}

template <class Shape>
void check_memory() {
  // many small moves, some of them with particles sorted anew; fields found afresh must be the same bits
  const Lattice l = unit_cells(cells, cells);
  const exec::Space serial;
  long remembered = 0, crossing = 0;
  for (int number = 0; number < 150; ++number) {
    const Case c = random_case(number);
    Cracks cracks = cracks_of(c);
    std::vector<Vec2> x = positions(c);
    std::vector<int> ids = in_order(x.size());
    std::mt19937 random(static_cast<unsigned>(number));
    const double size = std::array{0.0003, 0.003, 0.03}[static_cast<size_t>(number % 3)];
    std::uniform_real_distribution<double> any(-size, size);
    CrackFields f;
    auto p = sorted_particles<Shape>(l, x, ids);
    exec::Array<double> tile_move(l.tiles_x() * l.tiles_y());
    const bool moves_known = number % 2 == 0;
    for (int step = 0; step < 20; ++step) {
      run<Shape>(serial, l, p, cracks, f, moves_known ? tile_move.data() : nullptr);
      CrackFields fresh;
      run<Shape>(serial, l, p, cracks, fresh);
      ASSERT_EQ(words_by_id(p, f), words_by_id(p, fresh)) << number << ", step " << step;
      for (const NodeCracks& n : f.nodes) {
        if (n.crack[0] < 0)
          continue;
        const NodeCracks& m = fresh.nodes[fresh.node_index[n.node]];
        for (int k = 0; k < most_held; ++k)
          ASSERT_TRUE(n.crack[k] == m.crack[k] && n.side[k] == m.side[k] &&
                      (n.crack[k] < 0 ||
                       normals_of(f, f.node_index[n.node], k) == normals_of(fresh, fresh.node_index[n.node], k)));
      }
      crack_scene::each_known(f, p.tiles, [&](int i, const CrossingMemory& m) {
        if (m.known != Known::nowhere && !(m.x == Vec2{p.x[0][i], p.x[1][i]})) {
          ++remembered;
          crossing += m.count > 0;
        }
      });
      std::vector<Vec2> moves(x.size());
      for (Vec2& move : moves)
        move = {any(random), any(random)};
      for (size_t id = 0; id < x.size(); ++id)
        x[id] += moves[id];
      for (Vec2& at : cracks.plane)
        at += Vec2{any(random), any(random)} * 0.5;
      if (step % 7 == 6) {
        std::shuffle(ids.begin(), ids.end(), random);
        p = sorted_particles<Shape>(l, x, ids);
        continue;
      }
      for (int t = 0; t < l.tiles_x() * l.tiles_y(); ++t) {
        tile_move[t] = 0;
        for (int i = p.tiles.start[t]; i < p.tiles.start[t + 1]; ++i) {
          const size_t id = static_cast<size_t>(p.id[i]);
          p.x[0][i] = x[id].x;
          p.x[1][i] = x[id].y;
          tile_move[t] = std::max({tile_move[t], std::fabs(moves[id].x), std::fabs(moves[id].y)});
        }
      }
    }
  }
  EXPECT_GT(remembered, 20000);
  EXPECT_GT(crossing, 2000);
}

TEST(CrackFields, RememberedAreThoseFoundAfresh) {
  check_memory<Linear>();
  check_memory<UGimp>();
  check_memory<BSpline>();
}

TEST(CrackFields, AreClearedWhenParticlesMoveAway) {
  const Lattice l = unit_cells(16, 16);
  const exec::Space serial;
  const Cracks cracks = crack_scene::cracks_of({{{2, 3.3}, {6, 3.4}}});
  std::vector<Vec2> x{{3.3, 3.6}, {4.2, 3.1}, {12.1, 12.2}};
  auto p = sorted_particles<UGimp>(l, x, in_order(3));
  CrackFields f;
  run<UGimp>(serial, l, p, cracks, f);
  EXPECT_NE(words_by_id(p, f)[0], 0u);
  EXPECT_NE(words_by_id(p, f)[1], 0u);
  EXPECT_EQ(words_by_id(p, f)[2], 0u);
  x[0] = {14.1, 13.2};
  p = sorted_particles<UGimp>(l, x, {2, 1, 0});
  run<UGimp>(serial, l, p, cracks, f);
  EXPECT_EQ(words_by_id(p, f)[0], 0u);
  EXPECT_NE(words_by_id(p, f)[1], 0u);
  EXPECT_EQ(words_by_id(p, f)[2], 0u);
}

TEST(CrackFields, AreClearedWhenACrackJumpsAway) {
  const Lattice l = unit_cells(32, 32);
  const exec::Space serial;
  Cracks cracks = crack_scene::cracks_of({{{2, 3.3}, {6, 3.4}}, {{18, 4}, {22, 4.2}}});
  const std::vector<Vec2> x{{3.3, 3.6}, {3.3, 20.6}, {20.2, 4.3}, {4.2, 20.1}};
  const auto p = sorted_particles<UGimp>(l, x, in_order(x.size()));
  exec::Array<double> at_rest(l.tiles_x() * l.tiles_y());
  CrackFields f;
  run<UGimp>(serial, l, p, cracks, f, at_rest.data());
  const std::vector<std::uint32_t> before = words_by_id(p, f);
  EXPECT_NE(before[0], 0u);
  EXPECT_EQ(before[1], 0u);
  EXPECT_NE(before[2], 0u);
  EXPECT_EQ(before[3], 0u);
  const auto jump = [&](double dy) {
    for (int k = cracks.start[0]; k < cracks.start[1]; ++k)
      cracks.plane[k].y += dy;
    run<UGimp>(serial, l, p, cracks, f, at_rest.data());
  };
  jump(17);  // into tiles that no crack was in
  const std::vector<std::uint32_t> after = words_by_id(p, f);
  EXPECT_EQ(after[0], 0u);
  EXPECT_NE(after[1], 0u);
  EXPECT_EQ(after[2], before[2]);
  EXPECT_NE(after[3], 0u);
  jump(-17);
  EXPECT_EQ(words_by_id(p, f), before);
}

TEST(CrackFields, OfACrackOnAGridLineSplitTheNodesOnIt) {
  // joints on every node and between them: particles above cross to the nodes on the line, those below do not
  const Lattice l = unit_cells(8, 8);
  const exec::Space serial;
  const Cracks cracks = crack_scene::cracks_of({{{0, 4}, {8, 4}}}, 0.5);
  std::vector<Vec2> x;
  for (int j = 0; j < 16; ++j)
    for (int i = 0; i < 16; ++i)
      x.push_back({0.25 + 0.5 * i, 0.25 + 0.5 * j});
  const auto p = sorted_particles<UGimp>(l, x, in_order(x.size()));
  CrackFields f;
  run<UGimp>(serial, l, p, cracks, f);
  const auto domain = quarter_cells(l);
  for (long i = 0; i < p.count(); ++i) {
    const auto ax = UGimp::axis(p.x[0][i] - l.origin.x, domain.axis[0]);
    const auto ay = UGimp::axis(p.x[1][i] - l.origin.y, domain.axis[1]);
    for (int k = 0; k < 9; ++k) {
      if (ax.s[k % 3] == 0 || ay.s[k / 3] == 0)
        continue;
      const Vec2 node = l.position(ax.base + k % 3, ay.base + k / 3);
      if (node.x < 0 || node.x > 8)
        continue;
      const bool across = p.x[1][i] > 4 ? node.y <= 4 : node.y > 4;
      ASSERT_EQ(CrackFields::field_of(f.fields[i], k), across ? 1 : 0) << p.x[0][i] << ' ' << p.x[1][i] << ' ' << k;
    }
  }
}

}  // namespace
}  // namespace riven
