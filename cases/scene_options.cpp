#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "cases/commands.hpp"
#include "cases/shipped.hpp"
#include "core/error.hpp"
#include "io/read_scene.hpp"
#include "io/suggest.hpp"
#include "io/units.hpp"

namespace riven {

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

double parse_tolerance(const std::string& text) {
  const std::optional<double> number = plain_number(text);
  const double x = number ? *number : parse_quantity(text, {"ratio", "1", {"%"}});
  if (!(x > 0 && x < 1))
    fail({Exit::bad_input, "the tolerance is out of range", "--within", shown(text), "between 0 and 1, as 2% or 0.02",
          number && x >= 1 && x < 100 ? "did you mean '" + text + "%'?" : ""});
  return x;
}

}  // namespace riven
