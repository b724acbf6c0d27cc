// Prescribed grid velocities on the fields that list_constraints.hpp lists, and the reaction that they take. With
// v0 = p / m as the particles gave it,
//   before the momentum update   p = m v(t)
//   after it                     v = v(t + dt), a = (v(t + dt) - v(t)) / dt
// A mirror image would add to the node so that p = m v(t) without a change to any particle: FLIP must not hear of it
// either, or half a body would not move as the whole does, and boundaries would take energy from the particles beside
// them. A grip is no image but a body that may come and hit: there a = (v(t + dt) - v0) / dt, and all of the impulse
// reaches the particles, whichever way they take over the grid's velocity.
#pragma once
#include "core/exec/space.hpp"
#include "core/state/state.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// term: a term of the higher-order series, which vanishes where velocities are prescribed.
enum class Stage { before, after, again, term };

/// `early_impulse`: how much of a change of momenta before the update reaches the particles (0: FLIP, 1: PIC), in that
/// stage.
template <class Real>
void prescribe_velocities(const exec::Space&, State<Real, 2>&, Stage, double early_impulse = 0);

/// Ends the step: books impulses, work and what was lost as bodies were caught, moves the grips, turns impulses into
/// reaction forces. `resisted`: ContactSums, or empty. Needs Grid::q as [vx vy ax ay] and Grid::again, where there is
/// one, as [vx vy . .].
template <class Real>
void settle_constraints(const exec::Space&, const Plan&, double early_impulse, const exec::Array<Vec2>& resisted,
                        State<Real, 2>&);

}  // namespace RIVEN_SIDE

}  // namespace riven
