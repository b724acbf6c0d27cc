#include "core/state/lay_points.hpp"

#include <algorithm>
#include <cmath>

namespace riven {

std::vector<Vec2> lay_points(const Region& region, const std::vector<Region>& holes, const Lattice& lattice,
                             int per_cell) {
  const double d = lattice.h / per_cell;
  const Rectangle box = bounds(region);
  const auto first = [&](double x, double origin) { return static_cast<long>(std::floor((x - origin) / d)) - 1; };
  const auto last = [&](double x, double origin) { return static_cast<long>(std::ceil((x - origin) / d)) + 1; };
  std::vector<Vec2> points;
  for (long j = first(box.lower.y, lattice.origin.y); j <= last(box.upper.y, lattice.origin.y); ++j)
    for (long i = first(box.lower.x, lattice.origin.x); i <= last(box.upper.x, lattice.origin.x); ++i) {
      const Vec2 p{lattice.origin.x + (static_cast<double>(i) + 0.5) * d,
                   lattice.origin.y + (static_cast<double>(j) + 0.5) * d};
      const auto in = [&](const Region& r) { return contains(r, p); };
      if (in(region) && std::none_of(holes.begin(), holes.end(), in))
        points.push_back(p);
    }
  return points;
}

}  // namespace riven
