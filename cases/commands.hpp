// The commands of riven. Each adds itself to the program: its options, its help, and what it does.
#pragma once
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
void add_study(CLI::App& app);
void add_advise(CLI::App& app);
void add_picture(CLI::App& app);

/// What every command that reads a scene understands.
struct SceneOptions {
  std::string scene;
  std::vector<std::string> set;
  std::string exec;
  int threads = 0;

  /// `required`: a command line without a scene is refused.
  void add_to(CLI::App& command, bool required = true);
  /// The scene in a file, or the shipped scene of that name, with the options applied. Throws Error.
  Scene read() const;
  /// The scene with the options that are none of its keys.
  Scene with_choices(Scene scene) const;
};

/// What --within says, "2%" or "0.02". Throws Error (bad_input).
double parse_tolerance(const std::string& text);

/// Threads that the scene asks for, or as many as there are cores.
int threads_of(const Scene& scene);

}  // namespace riven
