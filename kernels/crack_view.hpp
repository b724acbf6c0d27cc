// Cracks as a kernel sees them.
#pragma once
#include <limits>

#include "core/state/cracks.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// See Cracks.
struct CrackView {
  const int *crack, *start;
  const Vec2 *plane, *upper, *lower;
  const Vec2* gap;  ///< null where there are none
  int points;

  /// From the surfaces of point k to the faces of solids beside them at first, above (x) and below (y), m.
  RIVEN_INLINE Vec2 to_faces(long k) const {
    constexpr double most = std::numeric_limits<double>::max();
    const Vec2 g = gap ? gap[k] : Vec2{};
    return {g.x < most ? g.x : 0, g.y < most ? g.y : 0};
  }
  RIVEN_INLINE int end_point(int c, bool last) const { return last ? start[c + 1] - 1 : start[c]; }
  RIVEN_INLINE int next_to_end(int c, bool last) const { return end_point(c, last) + (last ? -1 : 1); }
};

inline CrackView crack_view(const Cracks& c) {
  return {exec::data(c.crack), exec::data(c.start), exec::data(c.plane),
          exec::data(c.upper), exec::data(c.lower), c.gap.empty() ? nullptr : exec::data(c.gap),
          c.points()};
}

}  // namespace RIVEN_SIDE

}  // namespace riven
