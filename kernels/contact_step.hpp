// The contact tasks of the step: the same node solution in the stages in which grid velocities change.
#pragma once
#include "kernels/simulation.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

template <class Real>
void sum_for_contact(SimulationOf<Real>&);
template <class Real>
void contact_before_update(SimulationOf<Real>&);
template <class Real>
void contact_after_update(SimulationOf<Real>&);
/// Terms of higher orders go together where faces touched in the update.
template <class Real>
void link_term(SimulationOf<Real>&, bool last);
/// Faces that did not meet as higher orders have it.
template <class Real>
void contact_on_high(SimulationOf<Real>&);
template <class Real>
void contact_after_extrapolation(SimulationOf<Real>&);

/// Where contact waits for faces to close: decides whether it acts in the next step, and logs its coming and going.
/// While it waits the whole of it is tried every so many steps, as often as a wave runs through two cells; once faces
/// touch it stays until they have been apart for ten times as long. Faces that close between two tries overlap by what
/// they approach each other in that time: 2 v/c cells at the speed v, where waves have the speed c.
template <class Real>
void watch_contact(SimulationOf<Real>&);

}  // namespace RIVEN_SIDE

}  // namespace riven
