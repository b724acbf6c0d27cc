// Scenes from TOML.
#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/scene.hpp"

namespace riven {

/// Reads, parses and checks the scene in a file, with "key=value" settings applied on top. Throws Error: file when it
/// (or a crack file that it names) cannot be read, bad_input with file, line and key for what is in it.
Scene read_scene(const std::string& path, const std::vector<std::string>& overrides = {});

/// The scene that `text` describes, in SI units, not yet checked for meaning (see check_scene). `name` stands for the
/// file in messages and is where relative paths start. Of `files` (Scene::files) none is read again.
Scene parse_scene(std::string_view text, std::string name, const std::vector<std::string>& overrides = {},
                  std::map<std::string, std::string> files = {});

}  // namespace riven
