// v(s,i): the crack velocity field of a node for a point on a crack's surface (Nairn et al., end of the appendix).
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/exec/bits.hpp"
#include "core/fracture/beyond_end.hpp"
#include "core/fracture/crossing.hpp"
#include "core/state/crack_fields.hpp"
#include "core/state/cracks.hpp"
#include "core/state/grid.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// The cracks and what the hash and assign know of them, as a kernel sees it.
struct SurfaceView {
  Lattice lattice;
  const int* cell_index;
  const int* cell_start;
  const int* cell_segment;
  const int* node_index;
  const NodeCracks* nodes;
  const int* crack;          ///< [points]
  const int* start;          ///< [cracks + 1]
  const Vec2* plane;         ///< [points]
  const Vec2* traced;        ///< [points] as paths see them
  const std::uint8_t* open;  ///< [2 cracks] 1 for tips
  const EndOnCrack* ends;    ///< CrackFields; null where there are none
};

inline SurfaceView surface_view(const Lattice& lattice, const Cracks& cracks, const CrackFields& fields) {
  return {lattice,
          exec::data(fields.cell_index),
          exec::data(fields.cell_start),
          exec::data(fields.cell_segment),
          exec::data(fields.node_index),
          exec::data(fields.nodes),
          exec::data(cracks.crack),
          exec::data(cracks.start),
          exec::data(cracks.plane),
          exec::data(fields.traced),
          exec::data(cracks.open),
          fields.ends.empty() ? nullptr : exec::data(fields.ends)};
}

/// A crack's point and the crack around it.
struct CrackPoint {
  int crack;
  Vec2 x;       ///< in the crack's plane, where paths from it begin
  Vec2 left;    ///< normal, towards above
  Vec2 beyond;  ///< direction in which the crack ends here, 0 unless the point is an end on no other crack
  Vec2 back;    ///< from the point to x, 0 unless the point is an end on another crack
  bool tip;     ///< an end of the crack in reach of the nodes around the point
  double off;   ///< a node further from the line along the point is to one side of the crack; infinite if it turns
};

/// Does a closed end of a crack lie on another crack, or on its own further along?
inline RIVEN_FN bool end_on_crack(const SurfaceView& view, int end, int segment) {
  const Lattice& l = view.lattice;
  const Vec2 x = view.plane[end], X = (x - l.origin) * (1 / l.h);
  const int i = static_cast<int>(std::floor(X.x)), j = static_cast<int>(std::floor(X.y));
  const int seen = i < 0 || j < 0 || i >= l.nx || j >= l.ny ? -1 : view.cell_index[j * l.nx + i];
  for (int at = seen < 0 ? 0 : view.cell_start[seen]; seen >= 0 && at < view.cell_start[seen + 1]; ++at) {
    const int n = view.cell_segment[at];
    const Vec2 a = view.plane[n], d = view.plane[n + 1] - a, r = x - a;
    const double along = std::max(0.0, std::min(1.0, dot(r, d) / dot(d, d)));
    if (n != segment && norm(r - along * d) < 1e-3 * l.h)
      return true;
  }
  return false;
}

inline RIVEN_FN CrackPoint crack_point(const SurfaceView& view, int point) {
  const int crack = view.crack[point];
  const int first = view.start[crack], last = view.start[crack + 1] - 1;
  const Vec2 x = view.plane[point];
  const Vec2 along = view.traced[std::min(point + 1, last)] - view.traced[std::max(point - 1, first)];
  const double length = norm(along), h = view.lattice.h, reach = 1.6 * h;
  const Vec2 t = length > 0 ? along * (1 / length) : Vec2{};
  if ((point == first && view.open[2 * crack]) || (point == last && view.open[2 * crack + 1]))
    return {crack, x, turned(t), {}, {}, true, std::numeric_limits<double>::infinity()};  // its line ends nearby
  CrackPoint p{crack, x, turned(t), point == first ? -t : point == last ? t : Vec2{}, {}, false, 0};
  double bend = 0, back = length > 0 ? 0 : -1;
  for (int step = -1; step <= 1; step += 2) {
    int k = point + step;
    for (; k >= first && k <= last; k += step) {
      const Vec2 r = view.traced[k] - x;
      if (std::fabs(r.x) > reach || std::fabs(r.y) > reach)
        break;
      bend = std::max(bend, std::fabs(dot(r, p.left)));
      back = std::min(back, step * dot(r, t));
    }
    p.tip = p.tip || k < first || k > last;
  }
  const double least = p.tip ? bend + 0.1 * h : 0.02 * h;  // what lies ahead of a tip takes a closer look
  p.off = back >= 0 && bend < 0.25 * h ? std::max(least, std::min(0.3 * h, 4 * bend + 0.02 * h))
                                       : std::numeric_limits<double>::infinity();
  if ((point == first || point == last) && end_on_crack(view, point, point == first ? first : last - 1)) {
    p.back = (-0.02 * h) * p.beyond;
    p.beyond = {};
    p.x += p.back;
  }
  return p;
}

