#include "cases/shipped.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "core/error.hpp"
#include "io/child.hpp"
#include "io/suggest.hpp"

namespace riven {

namespace fs = std::filesystem;

namespace {

/// A folder of what is shipped: beside an installed program, else where the program was built from. Throws Error (file)
/// where it is in neither place.
fs::path shipped_folder(const std::string& name, const fs::path& source) {
  const fs::path installed = own_program().parent_path().parent_path() / "share/riven" / name;
  std::error_code error;
  for (const fs::path& folder : {installed, source})
    if (fs::is_directory(folder, error))
      return folder;
  fail({Exit::file, fmt::format("the {} that come with riven are missing", name), source.string(), "",
        fmt::format("there, or in {}", installed.string()), "cmake --install BUILD --prefix DIR"});
}

fs::path folder_of(Shipped kind) {
  const std::string name = kind == Shipped::scene ? "scenes" : "studies";
  return shipped_folder(name, fs::path(RIVEN_CASES_DIR) / name);
}

}  // namespace

std::optional<fs::path> shipped_file(Shipped kind, const std::string& name) {
  const fs::path file = folder_of(kind) / (name + ".toml");
  std::error_code error;
  if (name.find('/') == std::string::npos && fs::exists(file, error))
    return file;
  return std::nullopt;
}

std::vector<std::string> shipped_names(Shipped kind) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder_of(kind)))
    if (entry.path().extension() == ".toml")
      names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string find_file(Shipped kind, const std::string& name) {
  std::error_code error;
  const bool folder = fs::is_directory(name, error);
  if (!folder && fs::exists(name, error))
    return name;
  // results of an earlier run may lie in a folder of that name
  if (const std::optional<fs::path> shipped = shipped_file(kind, name))
    return shipped->string();
  if (folder)
    return name;
  const bool scene = kind == Shipped::scene;
  const std::string close = nearest(name, shipped_names(kind));
  std::string hint = close.empty() ? "" : "did you mean '" + close + "'?";
  if (shipped_file(scene ? Shipped::study : Shipped::scene, name))
    hint = fmt::format("{} is a {}: riven {} {}", name, scene ? "study" : "scene", scene ? "study" : "run", name);
  fail({Exit::bad_input, fmt::format("there is no such file and no shipped {} of that name", scene ? "scene" : "study"),
        "", name,
        scene ? "a .toml file, or a name that `riven cases` lists"
              : "a .toml file, or a name that `riven study --list` lists",
        std::move(hint)});
}

std::vector<std::string> shipped_script(const std::string& file) {
  const char* python = std::getenv("RIVEN_PYTHON");
  return {python != nullptr && *python != 0 ? python : "/usr/bin/python3",
          (shipped_folder("python", RIVEN_PYTHON_DIR) / file).string()};
}

}  // namespace riven
