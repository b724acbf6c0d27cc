// What the effects of a scene cost, and what others would: measured, by running its first steps with and without each.
#pragma once
#include <map>
#include <string>

#include "cases/commands.hpp"

namespace riven {

/// By the names of explain(): time of a step with the effect over that without it, less one. Effects that no setting
/// turns on or off by itself are missing. Of the first steps: what comes with growth, or with many contacts, is not
/// in it. Throws Error as reading and running the scene do.
std::map<std::string, double> measure_costs(const SceneOptions& options);

}  // namespace riven