/// One surface of a crack's point.
struct SurfacePoint {
  const CrackPoint& own;
  Side side;
  Vec2 x;    ///< where the surface is now
  int cell;  ///< that of x, by the shape function of the hash
  bool looked = false;
  int first = 0, last = 0;  ///< once looked: part of cell_segment that the cell sees

  /// Most points never need to know which segments are around.
  RIVEN_INLINE void look(const SurfaceView& view) {
    if (looked)
      return;
    looked = true;
    const int seen = view.cell_index[cell];
    if (seen < 0)
      return;
    first = view.cell_start[seen];
    last = view.cell_start[seen + 1];
  }
};

namespace detail {

/// How the line from `from` to n crosses the segments [at, end), all of one crack.
inline RIVEN_FN CrossingSum crossings(const SurfaceView& view, Vec2 from, Vec2 n, int at, int end) {
  const int crack = view.crack[view.cell_segment[at]];
  const int first = view.start[crack], last = view.start[crack + 1] - 1;
  const double left = std::min(from.x, n.x), right = std::max(from.x, n.x);
  const double lower = std::min(from.y, n.y), upper = std::max(from.y, n.y);
  CrossingSum sum;
  for (; at < end; ++at) {
    const int k = view.cell_segment[at];
    const Vec2 a = view.traced[k], b = view.traced[k + 1];
    const bool beside = (a.x < left && b.x < left) || (a.x > right && b.x > right);
    if (!beside && !((a.y < lower && b.y < lower) || (a.y > upper && b.y > upper)))
      sum.add(crossing(from, n, view.traced + k, k == first, k + 1 == last, 0));  // ends on cracks move with both sides
  }
  return sum;
}

/// An end of another crack.
struct OtherEnd {
  int point = -1;     ///< -1 where there is none
  bool last = false;  ///< which end
  Side from = Side::none;
};

/// The end in sight of another crack, of segments [at, end), that lies on the point's own crack.
inline RIVEN_FN OtherEnd end_on_own(const SurfaceView& view, const SurfacePoint& s, int at, int end) {
  const int crack = view.crack[view.cell_segment[at]];
  const int points[2] = {view.start[crack], view.start[crack + 1] - 1};
  const bool sees[2] = {view.cell_segment[at] == points[0], view.cell_segment[end - 1] + 1 == points[1]};
  for (int last = 0; view.ends != nullptr && last < 2; ++last)
    if (const EndOnCrack& on = view.ends[2 * crack + last]; sees[last] && on.host == s.own.crack)
      return {points[last], last != 0, on.from};
  return {};
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

/// A thousandth of a cell towards the surface's side.
RIVEN_INLINE Vec2 aside(const SurfaceView& view, const SurfacePoint& s) {
  return ((s.side == Side::above ? 1e-3 : -1e-3) * view.lattice.h) * s.own.left;
}

/// Does the line from the surface to n cross the point's own crack? It starts off the crack's point, by a thousandth of
/// a cell. The surface itself may lie on the wrong side, where faces overlap, and a line from the point to a node in
/// line with the crack, as those beyond the tip of a crack on a grid line, would run along the crack and cross it or
/// not by rounding. To a node well off a straight crack it crosses at once, except past the end that it starts from;
/// from an end on another crack, too, as it starts twenty times further back along the crack than off it.
RIVEN_INLINE bool crosses_own(const SurfaceView& view, SurfacePoint& s, Vec2 n) {
  const Vec2 r = n - s.own.x;
  const double off = dot(r, s.own.left);
  if (std::fabs(off) > s.own.off)
    return (off > 0) != (s.side == Side::above) && !(dot(r, s.own.beyond) > 0);
  s.look(view);
  const SegmentRange own = segments_of(view, s, s.own.crack);
  return own.at < own.end && crossings(view, s.own.x + aside(view, s), n, own.at, own.end).side() != Side::none;
}

/// Adds what the other cracks in sight make of a field, or -1. Where a crack goes on as another one, what does not
/// cross the one near their common end crosses the other: both are seen from the same place.
inline RIVEN_FN int cross_others(const SurfaceView& view, SurfacePoint& s, Vec2 n, const NodeCracks& held, int field) {
  s.look(view);
  const bool on_crack = s.own.back.x != 0 || s.own.back.y != 0;
  const Vec2 from = on_crack ? s.x + s.own.back + aside(view, s) : s.x;
  const int own = held.which(s.own.crack);
  const bool behind = own >= 0 && held.side[own] == s.side;  // the own crack, seen from the surface
  for (int at = s.first, end = at; at < s.last; at = end) {
    const int crack = view.crack[view.cell_segment[at]];
    while (end < s.last && view.crack[view.cell_segment[end]] == crack)
      ++end;
    if (crack == s.own.crack)
      continue;
    const OtherEnd on_own = end_on_own(view, s, at, end);
    // surfaces behind their own crack lie beyond what ends on it, wherever they have moved
    const Vec2 start = on_own.point >= 0 && on_own.from != s.side ? s.own.x + aside(view, s) : from;
    CrossingSum sum = crossings(view, start, n, at, end);
    if (behind && on_own.point >= 0 && on_own.from == s.side)
      sum.add(BeyondEnd(view.traced + on_own.point, on_own.last, crossed_beyond * view.lattice.h).crossed(start, n));
    const Side side = sum.side();
    if (side == Side::none)
      continue;
    const int m = held.which(crack);
    if (m >= 0) {
      if (held.side[m] == side)
        field |= 1 << m;
    } else if (held.crack[most_held - 1] < 0) {
      return -1;
    }
  }
  return field;
}

}  // namespace detail

/// The field of a node, which lies at `place`, for a surface, or -1 where the node has no such field. A crack is
/// crossed where the line from the surface to the node crosses it from the side that the node holds. Along the middle
/// of its own crack that is where the node has crossings from this surface's side; near a tip the line may pass beyond,
/// whatever the node holds. The field of a crack that the line crosses and the node does not hold is empty; only a
/// crack beyond the three that a node can hold is ignored, as it is for particles.
inline RIVEN_FN int field_of_surface(const SurfaceView& view, SurfacePoint& s, const NodeCracks& held, Vec2 place) {
  const int m = held.which(s.own.crack);
  const bool holds = m >= 0;
  int field = holds && held.side[m] == s.side ? 1 << m : 0;
  if ((!holds || (s.own.tip && field != 0)) && !detail::crosses_own(view, s, place))
    field = 0;
  else if (!holds)
    field = held.crack[most_held - 1] < 0 ? -1 : 0;
  return field < 0 || held.sees == s.own.crack ? field : detail::cross_others(view, s, place, held, field);
}

/// Nodes around a point of a crack: 3 x 3 of them, row by row, and room for the lanes behind.
inline constexpr int surface_width = 3, surface_lanes = 16;
using SurfaceSlots = int[2][surface_lanes];  ///< of the upper and the lower surface; -1: no such field

/// What the nodes around a point know of cracks, side by side. Lanes past the last node hold zeros.
struct NodesAround {
  alignas(64) int flagged[surface_lanes] = {};
  alignas(64) int extra[surface_lanes] = {};  ///< slot of the node's field 1
  alignas(64) int sees[surface_lanes] = {};
  alignas(64) int crack[2][surface_lanes] = {};
  alignas(64) int side[2][surface_lanes] = {};

