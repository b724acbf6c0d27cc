// Changes to a scene from the command line: --set key=value.
#pragma once

#include <string>
#include <vector>

#include "io/toml.hpp"

namespace riven {

/// Applies each "path=value" in order. A path is dotted, with an index or a name for an entry of an array:
/// "solver.cfl=0.3", "body.0.velocity=[\"1 m/s\", \"0 m/s\"]", "body.plate.spin=10 rad/s". The value is TOML or, where
/// it is not, a text; without a value, "growth=", the key or the entry is taken away. A new key keeps the argument as
/// its source, so that an unknown one is reported with it. Throws Error (bad_input).
void apply_overrides(toml::table& root, const std::vector<std::string>& overrides);

}  // namespace riven
