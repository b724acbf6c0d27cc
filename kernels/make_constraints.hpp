// The nodes of fixed lines and symmetry planes, and the rigid particles of grips.
#pragma once
#include "core/state/state.hpp"

namespace riven {

/// Turns the scene's fixed lines, symmetry planes and grips into lists of nodes and rigid particles.
template <class Real>
void make_constraints(const Scene&, State<Real, 2>&);

}  // namespace riven
