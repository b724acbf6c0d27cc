// v(s,i): the crack velocity field of a node for a point on a crack's surface (Nairn et al., end of the appendix).
#pragma once
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

/// One surface of one crack point.
struct SurfacePoint {
  int point;  ///< of the crack
  Side side;
  Vec2 x;           ///< where the surface is now
  int crack;        ///< its own
  int first, last;  ///< part of cell_segment that its cell sees
  bool alone;       ///< no other crack in sight
};

/// `cell`: that of x, by the shape function of the hash.
RIVEN_INLINE SurfacePoint surface_point(const SurfaceView& view, int point, Side side, Vec2 x, int cell) {
  const int seen = view.cell_index[cell], own = view.crack[point];
  if (seen < 0)
    return {point, side, x, own, 0, 0, true};
  const int first = view.cell_start[seen], last = view.cell_start[seen + 1];
  const bool alone = view.crack[view.cell_segment[first]] == own && view.crack[view.cell_segment[last - 1]] == own;
  return {point, side, x, own, first, last, alone};
}

namespace detail {

/// Goes over all cracks in sight. `field` is what the point's own crack makes of it, if the node holds that.
inline RIVEN_FN int trace_surface(const SurfaceView& view, const SurfacePoint& s, const NodeCracks& held, int field,
                                  bool holds_own) {
  const Vec2 n = view.lattice.position(held.node);
  for (int at = s.first; at < s.last;) {
    const int crack = view.crack[view.cell_segment[at]], first = view.start[crack], last = view.start[crack + 1] - 1;
    const Vec2 from = crack == s.crack ? view.plane[s.point] : s.x;
    CrossingSum sum;
    for (; at < s.last && view.crack[view.cell_segment[at]] == crack; ++at) {
      const int k = view.cell_segment[at];
      if (crack != s.crack || !holds_own)
        sum.add(crossing(from, n, view.plane + k, k == first, k + 1 == last));
    }
    if (crack == s.crack) {
      // the line starts on its own crack, which counts there by the side of the surface
      const bool at_start = crosses_at(view.plane + s.point, s.point == first, s.point == last, s.side, n);
      if (!holds_own && (sum.count % 2 != 0) != at_start)
        return -1;
      continue;
    }
    if (sum.side() == Side::none)
      continue;
    const int m = held.crack[1] == crack;
    if (held.crack[m] == crack) {
      if (held.side[m] == sum.side())
        field |= 1 << m;
    } else if (held.crack[1] < 0) {
      return -1;
    }
  }
  return field;
}

}  // namespace detail

/// The field of `node` for a surface point, or -1 if the node has no such field. The point's own crack is crossed where
/// the node holds it and has crossings from this surface's side; another crack, where the line from the surface to the
/// node crosses it from the side that the node holds. The field of a crack that the line crosses and the node does not
/// hold is empty; only a crack beyond the two that a node can hold is ignored, as it is for particles.
RIVEN_INLINE int field_of_surface(const SurfaceView& view, const SurfacePoint& s, int node) {
  const int f = view.node_index[node];
  if (f < 0)
    return 0;
  const NodeCracks& held = view.nodes[f];
  const int m = held.crack[1] == s.crack;
  const bool holds_own = held.crack[m] == s.crack;
  const int field = holds_own && held.side[m] == s.side ? 1 << m : 0;
  if (holds_own && s.alone)
    return field;
  return detail::trace_surface(view, s, held, field, holds_own);
}

}  // namespace riven
