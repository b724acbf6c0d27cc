// Assign: from the crossings of all pairs, the cracks that each node holds, and the field v(p,i) of each pair.
//
// A node holds the two cracks with most crossings (ties to the lower number, as neither the number of a crack nor the
// order of the particles may matter otherwise). The side from which more pairs cross is opposite to the node's (tie:
// above). Field = 1 (crosses the first) + 2 (crosses the second). Two kinds of crossings count as none and are warned
// of (Nairn et al., appendix): 1, from the other side; 2, of a crack that the node does not hold. The paper allocates
// fields in order of arrival; up to two cracks this gives the same fields, 1 and 2 possibly swapped.
#pragma once
#include "core/exec/space.hpp"
#include "core/fracture/crossing.hpp"
#include "core/state/bodies.hpp"
#include "core/state/crack_fields.hpp"
#include "core/state/cracks.hpp"
#include "core/state/grid.hpp"
#include "core/state/particles.hpp"

namespace riven {

/// Trace and assign: fills `nodes` and `fields` from the present positions. The hash must not be due. Particles are
/// sorted by tiles, from which they have moved by one cell at most. `domains`: [bodies].
template <class Shape, class Real>
void determine_fields(const exec::Space& space, const Particles<Real, 2>& particles,
                      const DomainSetting<Real, 2>* domains, const Lattice& lattice, const Cracks& cracks,
                      CrackFields& fields);

/// What field_of_surface looks at.
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
SurfaceView surface_view(const Lattice& lattice, const Cracks& cracks, const CrackFields& fields);

namespace detail {

/// field_of_surface where several cracks, or parts of them that the node does not hold, are in sight.
inline RIVEN_FN int trace_surface(const SurfaceView& view, const NodeCracks& held, int node, int k, Side side, Vec2 x,
                                  int cell, int field, bool holds_own) {
  const Vec2 n = view.lattice.position(node);
  const int own = view.crack[k];
  for (int s = view.cell_start[cell], end = view.cell_start[cell + 1]; s < end;) {
    const int crack = view.crack[view.cell_segment[s]], first = view.start[crack], last = view.start[crack + 1] - 1;
    const Vec2 from = crack == own ? view.plane[k] : x;
    CrossingSum sum;
    for (; s < end && view.crack[view.cell_segment[s]] == crack; ++s) {
      const int a = view.cell_segment[s];
      if (crack != own || !holds_own)
        sum.add(crossing(from, n, view.plane + a, a == first, a + 1 == last));
    }
    if (crack == own) {
      // the line starts on its own crack, which counts at k by the side of the surface
      if (!holds_own && (sum.count % 2 != 0) != crosses_at(view.plane + k, k == first, k == last, side, n))
        return -1;
      continue;
    }
    if (sum.side() == Side::none)
      continue;
    if (held.crack[0] == crack || held.crack[1] == crack) {
      const int m = held.crack[1] == crack;
      if (held.side[m] == sum.side())
        field |= 1 << m;
    } else if (held.crack[1] < 0) {
      return -1;
    }
  }
  return field;
}

}  // namespace detail

/// v(s,i): the field of `node` for the surface `side` at crack point k, which is at x now; -1 if the node has no such
/// field. `cell` is the cell of x by the shape function of the hash. The point's own crack is crossed where the node
/// holds it and has crossings from this surface's side; another crack, where the line from x to the node crosses it
/// from the side that the node holds. The field of a crack that the line crosses and the node does not hold is empty
/// (there is no such field to find, though a particle may ignore a crack beyond the two held).
RIVEN_INLINE int field_of_surface(const SurfaceView& view, int node, int k, Side side, Vec2 x, int cell) {
  const int f = view.node_index[node];
  if (f < 0)
    return 0;
  const NodeCracks& held = view.nodes[f];
  const int own = view.crack[k], c = view.cell_index[cell], m = held.crack[1] == own;
  const bool holds_own = held.crack[m] == own;
  const int field = holds_own && held.side[m] == side ? 1 << m : 0;
  if (c < 0)
    return field;
  const int first = view.cell_segment[view.cell_start[c]], last = view.cell_segment[view.cell_start[c + 1] - 1];
  if (holds_own && view.crack[first] == own && view.crack[last] == own)
    return field;
  return detail::trace_surface(view, held, node, k, side, x, c, field, holds_own);
}

}  // namespace riven
