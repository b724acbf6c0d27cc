// A crack as the paths between particles and nodes see it: a little ahead of its open tips, those that end in the
// solid.
//
// Paths tell nodes with a field for each side of a crack from those without, and the former end it: to the grid a crack
// ends with the last node that it parts, wherever its tip lies between that node and the next. Where a node has both
// sides, bridge_tips.hpp lets them part by as much as the place of the tip asks for, and for that needs nodes that lie
// up to `seen_ahead` cells ahead.
// An end that leaves the solid or has joined another crack is not open: there every path around it would be a leak.
// Scenes that ask for nothing at tips see all ends where they are.
#pragma once
#include "core/state/cracks.hpp"

namespace riven {

/// Cells.
inline constexpr double seen_ahead = 0.4;

/// Where paths see a point of a crack on cells of h.
inline Vec2 seen_point(const Cracks& cracks, int point, double h) {
  const int crack = cracks.crack[point];
  for (const bool last : {false, true})
    if (point == cracks.end_point(crack, last) && cracks.is_open(crack, last)) {
      const Vec2 ahead = cracks.plane[point] - cracks.plane[cracks.next_to_end(crack, last)];
      const double length = norm(ahead);
      return length > 0 ? cracks.plane[point] + (seen_ahead * h / length) * ahead : cracks.plane[point];
    }
  return cracks.plane[point];
}

}  // namespace riven
