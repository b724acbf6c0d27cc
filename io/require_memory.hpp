// No run is begun that this machine has no memory for.
#pragma once
#include "core/plan/plan.hpp"

namespace riven {

/// Memory that programs can have now without driving others out, bytes; infinite where the system does not say.
double available_memory();

/// Throws Error (bad_input), with both figures, when the scene takes more than `available`, bytes, at its peak.
void require_memory(const Scene& scene, double available = available_memory());

}  // namespace riven
