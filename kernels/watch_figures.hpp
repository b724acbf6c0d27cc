// The figures by which a run is judged (Watched in scene.hpp), found whenever stock is taken: a pass over the points of
// cracks, and what tally() and the steps have noticed on their way.
#pragma once
#include "kernels/simulation.hpp"

namespace riven {

/// Brings State::monitors up to date, after tally(); counts figures that are beyond their warning limits. Throws Error
/// (unstable) for one beyond the limit at which the scene stops.
template <class Real>
void watch_figures(SimulationOf<Real>& m);

}  // namespace riven
