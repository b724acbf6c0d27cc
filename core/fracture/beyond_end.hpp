// A crack that ends on another one, its host, as seen from behind the host.
//
// Where a crack ends on a host, three parts of the solid meet: two before the host, left and right of the crack, and
// one behind it. A path from a part before the host to a node behind it may lead over the host on either side of the
// crack's end, and crosses the crack or not by nothing but that: both parts before would share a field there, and hold
// the faces of the crack together at its mouth. So to a path that comes over the host from where the crack lies, the
// crack goes on straight beyond its end: it is crossed by paths from one of the parts and by none from the other.
// Paths that do not cross the host, or come from behind it, see the crack as it is.
#pragma once
#include "core/fracture/crossing.hpp"
#include "core/math/vec.hpp"
#include "core/state/crack_fields.hpp"

namespace riven {

/// Cells beyond an end on a host up to which paths look for the crack, and for which it is crossed: more than any path
/// needs that has it in sight.
inline constexpr double seen_beyond = 2, crossed_beyond = 6;

/// The line on which a crack goes on beyond one of its ends.
struct BeyondEnd {
  Vec2 before, end, far;  ///< the crack's last points on the way there, and where the line ends
  bool last;              ///< of the crack's ends

  /// `at`: the crack's point at that end. `reach`: m, from there to where the line ends.
  RIVEN_INLINE BeyondEnd(const Vec2* at, bool is_last, double reach)
      : before(at[is_last ? -1 : 1]), end(*at), last(is_last) {
    const Vec2 on = end - before;
    const double length = norm(on);
    far = length > 0 ? end + (reach / length) * on : end;
  }

  /// As `crossing` of a segment of the crack.
  RIVEN_INLINE int crossed(Vec2 p, Vec2 n) const {
    const Vec2 onward[3] = {before, end, far}, back[2] = {far, end};
    return last ? crossing(p, n, onward + 1, false, true) : crossing(p, n, back, true, false);
  }
};

}  // namespace riven
