#include "core/state/cracks.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/error.hpp"

namespace riven {

namespace {

double distance(Vec2 x, Vec2 a, Vec2 b) {
  const Vec2 d = b - a;
  const double square = dot(d, d), along = square > 0 ? std::clamp(dot(x - a, d) / square, 0., 1.) : 0;
  return norm(x - a - along * d);
}

/// A line of many more points than the grid can tell apart, as one that was traced from an image, without those that
/// lie on it as nearly as an end of another crack must (D.H. Douglas and T.K. Peucker, Cartographica 10 (1973)
/// 112-122): each costs as much as a point that means something, and more, as each looks at its neighbours.
std::vector<Vec2> thinned(const std::vector<Vec2>& line, double cell) {
  constexpr double crowded = 0.125, near = 5e-4;  // cells
  double length = 0;
  for (size_t k = 1; k < line.size(); ++k)
    length += norm(line[k] - line[k - 1]);
  if (line.size() < 3 || length > crowded * cell * static_cast<double>(line.size()))
    return line;
  std::vector<bool> kept(line.size());
  kept.front() = kept.back() = true;
  std::vector<std::pair<size_t, size_t>> open{{0, line.size() - 1}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    size_t farthest = first;
    double far = near * cell;
    for (size_t k = first + 1; k < last; ++k)
      if (const double off = distance(line[k], line[first], line[last]); off > far) {
        far = off;
        farthest = k;
      }
    if (farthest == first)
      continue;
    kept[farthest] = true;
    open.insert(open.end(), {{first, farthest}, {farthest, last}});
  }
  std::vector<Vec2> points;
  for (size_t k = 0; k < line.size(); ++k)
    if (kept[k])
      points.push_back(line[k]);
  return points;
}

/// The points of one line, cut. Points that repeat the one before are dropped.
std::vector<Vec2> cut(const CrackLine& line, double resolution, double cell) {
  std::vector<Vec2> points;
  for (Vec2 to : thinned(line.points, cell)) {
    if (points.empty()) {
      points.push_back(to);
      continue;
    }
    const Vec2 from = points.back();
    const double length = norm(to - from);
    if (length == 0)
      continue;
    // the small allowance keeps a length that is a whole number of pieces but for rounding from an extra piece
    const int pieces = std::max(1, static_cast<int>(std::ceil(length / resolution * (1 - 1e-9))));
    for (int i = 1; i < pieces; ++i)
      points.push_back(from + (double(i) / pieces) * (to - from));
    points.push_back(to);
  }
  return points;
}

}  // namespace

Cracks make_cracks(const Scene& scene, double default_resolution) {
  Cracks cracks;
  std::vector<Vec2> all;
  std::vector<int> owner;
  for (const CrackLine& line : scene.cracks) {
    const std::vector<Vec2> points = cut(line, line.resolution > 0 ? line.resolution : default_resolution, scene.cell);
    if (points.size() < 2)
      fail({.code = Exit::bad_input,
            .what = "a crack has no length",
            .where = place(scene, "crack " + line.name),
            .value = {},
            .limit = "two points or more that differ",
            .suggestion = {}});
    all.insert(all.end(), points.begin(), points.end());
    owner.insert(owner.end(), points.size(), cracks.count());
    cracks.names.push_back(line.name);
    cracks.contact.resize(cracks.count());
    cracks.contact[cracks.count() - 1] = line.contact.value_or(scene.contact);
    cracks.start.resize(cracks.count() + 1);
    cracks.start[cracks.count()] = static_cast<int>(all.size());
  }
  const long n = static_cast<long>(all.size());
  for (auto* a : {&cracks.plane, &cracks.upper, &cracks.lower, &cracks.plane0}) {
    a->resize(n);
    std::copy(all.begin(), all.end(), a->begin());
  }
  cracks.crack.resize(n);
  cracks.serial.resize(n);
  std::iota(cracks.serial.begin(), cracks.serial.end(), 0);
  cracks.open.resize(2 * cracks.count());
  std::copy(owner.begin(), owner.end(), cracks.crack.begin());
  if (scene.surface_update == SurfaceUpdate::xpic) {
    cracks.upper_velocity.resize(n);
    cracks.lower_velocity.resize(n);
  }
  return cracks;
}

}  // namespace riven
