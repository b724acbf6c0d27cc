#include "core/scene/area.hpp"

#include <cmath>
#include <numbers>

namespace riven {

double area_of(const Region& region) {
  if (const auto* r = std::get_if<Rectangle>(&region))
    return (r->upper.x - r->lower.x) * (r->upper.y - r->lower.y);
  if (const auto* d = std::get_if<Disk>(&region))
    return std::numbers::pi * d->radius * d->radius;
  const auto& p = std::get<Polygon>(region).points;
  double twice = 0;
  for (size_t i = 0, j = p.size() - 1; i < p.size(); j = i++)
    twice += cross(p[j], p[i]);
  return 0.5 * std::abs(twice);
}

double area_of(const Body& body) {
  double solid = area_of(body.region);
  for (const Region& hole : body.holes)
    solid -= area_of(hole);
  return solid > 0 ? solid : 0;
}

}  // namespace riven
