// riven-perf: how fast riven is, beside what the machine can do.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "core/error.hpp"
#include "perf/commands.hpp"

int main(int argc, char** argv) {
  CLI::App app{"Measures riven and the machine that it runs on"};
  app.require_subcommand(1);
  riven::perf::add_machine(app);
  riven::perf::add_throughput(app);
  riven::perf::add_kernels(app);
  riven::perf::add_gate(app);
  try {
    app.parse(argc, argv);
    return static_cast<int>(riven::Exit::done);
  } catch (const CLI::RuntimeError& e) {
    return e.get_exit_code();
  } catch (const CLI::ParseError& e) {
    return app.exit(e) ? static_cast<int>(riven::Exit::bad_input) : static_cast<int>(riven::Exit::done);
  } catch (const riven::Error& e) {
    fmt::print(stderr, "riven-perf: {}\n", e.what());
    return static_cast<int>(e.code());
  } catch (const std::exception& e) {
    fmt::print(stderr, "riven-perf: {}\n", e.what());
    return static_cast<int>(riven::Exit::internal);
  }
}
