// riven: many explicit cracks in deforming solids, by the material point method.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "cases/commands.hpp"
#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/suggest.hpp"

namespace {

/// Does what the command line says. Throws Error (bad_input) where it begins with no command of the program.
void obey(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::RequiredError&) {
    const std::vector<std::string> unknown = app.remaining();
    if (unknown.empty() || !app.get_subcommands().empty())
      throw;
    const std::string& word = unknown.front();
    const std::vector<CLI::App*> commands = app.get_subcommands({});
    std::vector<std::string> names;
    names.reserve(commands.size());
    for (const CLI::App* command : commands)
      names.push_back(command->get_name());
    const std::string near = riven::nearest(word, names);
    std::string suggestion = "riven --help";
    if (!near.empty())
      suggestion = "did you mean '" + near + "'?";
    else if (word.ends_with(".toml"))
      suggestion = "riven run " + riven::shown(word);
    riven::fail({.code = riven::Exit::bad_input,
                 .what = "there is no such command or option",
                 .value = riven::shown(word),
                 .limit = riven::listed(names),
                 .suggestion = suggestion});
  }
}

/// Lets threads that wait for each other spin for microseconds, then sleep. By default they spin for milliseconds, in
/// which on a machine that is shared others are kept from the very work that is waited for: two runs at once on two
/// cores take ten times as long, and more. The OpenMP runtime reads this as the program is loaded, so that it starts
/// again, unless the user has chosen; where it cannot, it goes on. Under valgrind it would start anew without that.
void wait_briefly(char** argv) {
  const char* preloaded = std::getenv("LD_PRELOAD");
  const bool under_valgrind = preloaded != nullptr && std::strstr(preloaded, "vgpreload") != nullptr;
  if (under_valgrind || std::getenv("OMP_WAIT_POLICY") || std::getenv("GOMP_SPINCOUNT"))
    return;
  setenv("GOMP_SPINCOUNT", "1000", 0);
  execv("/proc/self/exe", argv);
}

/// Throws Error (file) where what was printed could not be written, as to a full disk.
void finish_printing() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    riven::fail_file("standard output", "write", errno);
}

}  // namespace

int main(int argc, char** argv) {
  using riven::Exit;
  wait_briefly(argv);
  std::signal(SIGXFSZ, SIG_IGN);  // a file beyond `ulimit -f` is an error of writing, with its message and exit code
  CLI::App app{"riven: many explicit cracks in deforming solids, by the material point method"};
  app.require_subcommand(1);
  app.set_version_flag("--version", RIVEN_VERSION);
  riven::add_run(app);
  riven::add_plan(app);
  riven::add_check(app);
  riven::add_cases(app);
  riven::add_study(app);
  riven::add_advise(app);
  riven::add_picture(app);
  try {
    obey(app, argc, argv);
    finish_printing();
    return static_cast<int>(Exit::done);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) ? static_cast<int>(Exit::bad_input) : static_cast<int>(Exit::done);
  } catch (const riven::Error& e) {
    fmt::print(stderr, "riven: {}\n", e.what());
    return static_cast<int>(e.code());
  } catch (const std::bad_alloc&) {
    fmt::print(stderr,
               "riven: out of memory\n  try:     larger cells, or fewer particles_per_cell; riven plan SCENE says what "
               "the arrays take\n");
    return static_cast<int>(Exit::internal);
  } catch (const std::system_error& e) {
    fmt::print(stderr, "riven: {}\n", e.what());
    return static_cast<int>(Exit::file);
  } catch (const std::exception& e) {
    fmt::print(stderr, "riven: internal error: {}\n", e.what());
    return static_cast<int>(Exit::internal);
  }
}
