// v(s,i): the crack velocity field of a node for a point on a crack's surface (Nairn et al., end of the appendix).
#pragma once
#include <algorithm>
#include <cmath>

#include "core/fracture/crossing.hpp"
#include "core/state/crack_fields.hpp"
#include "core/state/cracks.hpp"
#include "core/state/grid.hpp"

namespace riven {

/// The cracks and what the hash and assign know of them, as a kernel sees it.
struct SurfaceView {
  Lattice lattice;
  const int* cell_index;
  const int* cell_start;
  const int* cell_segment;
  const int* node_index;
  const NodeCracks* nodes;
  const int* crack;   ///< [points]
  const int* start;   ///< [cracks + 1]
  const Vec2* plane;  ///< [points]
};

inline SurfaceView surface_view(const Lattice& lattice, const Cracks& cracks, const CrackFields& fields) {
  return {lattice,
          fields.cell_index.data(),
          fields.cell_start.data(),
          fields.cell_segment.data(),
          fields.node_index.data(),
          fields.nodes.data(),
          cracks.crack.data(),
          cracks.start.data(),
          cracks.plane.data()};
}

/// A crack's point and the crack around it.
struct CrackPoint {
  int crack;
  Vec2 x;
  Vec2 left;      ///< normal, towards above
  Vec2 beyond;    ///< direction in which the crack ends here, 0 unless the point is a tip
  bool tip;       ///< a tip of the crack in reach of the nodes around the point
  bool straight;  ///< the crack leaves the line along the point by little, as far as these nodes reach
};

inline CrackPoint crack_point(const SurfaceView& view, int point) {
  const int crack = view.crack[point], first = view.start[crack], last = view.start[crack + 1] - 1;
  const Vec2 x = view.plane[point];
  const Vec2 along = view.plane[point < last ? point + 1 : point] - view.plane[point > first ? point - 1 : point];
  const double length = norm(along), reach = 1.6 * view.lattice.h, bend = 0.25 * view.lattice.h;
  const Vec2 t = length > 0 ? along * (1 / length) : Vec2{};
  CrackPoint p{crack, x, turned(t), point == first ? -t : point == last ? t : Vec2{}, false, length > 0};
  for (int step : {-1, 1}) {
    int k = point + step;
    for (; k >= first && k <= last; k += step) {
      const Vec2 r = view.plane[k] - x;
      if (std::fabs(r.x) > reach || std::fabs(r.y) > reach)
        break;
      p.straight = p.straight && std::fabs(dot(r, p.left)) < bend && step * dot(r, t) >= 0;
    }
    p.tip = p.tip || k < first || k > last;
  }
  return p;
}

/// One surface of a crack's point.
struct SurfacePoint {
  CrackPoint own;
  Side side;
  Vec2 x;           ///< where the surface is now
  int first, last;  ///< part of cell_segment that its cell sees
};

/// `cell`: that of x, by the shape function of the hash.
RIVEN_INLINE SurfacePoint surface_point(const SurfaceView& view, const CrackPoint& own, Side side, Vec2 x, int cell) {
  const int seen = view.cell_index[cell];
  return {own, side, x, seen < 0 ? 0 : view.cell_start[seen], seen < 0 ? 0 : view.cell_start[seen + 1]};
}

namespace detail {

/// The side from which the line from `from` to n crosses the segments [at, end), all of one crack.
inline RIVEN_FN Side side_crossed(const SurfaceView& view, Vec2 from, Vec2 n, int at, int end) {
  const int crack = view.crack[view.cell_segment[at]], first = view.start[crack], last = view.start[crack + 1] - 1;
  const double left = std::min(from.x, n.x), right = std::max(from.x, n.x);
  const double lower = std::min(from.y, n.y), upper = std::max(from.y, n.y);
  CrossingSum sum;
  for (; at < end; ++at) {
    const int k = view.cell_segment[at];
    const Vec2 a = view.plane[k], b = view.plane[k + 1];
    const bool beside = (a.x < left && b.x < left) || (a.x > right && b.x > right);
    if (!beside && !((a.y < lower && b.y < lower) || (a.y > upper && b.y > upper)))
      sum.add(crossing(from, n, view.plane + k, k == first, k + 1 == last));
  }
  return sum.side();
}

/// Which of the segments in sight are the crack's.
struct SegmentRange {
  int at, end;
};
RIVEN_INLINE SegmentRange segments_of(const SurfaceView& view, const SurfacePoint& s, int crack) {
  int at = s.first;
  while (at < s.last && view.crack[view.cell_segment[at]] != crack)
    ++at;
  int end = at;
  while (end < s.last && view.crack[view.cell_segment[end]] == crack)
    ++end;
  return {at, end};
}

/// Does the line from the surface to n cross the point's own crack? It starts off the crack's point, by a thousandth of
/// a cell. The surface itself may lie on the wrong side, where faces overlap, and a line from the point to a node in
/// line with the crack, as those beyond the tip of a crack on a grid line, would run along the crack and cross it or
/// not by rounding. To a node well off a straight crack it crosses at once, except past the tip that it starts from.
RIVEN_INLINE bool crosses_own(const SurfaceView& view, const SurfacePoint& s, Vec2 n) {
  const Vec2 r = n - s.own.x;
  const double off = dot(r, s.own.left), h = view.lattice.h;
  if (s.own.straight && std::fabs(off) > 0.3 * h)
    return (off > 0) != (s.side == Side::above) && !(dot(r, s.own.beyond) > 0);
  const SegmentRange own = segments_of(view, s, s.own.crack);
  const Vec2 from = s.own.x + ((s.side == Side::above ? 1e-3 : -1e-3) * h) * s.own.left;
  return own.at < own.end && side_crossed(view, from, n, own.at, own.end) != Side::none;
}

/// Adds what the other cracks in sight make of a field, or -1.
inline RIVEN_FN int cross_others(const SurfaceView& view, const SurfacePoint& s, Vec2 n, const NodeCracks& held,
                                 int field) {
  for (int at = s.first, end = at; at < s.last; at = end) {
    const int crack = view.crack[view.cell_segment[at]];
    while (end < s.last && view.crack[view.cell_segment[end]] == crack)
      ++end;
    const Side side = crack == s.own.crack ? Side::none : side_crossed(view, s.x, n, at, end);
    if (side == Side::none)
      continue;
    const int m = held.crack[1] == crack;
    if (held.crack[m] == crack) {
      if (held.side[m] == side)
        field |= 1 << m;
    } else if (held.crack[1] < 0) {
      return -1;
    }
  }
  return field;
}

}  // namespace detail

/// The fields of `node`, which lies at `place`, for the surfaces s[first] to s[last - 1] of one crack point, or -1
/// where the node has no such field. A crack is crossed where the line from the surface to the node crosses it from the
/// side that the node holds. Along the middle of its own crack that is where the node has crossings from this surface's
/// side; near a tip the line may pass beyond, whatever the node holds. The field of a crack that the line crosses and
/// the node does not hold is empty; only a crack beyond the two that a node can hold is ignored, as it is for
/// particles.
RIVEN_INLINE void fields_of_surfaces(const SurfaceView& view, const SurfacePoint* s, int first, int last, int node,
                                     Vec2 place, int* field) {
  field[0] = field[1] = 0;
  const int f = view.node_index[node];
  if (f < 0)
    return;
  const NodeCracks& held = view.nodes[f];
  const CrackPoint& own = s[first].own;
  const int m = held.crack[1] == own.crack;
  const bool holds = held.crack[m] == own.crack;
  for (int k = first; k < last; ++k)
    field[k] = holds && held.side[m] == s[k].side ? 1 << m : 0;
  if (!holds || own.tip)
    for (int k = first; k < last; ++k) {
      if (holds && field[k] == 0)
        continue;
      const bool crosses = detail::crosses_own(view, s[k], place);
      field[k] = !crosses ? 0 : holds ? field[k] : held.crack[1] < 0 ? -1 : 0;
    }
  if (held.sees == own.crack)
    return;
  for (int k = first; k < last; ++k)
    if (field[k] >= 0)
      field[k] = detail::cross_others(view, s[k], place, held, field[k]);
}

}  // namespace riven
