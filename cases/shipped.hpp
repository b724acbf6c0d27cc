// What comes with the program: scenes, studies of them, and scripts that draw.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace riven {

enum class Shipped { scene, study };

/// The shipped file of that name, if there is one.
std::optional<std::filesystem::path> shipped_file(Shipped kind, const std::string& name);
std::vector<std::string> shipped_names(Shipped kind);
/// The file of that path or, where there is none, the shipped one of that name. Throws Error (bad_input) with the
/// nearest name.
std::string find_file(Shipped kind, const std::string& name);

/// A command line, but for its arguments, that runs one of the scripts: by the Python that the environment names as
/// RIVEN_PYTHON, or else Debian's. Throws Error (file) where the script is not there.
std::vector<std::string> shipped_script(const std::string& file);

}  // namespace riven
