// How far may a particle and the cracks move before its crossings can change?
//
// Whether a path crosses a crack, and which segment, changes only when the particle or the node passes through the
// crack, or a point of the crack through the path: a tip in any case, a joint if the path crosses this crack (then
// another segment is crossed, or more than one). A joint that comes to touch another path makes two crossings, which
// count as none. So as long as the particle's move plus the crack's stays below the least of these distances, nothing
// changes, and a pair need not be tested again.
#pragma once
#include <algorithm>
#include <cmath>

#include "core/math/vec.hpp"

namespace riven {

/// Squared distance of point q from the segment a-b.
RIVEN_INLINE double distance2(Vec2 q, Vec2 a, Vec2 b) {
  const Vec2 d = b - a, r = q - a;
  const double length2 = dot(d, d);
  const double t = length2 > 0 ? std::min(1.0, std::max(0.0, dot(r, d) / length2)) : 0;
  const Vec2 off = r - t * d;
  return dot(off, off);
}

}  // namespace riven
