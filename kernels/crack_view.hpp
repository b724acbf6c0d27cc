// Cracks as a kernel sees them.
#pragma once
#include "core/state/cracks.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// See Cracks.
struct CrackView {
  const int *crack, *start;
  const Vec2 *plane, *upper, *lower, *gap;  ///< gap: null where there are none
  int points;

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
