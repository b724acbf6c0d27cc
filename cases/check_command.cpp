#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "cases/commands.hpp"
#include "core/plan/plan.hpp"
#include "io/doubts.hpp"

namespace riven {

void add_check(CLI::App& app) {
  auto options = std::make_shared<SceneOptions>();
  CLI::App* command =
      app.add_subcommand("check", "reads a scene and says whether it can be run, and what in it is seldom meant");
  options->add_to(*command);
  command->callback([options] {
    const Scene scene = options->read();
    make_plan(scene);
    const bool clear = print_doubts(scene) == 0;
    fmt::print("{}: {}\n", scene.source_path, clear ? "nothing wrong" : "can be run");
  });
}

}  // namespace riven
