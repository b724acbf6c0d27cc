// The contact tasks of the step: the same node solution in the stages in which grid velocities change.
#pragma once
#include "kernels/simulation.hpp"

namespace riven {

void sum_for_contact(Simulation&);
void contact_before_update(Simulation&);
void contact_after_update(Simulation&);
void contact_on_high(Simulation&);
void contact_after_extrapolation(Simulation&);

}  // namespace riven
