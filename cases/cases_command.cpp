#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "cases/commands.hpp"
#include "io/read_scene.hpp"

namespace riven {

void add_cases(CLI::App& app) {
  app.add_subcommand("cases", "lists the shipped scenes, one a line, name first")->callback([] {
    for (const std::string& name : shipped_names(Shipped::scene))
      fmt::print("{:<16} {}\n", name, read_scene(shipped_file(Shipped::scene, name)->string()).title);
  });
}

}  // namespace riven
