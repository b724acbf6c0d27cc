#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "cases/commands.hpp"
#include "core/error.hpp"
#include "io/read_scene.hpp"
#include "io/suggest.hpp"
#include "io/units.hpp"

namespace riven {

namespace fs = std::filesystem;

void SceneOptions::add_to(CLI::App& command, bool required) {
  command.add_option("scene", scene, "a scene file, or the name of a shipped scene (riven cases)")->required(required);
  command.add_option("--set", set, "change a key of the scene, for example --set solver.cfl=0.3")->take_all();
  command.add_option("--exec", exec, "where kernels run")->check(CLI::IsMember({"openmp", "stdpar", "serial", "cuda"}));
  command.add_option("--threads", threads, "number of threads; all cores unless said")->check(CLI::Range(1, 1024));
}

Scene SceneOptions::read() const {
  return with_choices(read_scene(find_file(Shipped::scene, scene), set));
}

Scene SceneOptions::with_choices(Scene s) const {
  if (!exec.empty())
    exec::parse(exec, s.exec);
  if (threads > 0)
    s.threads = threads;
  return s;
}

int threads_of(const Scene& s) {
  return s.threads > 0 ? s.threads : exec::available_threads();
}

namespace {

fs::path folder_of(Shipped kind) {
  return fs::path(RIVEN_CASES_DIR) / (kind == Shipped::scene ? "scenes" : "studies");
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

double parse_tolerance(const std::string& text) {
  const std::optional<double> number = plain_number(text);
  const double x = number ? *number : parse_quantity(text, {"ratio", "1", {"%"}});
  if (!(x > 0 && x < 1))
    fail({Exit::bad_input, "the tolerance is out of range", "--within", shown(text), "between 0 and 1, as 2% or 0.02",
          number && x >= 1 && x < 100 ? "did you mean '" + text + "%'?" : ""});
  return x;
}

}  // namespace riven
