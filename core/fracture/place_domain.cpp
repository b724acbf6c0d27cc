#include "core/fracture/place_domain.hpp"

#include <algorithm>
#include <cmath>

namespace riven {

namespace {

/// How far an edge may be from the tip for q to be 0 at `distance`: a ramp short of it, which is as wide as a cell or,
/// where there is no room for that, as the edge is far. Two cells from either tip if they are four or more apart.
double reach_before(double distance, double h) {
  return distance >= 4 * h ? distance - 2 * h : distance / 2;
}

/// Would q, with edges `reach` away, be more than 0 within half a cell of an offset r, where a tip there acts?
bool inside(Vec2 r, const double reach[4], double h) {
  const auto within = [&](double along, int edge) { return along < reach[edge] + std::min(h, reach[edge]) + 0.5 * h; };
  return within(r.x, right) && within(r.y, top) && within(-r.x, left) && within(-r.y, bottom);
}

}  // namespace

JDomain plain_domain(Vec2 tip, const double reach[4], double h) {
  JDomain d;
  d.tip = tip;
  for (int e = 0; e < 4; ++e) {
    d.reach[e] = reach[e];
    d.ramp[e] = std::min(h, reach[e]);
    d.steep[e] = 1 / d.ramp[e];
  }
  return d;
}

JDomain core_of(const JDomain& d, double far, double h) {
  double reach[4];
  std::transform(d.reach, d.reach + 4, reach, [&](double r) { return std::min(r, far); });
  return plain_domain(d.tip, reach, h);
}

PlacedDomain place_domain(Vec2 tip, const double most[4], double h, const std::vector<Vec2>& others) {
  PlacedDomain placed;
  double reach[4];
  std::copy(most, most + 4, reach);
  std::vector<Vec2> offsets;
  for (const Vec2 other : others)
    if (const Vec2 r = other - tip; inside(r, reach, h))
      offsets.push_back(r);
  // the nearest first: what leaves it out may leave out those behind it
  std::sort(offsets.begin(), offsets.end(), [](Vec2 a, Vec2 b) { return dot(a, a) < dot(b, b); });
  for (const Vec2 r : offsets) {
    if (!inside(r, reach, h))
      continue;
    const double along[4] = {r.x, r.y, -r.x, -r.y};
    const double far = std::max(std::fabs(r.x), std::fabs(r.y));
    if (far < h) {
      placed.in_cell = true;
      continue;
    }
    int best = -1;
    double least = 0;
    for (int e = 0; e < 4; ++e) {
      if (along[e] < h)
        continue;
      const double moved = reach[e] - reach_before(along[e], h);
      if (best < 0 || moved < least) {
        best = e;
        least = moved;
      }
    }
    reach[best] = std::min(reach[best], reach_before(along[best], h));
    placed.adapted = true;
  }
  placed.domain = plain_domain(tip, reach, h);
  return placed;
}

}  // namespace riven
