#include "core/state/draw_mouths.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/state/make_tips.hpp"

namespace riven {

namespace {

constexpr double beyond = 2, near = 1, over_wall = 0.01;  ///< cells
constexpr int samples = 64;                               ///< of a cell, at which solid is looked for

/// How far it is from x along `way` (of unit length) to where there is solid, or none, m; nothing within `reach`.
std::optional<double> way_to(const Scene& s, bool solid, Vec2 x, Vec2 way, double reach) {
  const int count = static_cast<int>(std::lround(reach / s.cell * samples));
  for (int k = 1; k <= count; ++k)
    if ((body_at(s, x + (k * reach / count) * way) >= 0) == solid)
      return k * reach / count;
  return std::nullopt;
}

/// How far it is from x to where the grid ends, and `over_wall` on, m.
double way_in_grid(const Scene& s, Vec2 x, Vec2 way) {
  double least = std::numeric_limits<double>::infinity();
  const auto axis = [&](double at, double along, double lower, double upper) {
    if (along != 0)
      least = std::min(least, ((along > 0 ? upper : lower) - at) / along + over_wall * s.cell / std::abs(along));
  };
  axis(x.x, way.x, s.grid.lower.x, s.grid.upper.x);
  axis(x.y, way.y, s.grid.lower.y, s.grid.upper.y);
  return std::max(0., least);
}

/// How far an end goes on, m.
double way_on(const Scene& s, size_t crack, bool last, Vec2 x, Vec2 way) {
  const double h = s.cell;
  double out = 0;
  switch (end_of(s, crack, last)) {
    case CrackEnd::mouth:
      if (const auto d = way_to(s, false, x, way, beyond * h))
        out = *d;
      else
        return 0;  // it runs along the edge
      break;
    case CrackEnd::outside:
      if (const auto d = way_to(s, true, x, -1. * way, near * (1 - 1e-9) * h))
        out = -*d;
      else
        return 0;
      break;
    default: return 0;
  }
  const double from = std::max(0., out), far = out + beyond * h;
  const auto ahead = way_to(s, true, x + from * way, way, far - from);
  return std::min(ahead ? from + 0.5 * *ahead : far, way_in_grid(s, x, way));
}

}  // namespace

Scene draw_mouths(Scene scene) {
  const Scene drawn = scene;
  for (size_t c = 0; c < scene.cracks.size(); ++c)
    for (const bool last : {false, true}) {
      std::vector<Vec2>& points = scene.cracks[c].points;
      const Vec2 x = last ? points.back() : points.front();
      const auto differs = [&](Vec2 p) { return norm(p - x) > 0; };
      if (std::none_of(points.begin(), points.end(), differs))
        continue;  // it has no length, which is refused where it is laid
      const Vec2 before = last ? *std::find_if(points.rbegin(), points.rend(), differs)
                               : *std::find_if(points.begin(), points.end(), differs);
      const Vec2 step = x - before, way = (1 / norm(step)) * step;
      if (const double on = way_on(drawn, c, last, x, way); on > 0)
        points.insert(last ? points.end() : points.begin(), x + on * way);
    }
  return scene;
}

}  // namespace riven
