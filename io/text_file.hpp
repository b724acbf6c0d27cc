// Whole text files into memory.
#pragma once
#include <string>

namespace riven {

/// The contents of a regular file of at most 64 MiB. Throws Error (file), which says `what` it is for ("the scene"),
/// which file and why it cannot be read, at `where`.
std::string read_text_file(const std::string& path, const std::string& what, const std::string& where = {});

}  // namespace riven
