// Holds the faces of cracks as far apart as the particles beside them say.
//
// Surfaces are moved by velocities (move_cracks.hpp), and each step is off by a little: nodes beyond a loaded face,
// with next to no mass, give way further than the particles do. As long as a body stays on its nodes the errors end
// with the load. In one that passes over the grid they add up: a pressed crack in a disk that turns opened by half as
// much again in one revolution, and J with it, while the particles stayed where they should. Where these were at first
// is known. So a surface point that was first at X_s should be found at
//   x(X_s) = sum_i N_i sum_p m_p S_ip (x_p + F_p (X_s - X_p)) / sum_i N_i sum_p m_p S_ip,
// with the particles p of its fields at the nodes i around it, and F_p their deformation gradients. Each time that
// particles are sorted anew, as they have then come to other nodes, both surfaces go a part of that by which their ways
// there differ: what x(X_s) differs by from one place in a cell to the next is averaged. What the ways have in common
// they do not go, nor does the plane: X_s of what has grown in a solid under strain is known less well than by how far
// it has opened.
//
// Cracks that start apart from their solids (Cracks::gap) are left as they are.
#pragma once
#include "core/exec/space.hpp"
#include "core/state/state.hpp"

namespace riven {

/// Are surfaces to be held to the particles in this step?
template <class Real>
bool anchors_due(const State<Real, 2>& s) {
  return s.clock.step > 0 && s.watch.sorted_at == s.clock.step;
}

inline namespace RIVEN_SIDE {

/// To be called once the fields of this step are known and before anything has moved. Needs the particles' x0 and F,
/// and Tiles::cell_start.
template <class Real>
void anchor_cracks(const exec::Space& space, ShapeFunction shape, State<Real, 2>& s);

}  // namespace RIVEN_SIDE

}  // namespace riven
