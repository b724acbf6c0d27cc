#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "cases/commands.hpp"
#include "core/plan/plan.hpp"

namespace riven {

void add_check(CLI::App& app) {
  auto options = std::make_shared<SceneOptions>();
  CLI::App* command = app.add_subcommand("check", "reads a scene and says whether it can be run");
  options->add_to(*command);
  command->callback([options] {
    const Scene scene = options->read();
    make_plan(scene);
    fmt::print("{}: nothing wrong\n", scene.source_path);
  });
}

}  // namespace riven
