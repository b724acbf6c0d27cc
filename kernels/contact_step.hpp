// The contact tasks of the step: the same node solution in the stages in which grid velocities change.
#pragma once
#include "kernels/simulation.hpp"

namespace riven {

template <class Real>
void sum_for_contact(SimulationOf<Real>&);
template <class Real>
void contact_before_update(SimulationOf<Real>&);
template <class Real>
void contact_after_update(SimulationOf<Real>&);
template <class Real>
void contact_on_high(SimulationOf<Real>&);
template <class Real>
void contact_after_extrapolation(SimulationOf<Real>&);

}  // namespace riven
