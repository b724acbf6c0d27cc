#include <algorithm>
#include <cmath>

#include "core/scene/scene.hpp"

namespace riven {

namespace {

/// Even-odd rule: a ray to the right crosses the border an odd number of times.
bool inside(const std::vector<Vec2>& p, Vec2 q) {
  bool in = false;
  for (size_t i = 0, j = p.size() - 1; i < p.size(); j = i++)
    if ((p[i].y > q.y) != (p[j].y > q.y) && q.x < (p[j].x - p[i].x) * (q.y - p[i].y) / (p[j].y - p[i].y) + p[i].x)
      in = !in;
  return in;
}

}  // namespace

bool contains(const Region& region, Vec2 q) {
  if (const auto* r = std::get_if<Rectangle>(&region))
    return q.x >= r->lower.x && q.x <= r->upper.x && q.y >= r->lower.y && q.y <= r->upper.y;
  if (const auto* d = std::get_if<Disk>(&region))
    return norm(q - d->center) <= d->radius;
  return inside(std::get<Polygon>(region).points, q);
}

Rectangle bounds(const Region& region) {
  if (const auto* r = std::get_if<Rectangle>(&region))
    return *r;
  if (const auto* d = std::get_if<Disk>(&region)) {
    const Vec2 r{d->radius, d->radius};
    return {d->center - r, d->center + r};
  }
  const auto& p = std::get<Polygon>(region).points;
  Rectangle box{p.front(), p.front()};
  for (Vec2 q : p) {
    box.lower = {std::min(box.lower.x, q.x), std::min(box.lower.y, q.y)};
    box.upper = {std::max(box.upper.x, q.x), std::max(box.upper.y, q.y)};
  }
  return box;
}

}  // namespace riven
