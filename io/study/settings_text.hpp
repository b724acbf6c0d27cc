// Settings as they would stand in a scene.
#pragma once
#include <string>
#include <vector>

namespace riven::study {

/// "solver.cfl=0.3" and the like as TOML. Those that change an entry of a list of bodies, grips, cracks, ... have no
/// place of their own and follow as remarks.
std::string settings_as_toml(const std::vector<std::string>& set);

/// The command that runs `scene` with these settings, for a shell.
std::string as_command(const std::string& scene, const std::vector<std::string>& set);

}  // namespace riven::study
