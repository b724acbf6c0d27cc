// The crack tasks of the step, for the shape function of the plan.
#pragma once
#include "kernels/simulation.hpp"

namespace riven {

void hash_if_due(Simulation&);
void find_fields(Simulation&);
void load_faces(Simulation&);
void move_with_grid(Simulation&);

}  // namespace riven
