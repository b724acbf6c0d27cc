#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "cases/commands.hpp"
#include "io/doubts.hpp"
#include "io/require_memory.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/simulation.hpp"

namespace riven {

namespace {

/// Makes what a run begins with. Throws Error (bad_input) for what shows only then, as a load that finds no particle.
template <class Real>
void lay_out(const Scene& scene) {
  const exec::Space space(scene.exec, threads_of(scene));
  const SimulationOf<Real> laid_out(scene, space);
}

}  // namespace

void add_check(CLI::App& app) {
  auto options = std::make_shared<SceneOptions>();
  CLI::App* command =
      app.add_subcommand("check", "reads a scene and says whether it can be run, and what in it is seldom meant");
  options->add_to(*command);
  command->callback([options] {
    const Scene scene = options->read();
    require_memory(scene);
    with_precision(scene.precision, [&](auto real) { lay_out<typename decltype(real)::type>(scene); });
    const bool clear = print_doubts(scene) == 0;
    fmt::print("{}: {}\n", scene.source_path, clear ? "nothing wrong" : "can be run");
  });
}

}  // namespace riven
