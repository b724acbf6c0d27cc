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

/// v(s,i): the field of `node` for a point at x on the surface `side` of `crack`; `cell` is the cell of x by the shape
/// function of the hash. Its own crack is crossed where the surface is on the side that the node's crossings come from;
/// another crack, where the line from x to the node crosses it from that side.
inline RIVEN_FN int field_of_surface(const SurfaceView& view, int node, int crack, Side side, Vec2 x, int cell) {
  const int f = view.node_index[node];
  if (f < 0)
    return 0;
  const NodeCracks& held = view.nodes[f];
  int field = 0;
  for (int m = 0; m < 2; ++m) {
    if (held.crack[m] < 0)
      continue;
    Side from = side;
    if (held.crack[m] != crack) {
      CrossingSum sum;
      const int c = view.cell_index[cell], other = held.crack[m];
      for (int s = c < 0 ? 0 : view.cell_start[c]; s < (c < 0 ? 0 : view.cell_start[c + 1]); ++s) {
        const int k = view.cell_segment[s];
        if (view.crack[k] == other)
          sum.add(riven::crossing(x, view.lattice.position(node), view.plane + k, k == view.start[other],
                                  k + 2 == view.start[other + 1]));
      }
      from = sum.side();
    }
    if (from == held.side[m])
      field |= 1 << m;
  }
  return field;
}

}  // namespace riven
