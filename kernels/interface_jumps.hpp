// The jump of displacement across imperfect interfaces, which their tractions follow (J.A. Nairn, CMES 92 (2013)
// 271-299). It is kept per segment in the segment's own frame, so that it turns with the crack, and moves with the
// velocities of the nodes' fields,
//   d(jump_s)/dt = sum_i S*_is (v_below - v_above)_i,
// with the same weights for both faces (interface_segments.hpp), which also spread the segment's area: the power of the
// tractions at the nodes is that of the tractions on the segments. Positions extrapolated from particles would count
// the strain of the bulk between the two fields' centres as a jump, and tracked surfaces, whose weights differ from
// face to face, the velocity gradient: a stiff interface would then work against the body's own deformation instead of
// keeping its faces together.
#pragma once
#include "core/exec/space.hpp"
#include "core/state/bodies.hpp"
#include "core/state/crack_fields.hpp"
#include "core/state/cracks.hpp"
#include "core/state/grid.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// Moves the jumps over one step; the grid holds [vx vy ax ay] after contact. Jumps of new points start at 0.
template <class Real>
void advance_jumps(const exec::Space& space, ShapeFunction shape, const exec::Array<DomainSetting<Real, 2>>& domains,
                   const Grid<Real>& grid, const CrackFields& fields, double dt, Cracks& cracks);

}  // namespace RIVEN_SIDE

}  // namespace riven
