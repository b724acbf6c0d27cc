// Prescribed grid velocities on every field of the nodes of fixed lines, symmetry planes and grips, and the reaction
// that they take:
//   before the momentum update   p = m v(t)
//   after it                     v = v(t + dt), a += (v(t + dt) - v~) / dt
// The impulse given to the body is the change of momentum that reaches the particles.
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

/// `impulse_weight`: how much of this stage's impulse reaches the particles (0 or 1, alpha for PIC before).
template <class Real>
void prescribe_velocities(const exec::Space&, State<Real, 2>&, Stage, double impulse_weight);

/// Ends the step: books impulses and work, moves the grips, turns impulses into reaction forces.
template <class Real>
void settle_constraints(State<Real, 2>&);

}  // namespace riven
