// A crack as the paths between particles and nodes see it: drawn back from its open tips, those that end in the solid.
//
// A node that has a field for each side of a crack acts by its shape functions on material ahead of it: to the grid a
// crack ends some 0.85 cells beyond the last node that it parts. At rest that is 0.15 cells short of the end of the
// paths to 0.85 beyond it, as that end lies in its cell; and where a stressed solid moves across the grid by a cell or
// more it is the most, whatever the way, since each place of the end relaxes what it can. Drawn back by about the mean,
// a crack has its own length to within half a cell at rest and moving. Without, J of an edge crack with 2.5 mm of the
// plate left, on cells of 0.5 mm, came 4 % higher for a move by one cell; cells of half the size halve that.
//
// A tip on a node, or where paths from particles to nodes happen to meet, as on a line of the grid, ties with many of
// them at once; and once particles and tip have moved, however little, such paths pass behind it on one face of the
// crack and before it on the other. What is held together across the crack's line is then not symmetric about it, and
// mode II leaks into mode I: with a tip on a node 18 % of it, at any load. So
//   - the length is such that the ends of tips at simple fractions of a cell are on no tie;
//   - a node in the zone around the end lies ahead of the tip: no path to it crosses the crack in that zone. Without, a
//     node that is a little off the crack's line and about as far ahead of the end or behind it is crossed on one side
//     alone. Between a node all of whose paths from one side cross, and one none of whose paths do, there is now
//     nothing, as long as the crack's line passes it within about a third of the zone.
// An end that leaves the solid or has joined another crack is not open: there every path around it would be a leak.
// Scenes that ask for nothing at tips see all ends as the table of crossing.hpp does; and so do those in which cracks
// grow, as a tip that has turned goes on by how the faces next to it open, of which drawing back leaves too little:
// cracks that turn by much, as that of `ten_cracks`, then curl up.
#pragma once
#include <algorithm>

#include "core/fracture/crossing.hpp"
#include "core/state/crack_fields.hpp"
#include "core/state/cracks.hpp"

namespace riven {

/// Cells by which tips are drawn back where J is asked for and no crack grows, unless the scene says otherwise.
inline constexpr double own_length = 0.36;
/// Cells around where paths see the end within which nodes lie ahead of it.
inline constexpr double end_zone = 0.1;
/// Share of a short crack's length by which each of its tips is drawn back at most.
inline constexpr double draw_back_at_most = 0.25;

/// Fills seen[k] for the points k of a crack.
inline PathEnds see_crack(const Cracks& cracks, int crack, double h, Vec2* seen) {
  const int first = cracks.end_point(crack, false), end = cracks.end_point(crack, true);
  PathEnds ends{{first, end}, {first, end}, {cracks.is_open(crack, false), cracks.is_open(crack, true)}};
  std::copy(cracks.plane.data() + first, cracks.plane.data() + end + 1, seen + first);
  if (!ends.open[0] && !ends.open[1])
    return ends;
  double length = 0;
  for (int k = first; k < end; ++k)
    length += norm(cracks.plane[k + 1] - cracks.plane[k]);
  for (const bool last : {false, true}) {
    if (!ends.open[last])
      continue;
    double left = std::min(cracks.draw_back * h, draw_back_at_most * length);
    const int step = last ? -1 : 1;
    int k = ends.point[last];
    double segment = norm(cracks.plane[k + step] - cracks.plane[k]);
    for (; segment < left; segment = norm(cracks.plane[k + step] - cracks.plane[k])) {
      left -= segment;
      k += step;
    }
    const Vec2 at =
        segment > 0 ? cracks.plane[k] + (left / segment) * (cracks.plane[k + step] - cracks.plane[k]) : cracks.plane[k];
    for (int m = ends.point[last]; m != k + step; m += step)
      seen[m] = at;
    ends.point[last] = k;
    const int other = ends.point[!last];
    while (k != other && norm(seen[k + step] - at) < end_zone * h)
      k += step;
    ends.zone[last] = k;
  }
  return ends;
}

/// How far a node is from coming to lie ahead of an open tip, or to do so no longer; below zero where it lies ahead.
RIVEN_INLINE double to_end_zone(Vec2 n, Vec2 tip, double h) {
  return norm(n - tip) - end_zone * h;
}

struct CrackPath {
  const Vec2* point;  ///< [points] of all cracks as paths see them
  PathEnds ends;
  double h;

  /// How the path from p to n crosses the segment that starts at point k.
  RIVEN_INLINE int crossed(Vec2 p, Vec2 n, int k) const {
    if ((ends.open[0] && k <= ends.zone[0] && to_end_zone(n, point[ends.point[0]], h) < 0) ||
        (ends.open[1] && k + 1 >= ends.zone[1] && to_end_zone(n, point[ends.point[1]], h) < 0))
      return 0;
    return crossing(p, n, point + k, k == ends.point[0], k + 1 == ends.point[1]);
  }
};

}  // namespace riven
