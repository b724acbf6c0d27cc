// Tractions between the faces of cracks as forces on the grid (Nairn and Aimene, eqs. 7 and 8):
//
//   f_ij += sum_s +-F_s,i,    +-F_s = -+A_k (T_n n + T_t t),
//
// with F_s,i what a force on the surface is to its nodes (surface_velocity.hpp): S*_is F_s of eq. 7, which by itself
// acts where the mass around x_s is, and the moment that takes it to x_s, so that nodes and faces do the same work. s
// is the upper (+) and lower (-) surface of each crack point k, j the field that the surface sees at node i, A_k the
// share of the present length of the segments around the point that lies in the solid, times its thickness. A point of
// which one surface finds no mass bears nothing on either, so that momentum is kept; sums run in the order of the
// points, whatever the number of threads. Where other cracks are near, the pressures of a point act in two halves, in
// the middles of what it bears before and behind it: another crack that crosses there, or ends, parts the solid between
// them.
#pragma once
#include "core/exec/space.hpp"
#include "core/plan/plan.hpp"
#include "core/state/state.hpp"

namespace riven {

/// Where the forces of a crack point, or half of one, went in this step. Those of point k stand at 2 k and 2 k + 1; the
/// latter is not applied where they act at the point.
struct PointForces {
  static constexpr int nodes = 9;
  struct Surface {
    int slot[nodes];
    Vec2 force[nodes];  ///< N
  };
  Surface surface[2];  ///< upper and lower
  bool applied;
};

inline namespace RIVEN_SIDE {

/// Adds the forces of this step to Grid::q. Shape: that of the particles.
template <class Shape, class Real>
void apply_tractions(const exec::Space&, ScatterKind, State<Real, 2>&, exec::Array<PointForces>&);

/// Once cracks have moved: books the work that pressures did and lets damage follow the openings. Of a force F on a
/// node that is dt F . (v + v')/2, with v before the update of Grid::q = [vx vy ax ay] and v' after it or, where
/// `again`, that of Grid::again = [v' .], which particles have by then: by any other, as that which faces move by, work
/// is done that no particle gets.
template <class Real>
void settle_tractions(const exec::Space&, const exec::Array<PointForces>&, bool again, State<Real, 2>&);

}  // namespace RIVEN_SIDE

}  // namespace riven
