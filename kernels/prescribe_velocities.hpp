// Prescribed grid velocities on every field of the nodes of fixed lines, symmetry planes and grips, and the reaction
// that they take. With v0 = p / m as the particles gave it,
//   before the momentum update   p = m v(t)
//   after it                     v = v(t + dt), a = (v(t + dt) - v0) / dt
// so that all of the impulse reaches the particles, whichever way they take over the grid's velocity.
#pragma once
#include "core/exec/space.hpp"
#include "core/state/state.hpp"

namespace riven {

/// term: a term of the higher-order series, which vanishes where velocities are prescribed.
enum class Stage { before, after, again, term };

/// Turns the scene's fixed lines, symmetry planes and grips into lists of nodes and rigid particles.
template <class Real>
void make_constraints(const Scene&, State<Real, 2>&);

/// Lists the nodes of this step and evaluates the prescribed velocities at t and t + dt.
template <class Real>
void list_constraints(const Plan&, State<Real, 2>&);

template <class Real>
void prescribe_velocities(const exec::Space&, State<Real, 2>&, Stage);

/// Ends the step: books impulses and work, moves the grips, turns impulses into reaction forces.
template <class Real>
void settle_constraints(State<Real, 2>&);

}  // namespace riven
