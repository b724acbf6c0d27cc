// How far may a particle and the cracks move before its crossings can change?
//
// Whether a path crosses a crack, and from where, changes only when the particle or the node passes through the crack,
// or one of its tips through the path, or where the node comes to lie ahead of an open tip or does so no longer. A
// joint that passes through the path makes two crossings that cancel, or takes the one crossing from a segment to the
// next, which matters only next to a tip of which the node lies ahead. So as long as the particle's move plus the
// crack's stays below the least of these distances, nothing changes, and a pair need not be tested again.
#pragma once
#include <algorithm>
#include <cmath>

#include "core/math/vec.hpp"
#include "core/state/crack_fields.hpp"

namespace riven {

/// Squared distance of point q from the segment a-b.
RIVEN_INLINE double distance2(Vec2 q, Vec2 a, Vec2 b) {
  const Vec2 d = b - a, r = q - a;
  const double length2 = dot(d, d);
  const double t = length2 > 0 ? std::min(1.0, std::max(0.0, dot(r, d) / length2)) : 0;
  const Vec2 off = r - t * d;
  return dot(off, off);
}

/// A move of q, a and b by less than this leaves q on the same side of the line through a and b: their turning is
/// magnified by the distance of q in lengths of a-b.
RIVEN_INLINE double line_clearance(Vec2 q, Vec2 a, Vec2 b) {
  const double length = norm(b - a), far = norm(q - a);
  return length > 0 ? 0.5 * std::fabs(cross(b - a, q - a)) / (length + 2 * far) : 0;
}

/// Sides of a followed node: the signs of the areas of its segments with the node, and that of their turn.
RIVEN_INLINE int pack_sides(int first, int second, int turn) {
  return (first + 1) + 3 * (second + 1) + 9 * (turn + 1);
}
RIVEN_INLINE bool on_line(const NodeClearance& c) {
  return c.sides % 3 == 1 || (c.joined && c.sides / 3 % 3 == 1);
}

/// How far a node is from the segments once the cracks have moved on, m, at least.
RIVEN_INLINE double distance_left(const NodeClearance& c, double travel) {
  return std::max(0., c.measured - (travel - c.travel));
}

}  // namespace riven
