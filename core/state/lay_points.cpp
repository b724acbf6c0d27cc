#include "core/state/lay_points.hpp"

#include <algorithm>
#include <cmath>

namespace riven {

namespace {

constexpr double tie = 1e-6;  ///< particles: what is nearer to an edge lies on it

}  // namespace

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
      // particles on an edge belong to what is to its right, or above, so that opposite edges do not both take them
      const Vec2 beside = p + tie * d * Vec2{1, 0.7};
      const auto in = [&](const Region& r) { return contains(r, std::holds_alternative<Disk>(r) ? p : beside); };
      if (in(region) && std::none_of(holes.begin(), holes.end(), in))
        points.push_back(p);
    }
  return points;
}

double least_particle_distance(const Scene& scene) {
  double least = scene.cell;
  for (const Body& b : scene.bodies)
    least = std::min(least, scene.cell / b.particles_per_cell);
  return least;
}

}  // namespace riven