  /// Without branches: which nodes around a crack see it is beyond prediction.
  RIVEN_INLINE void load(const SurfaceView& view, int first) {
    constexpr NodeCracks sees_none{};
    for (int b = 0, n = 0; b < surface_width; ++b, first += view.lattice.nx)
      for (int a = 0; a < surface_width; ++a, ++n) {
        const int f = view.node_index[first + a];
        const NodeCracks& held = *(f < 0 ? &sees_none : view.nodes + f);
        flagged[n] = f >= 0;
        extra[n] = view.lattice.nodes() + held.extra;
        sees[n] = held.sees;
        for (int k = 0; k < 2; ++k) {
          crack[k][n] = held.crack[k];
          side[k][n] = static_cast<int>(held.side[k]);
        }
      }
  }
};

/// Both surfaces of a crack's point.
struct SurfacePair {
  CrackPoint own;
  Vec2 x[2];           ///< of the upper and the lower surface
  int cell[2];         ///< SurfacePoint::cell
  int first[2];        ///< of the nodes around each
  NodesAround around;  ///< of the upper surface's nodes
};

namespace detail {

/// The slots of the nodes from `first` on for the upper surface s[0] and the lower one s[1] of a point. Where the line
/// along the point tells on which side of the crack a node is, and the node sees no other crack, these are found
/// without branches, what comes next to what around a crack being beyond prediction. The others are looked at after.
RIVEN_INLINE void find_slots(const SurfaceView& view, SurfacePoint* s, int first, const NodesAround& around,
                             SurfaceSlots& slot) {
  const CrackPoint& own = s[0].own;
  const Lattice& l = view.lattice;
  const Vec2 from = l.position(first) - own.x;
  const float x = float(from.x), y = float(from.y), h = float(l.h);
  const int crack = own.crack, tip = own.tip;
  const float left_x = float(own.left.x), left_y = float(own.left.y), far = float(own.off);
  const float beyond_x = float(own.beyond.x), beyond_y = float(own.beyond.y);
  unsigned unsure = 0;  // a bit for each node
#pragma omp simd reduction(| : unsure)
  for (int n = 0; n < surface_lanes; ++n) {
    const int second = around.crack[1][n] == crack, holds = second | (around.crack[0][n] == crack);
    const int side = second ? around.side[1][n] : around.side[0][n];
    const int column = n % surface_width, row = n / surface_width;
    const float rx = x + h * float(column), ry = y + h * float(row), off = rx * left_x + ry * left_y;
    const int within = !(rx * beyond_x + ry * beyond_y > 0), inside = !tip;
    const int above = (off > 0) & within, below = (off <= 0) & within;  // crossed by paths from the other side
    const int loose = !holds, room = around.flagged[n] & loose & (around.crack[1][n] < 0);
    const int node = first + row * l.nx + column, field = around.extra[n] + second;
    const int from_above = holds & (side == int(Side::above)) & (below | inside);
    const int from_below = holds & (side == int(Side::below)) & (above | inside);
    slot[0][n] = from_above ? field : room & below ? -1 : node;
    slot[1][n] = from_below ? field : room & above ? -1 : node;
    const int near = !(std::fabs(off) > far);
    const int others = around.sees[n] != crack;
    unsure |= static_cast<unsigned>(around.flagged[n] & ((near & (loose | tip)) | others)) << n;
  }
  for (; unsure != 0; unsure &= unsure - 1) {
    const int n = exec::lowest_bit(unsure), node = first + n / surface_width * l.nx + n % surface_width;
    const NodeCracks& held = view.nodes[view.node_index[node]];
    const Vec2 place = l.position(node);
    for (int k = 0; k < 2; ++k) {
      const int field = field_of_surface(view, s[k], held, place);
      slot[k][n] = field == 0 ? node : field < 0 ? -1 : around.extra[n] + field - 1;
    }
  }
}

/// The slots for a lower surface whose nodes are not those of the upper one.
RIVEN_OUTLINE void find_lower_slots(const SurfaceView& view, SurfacePoint* s, int first, SurfaceSlots& slot) {
  NodesAround around;
  around.load(view, first);
  SurfaceSlots own;
  find_slots(view, s, first, around, own);
  std::copy(own[1], own[1] + surface_lanes, slot[1]);
}

}  // namespace detail

/// The slots of the nodes around both surfaces of a point, row by row.
RIVEN_INLINE void slots_of_surfaces(const SurfaceView& view, const SurfacePair& pair, SurfaceSlots& slot) {
  SurfacePoint s[2] = {{pair.own, Side::above, pair.x[0], pair.cell[0]},
                       {pair.own, Side::below, pair.x[1], pair.cell[1]}};
  detail::find_slots(view, s, pair.first[0], pair.around, slot);
  if (pair.first[1] != pair.first[0])
    detail::find_lower_slots(view, s, pair.first[1], slot);
}

}  // namespace RIVEN_SIDE

}  // namespace riven
