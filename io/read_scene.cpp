#include "io/read_scene.hpp"

#include <filesystem>

#include "core/error.hpp"
#include "io/check_scene.hpp"
#include "io/overrides.hpp"
#include "io/scene_reader.hpp"
#include "io/text_file.hpp"
#include "io/toml_text.hpp"

namespace riven {

Scene parse_scene(std::string_view text, std::string name, const std::vector<std::string>& overrides,
                  std::map<std::string, std::string> files) {
  toml::table document = parse_toml(text, name);
  apply_overrides(document, overrides);
  Scene s;
  s.name = std::filesystem::path(name).stem().string();
  s.source_path = std::move(name);
  s.files = std::move(files);
  s.source_text = overrides.empty() ? std::string(text) : toml_text(document);
  const Table root(document, s, {"title",    "constants", "solver",   "grid",       "material", "body",  "fix",
                                 "symmetry", "grip",      "load",     "body_force", "damping",  "crack", "contact",
                                 "growth",   "cracks",    "fracture", "probe",      "output",   "limits"});
  s.title = root.text("title", s.name);
  root.constants("constants");
  read_solver(root, s);
  read_bodies(root, s);
  read_conditions(root, s);
  read_cracks(root, s);
  read_fracture(root, s);
  read_output(root, s);
  return s;
}

Scene read_scene(const std::string& path, const std::vector<std::string>& overrides) {
  Scene s = parse_scene(read_text_file(path, "the scene"), path, overrides);
  check_scene(s);
  return s;
}

}  // namespace riven
