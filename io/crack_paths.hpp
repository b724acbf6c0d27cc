// crack_paths.csv: the cracks as they are at the end of a run, for whoever plots or measures their paths.
#pragma once
#include <filesystem>

#include "core/state/cracks.hpp"

namespace riven {

/// One row for each point, crack by crack from end to end: where it is and where it was when it was made, and how far
/// the faces are open and have slid there (crack_opening.hpp); in m. The file appears whole or not at all.
void write_crack_paths(const std::filesystem::path& path, const Cracks& cracks);

}  // namespace riven
