#include <CLI/CLI.hpp>
#include <algorithm>

#include "cases/commands.hpp"
#include "core/error.hpp"
#include "io/read_scene.hpp"
#include "io/suggest.hpp"

namespace riven {

namespace fs = std::filesystem;

void SceneOptions::add_to(CLI::App& command) {
  command.add_option("scene", scene, "a scene file, or the name of a shipped scene (riven cases)")->required();
  command.add_option("--set", set, "change a key of the scene, for example --set solver.cfl=0.3")->take_all();
  command.add_option("--exec", exec, "where kernels run")->check(CLI::IsMember({"openmp", "stdpar", "serial"}));
  command.add_option("--threads", threads, "number of threads; all cores unless said")->check(CLI::Range(1, 1024));
}

Scene SceneOptions::read() const {
  std::string path = scene;
  if (const bool folder = fs::is_directory(path); folder || !fs::exists(path)) {
    const std::optional<fs::path> shipped = shipped_scene(scene);
    if (!shipped && !folder) {
      const std::string close = nearest(scene, shipped_names());
      fail({Exit::bad_input, "there is no such file and no shipped scene of that name", "", scene,
            "a .toml file, or a name that `riven cases` lists", close.empty() ? "" : "did you mean '" + close + "'?"});
    }
    if (shipped)  // results of an earlier run may lie in a folder of that name
      path = shipped->string();
  }
  Scene s = read_scene(path, set);
  if (!exec.empty())
    exec::parse(exec, s.exec);
  if (threads > 0)
    s.threads = threads;
  return s;
}

int threads_of(const Scene& s) {
  return s.threads > 0 ? s.threads : exec::available_threads();
}

fs::path scene_folder() {
  return RIVEN_CASES_DIR;
}

std::optional<fs::path> shipped_scene(const std::string& name) {
  const fs::path file = scene_folder() / (name + ".toml");
  if (name.find('/') == std::string::npos && fs::exists(file))
    return file;
  return std::nullopt;
}

std::vector<std::string> shipped_names() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(scene_folder()))
    if (entry.path().extension() == ".toml")
      names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace riven
