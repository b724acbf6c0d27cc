// The commands of riven. Each adds itself to the program: its options, its help, and what it does.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/exec/space.hpp"
#include "core/scene/scene.hpp"

namespace CLI {
class App;
}

namespace riven {

void add_run(CLI::App& app);
void add_plan(CLI::App& app);
void add_check(CLI::App& app);
void add_cases(CLI::App& app);

/// What every command that reads a scene understands.
struct SceneOptions {
  std::string scene;
  std::vector<std::string> set;
  std::string exec;
  int threads = 0;

  void add_to(CLI::App& command);
  /// The scene in a file, or the shipped scene of that name, with the options applied. Throws Error.
  Scene read() const;
};

/// Threads that the scene asks for, or as many as there are cores.
int threads_of(const Scene& scene);

/// Folder of the shipped scenes.
std::filesystem::path scene_folder();
/// File of a shipped scene, if there is one of that name.
std::optional<std::filesystem::path> shipped_scene(const std::string& name);
std::vector<std::string> shipped_names();

}  // namespace riven
