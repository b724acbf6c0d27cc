// Crack velocity fields by exact arithmetic and brute force: every particle, every node, every crack.
//
// Coordinates are whole numbers of a small unit. Unlike the kernels, which read signs of areas segment by segment, this
// finds where the path meets the open segments and the points of a crack:
//   - an open segment met inside of the path is one crossing, and so is one met at its node, coming from above;
//   - a point of the crack inside of the path: a tip is none; at a joint, each of its two segments that leads to the
//     negative side of the path is one;
//   - a point of the crack at the node is one crossing, if a segment that joins it is not in line with the particle,
//     and the first such has it above;
//   - a particle inside of an open segment, or on a joint, crosses to what lies below that segment, or below the one
//     that ends at the joint.
#pragma once
#include <map>
#include <set>
#include <vector>

#include "tests/kernels/crack_scene.hpp"

namespace riven::crack_reference {

__extension__ using Wide = __int128;

struct Point {
  long long x, y;
  bool operator==(const Point&) const = default;
};
using Line = std::vector<Point>;

inline Wide area(Point a, Point b, Point c) {
  return Wide(b.x - a.x) * (c.y - a.y) - Wide(b.y - a.y) * (c.x - a.x);
}
inline int sign(Wide a) {
  return (a > 0) - (a < 0);
}

struct Sum {
  int count = 0, net = 0;
  void cross(Point a, Point b, Point p) {
    ++count;
    net += area(a, b, p) < 0 ? -1 : 1;
  }
  Side side() const { return count % 2 == 0 ? Side::none : net > 0 ? Side::above : Side::below; }
};

/// Fraction num / den along the path, as its place: outside, inside or at the node.
enum class Place { outside, inside, node };
inline Place place(Wide num, Wide den) {
  if (den < 0)
    num = -num, den = -den;
  return num <= 0 || num > den ? Place::outside : num == den ? Place::node : Place::inside;
}

inline Sum trace(const Line& line, Point p, Point n) {
  Sum sum;
  if (p == n)
    return sum;
  for (size_t k = 0; k + 1 < line.size(); ++k) {
    const Point a = line[k], b = line[k + 1];
    const Wide from = area(a, b, p), to = area(a, b, n), den = from - to;
    const bool within = Wide(p.x - a.x) * (b.x - p.x) + Wide(p.y - a.y) * (b.y - p.y) > 0;
    if (from == 0 && within && to < 0)
      sum.cross(a, b, p);
    if (den == 0 || place(from, den) == Place::outside || (to == 0 && from < 0))
      continue;
    const Wide left = area(p, n, a), right = area(p, n, b);
    if (sign(left) * sign(right) < 0)
      sum.cross(a, b, p);
  }
  const Wide length2 = Wide(n.x - p.x) * (n.x - p.x) + Wide(n.y - p.y) * (n.y - p.y);
  for (size_t k = 0; k < line.size(); ++k) {
    const Point v = line[k];
    if (area(p, n, v) != 0)
      continue;
    const Wide along = Wide(v.x - p.x) * (n.x - p.x) + Wide(v.y - p.y) * (n.y - p.y);
    const Place at = place(along, length2);
    const bool before = k > 0, after = k + 1 < line.size();
    if (at == Place::inside && before && after) {
      if (area(p, n, line[k - 1]) < 0)
        sum.cross(line[k - 1], v, p);
      if (area(p, n, line[k + 1]) < 0)
        sum.cross(v, line[k + 1], p);
    } else if (at == Place::node) {
      if (before && area(line[k - 1], v, p) != 0) {
        if (area(line[k - 1], v, p) > 0)
          sum.cross(line[k - 1], v, p);
      } else if (after && area(v, line[k + 1], p) > 0) {
        sum.cross(v, line[k + 1], p);
      }
    } else if (v == p && before && after && area(line[k - 1], v, n) < 0) {
      sum.cross(line[k - 1], v, p);
    }
  }
  return sum;
}

/// Normal of a crack at node n, from above to below: the integral of n B over all of the crack, in steps of a hundredth
/// of a cell, which are `step` units long. 0 where the crack does not come within one and a half cells along each axis.
inline Vec2 mean_normal(const Line& line, Point n, long long step) {
  const auto B = [](double r) {
    r = std::fabs(r);
    return r < 0.5 ? 0.75 - r * r : r < 1.5 ? 0.5 * (1.5 - r) * (1.5 - r) : 0;
  };
  Vec2 sum;
  for (size_t k = 0; k + 1 < line.size(); ++k) {
    const Vec2 a{double(line[k].x - n.x) / double(step), double(line[k].y - n.y) / double(step)};
    const Vec2 b{double(line[k + 1].x - n.x) / double(step), double(line[k + 1].y - n.y) / double(step)};
    const Vec2 d = b - a;
    const int pieces = static_cast<int>(std::ceil(100 * norm(d)));
    for (int i = 0; i < pieces; ++i) {
      const Vec2 x = a + ((i + 0.5) / pieces) * d;
      sum += (B(x.x) * B(x.y) / pieces) * Vec2{d.y, -d.x};
    }
  }
  return sum;
}

struct Node {
  std::vector<int> crack;
  std::vector<Side> side;
  std::vector<Vec2> normal;
};

struct Fields {
  std::vector<std::uint32_t> word;  ///< by particle id
  std::map<int, Node> node;         ///< nodes with crossings
  long warning[2] = {0, 0};
  Vec2 first[2];
};

/// `unit`: length of one coordinate unit. Node (0, 0) of the lattice has coordinates `origin`.
template <class Shape>
Fields determine(const Lattice& l, const DomainSetting<double, 2>& domain, const std::vector<Point>& particles,
                 const std::vector<Line>& cracks, double unit, Point origin) {
  struct Pair {
    int id, neighbour, node, crack;
    Sum sum;
  };
  const long long step = static_cast<long long>(l.h / unit);
  std::vector<Pair> pairs;
  std::map<int, std::map<int, std::array<int, 2>>> counts;  // node, crack: from above, from below
  for (int id = 0; id < static_cast<int>(particles.size()); ++id) {
    const Point p = particles[static_cast<size_t>(id)];
    const auto ax = Shape::axis(double(p.x - origin.x) * unit / l.h, domain.axis[0]);
    const auto ay = Shape::axis(double(p.y - origin.y) * unit / l.h, domain.axis[1]);
    for (int k = 0; k < Shape::width * Shape::width; ++k) {
      const int i = ax.base + k % Shape::width, j = ay.base + k / Shape::width;
      if (ax.s[k % Shape::width] == 0 || ay.s[k / Shape::width] == 0)
        continue;
      for (int c = 0; c < static_cast<int>(cracks.size()); ++c) {
        const Sum sum = trace(cracks[static_cast<size_t>(c)], p, {origin.x + i * step, origin.y + j * step});
        if (sum.side() == Side::none)
          continue;
        pairs.push_back({id, k, j * l.nx + i, c, sum});
        ++counts[j * l.nx + i][c][sum.side() == Side::below];
      }
    }
  }
  Fields out;
  out.word.resize(particles.size());
  for (const auto& [node, by_crack] : counts) {
    std::vector<std::pair<int, int>> most;  // minus crossings, crack
    for (const auto& [crack, n] : by_crack)
      most.push_back({-n[0] - n[1], crack});
    std::sort(most.begin(), most.end());
    most.resize(std::min<size_t>(most_held, most.size()));
    std::set<int> held;
    for (const auto& m : most)
      held.insert(m.second);
    Node& to = out.node[node];
    for (int crack : held) {
      const auto& n = by_crack.at(crack);
      to.crack.push_back(crack);
      to.side.push_back(n[0] >= n[1] ? Side::above : Side::below);
      const long long at = node % l.nx, row = node / l.nx;
      to.normal.push_back(
          mean_normal(cracks[static_cast<size_t>(crack)], {origin.x + at * step, origin.y + row * step}, step));
    }
  }
  for (const Pair& pair : pairs) {
    const Node& node = out.node[pair.node];
    const auto it = std::find(node.crack.begin(), node.crack.end(), pair.crack);
    const size_t m = static_cast<size_t>(it - node.crack.begin());
    if (it != node.crack.end() && node.side[m] == pair.sum.side()) {
      out.word[static_cast<size_t>(pair.id)] |= (1u << m) << (CrackFields::bits * pair.neighbour);
      continue;
    }
    const int kind = it == node.crack.end();
    if (out.warning[kind]++ == 0)
      out.first[kind] = l.position(pair.node);
  }
  return out;
}

}  // namespace riven::crack_reference
