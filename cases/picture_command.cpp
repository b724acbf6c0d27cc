#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <system_error>

#include "cases/commands.hpp"
#include "cases/shipped.hpp"
#include "core/error.hpp"

namespace riven {

namespace {

/// Becomes the script, whose exit codes are those of riven. Throws Error (file) where that cannot be started.
[[noreturn]] void draw(const std::vector<std::string>& arguments) {
  std::vector<std::string> words = shipped_script("riven_picture.py");
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> command;
  command.reserve(words.size() + 1);
  for (std::string& w : words)
    command.push_back(w.data());
  command.push_back(nullptr);
  std::fflush(stdout);
  execvp(command[0], command.data());
  fail({.code = Exit::file,
        .what = "the Python that draws cannot be started: " + std::generic_category().message(errno),
        .where = words[0],
        .suggestion = "name another one in the environment: RIVEN_PYTHON=/path/to/python3 riven picture ..."});
}

}  // namespace

void add_picture(CLI::App& app) {
  CLI::App* command = app.add_subcommand("picture", "draws a frame, or columns of the history, of a folder of results");
  command->set_help_flag();  // --help, too, is the script's
  command->prefix_command();
  command->callback([command] {
    const std::vector<std::string> arguments = command->remaining();
    draw(arguments.empty() ? std::vector<std::string>{"--help"} : arguments);
  });
}

}  // namespace riven
