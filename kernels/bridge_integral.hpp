// The part in J of the forces that end cracks between nodes (bridge_tips.hpp), where a contour cuts through them.
//
// They are tractions on the faces next to a tip, so that a contour with some of them inside and the others outside
// differs from those around all by J_T = -sum F_i . d(delta)/ds of these (own_faces.hpp). What belongs to a tip is its
// J with all of them, wherever q falls:
//   J_T = -sum (q_i - q_tip) F_i . d(delta)/ds,
// delta the opening at as far behind the tip as node i lies: that of the tip's field, a sqrt(r) with a from further
// behind (opening.hpp), as next to the tip the faces open as the forces let them. For the tip's own, the interaction
// integrals take the openings of known fields for delta.
#pragma once
#include "core/fracture/tip_places.hpp"
#include "kernels/bridge_tips.hpp"
#include "kernels/j_integral.hpp"

namespace riven {

/// Adds those of all tips near the domain to the sums of a task. `bridges` and `places`: of State::tips.
template <class Real>
void add_bridges(const State<Real, 2>&, const TipBridges& bridges, const TipPlaces& places, TipTask&);

}  // namespace riven
