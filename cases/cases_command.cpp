#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>

#include "cases/commands.hpp"
#include "cases/shipped.hpp"
#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/read_scene.hpp"
#include "io/suggest.hpp"

namespace riven {

namespace fs = std::filesystem;

namespace {

struct CasesArguments {
  std::string name, folder = ".";
  bool copy = false;
};

void list_scenes() {
  for (const std::string& name : shipped_names(Shipped::scene))
    fmt::print("{:<24} {}\n", name, read_scene(shipped_file(Shipped::scene, name)->string()).title);
}

fs::path find_shipped(const std::string& name) {
  if (const std::optional<fs::path> file = shipped_file(Shipped::scene, name))
    return *file;
  const std::string near = nearest(name, shipped_names(Shipped::scene));
  fail({Exit::bad_input, "there is no shipped scene of that name", "", shown(name), "a name that `riven cases` lists",
        near.empty() ? "" : "did you mean '" + near + "'?"});
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The scene and the files that it names. Throws Error (file), with nothing written, where one of them is there
/// already.
void copy_scene(const fs::path& scene, const fs::path& folder) {
  std::map<std::string, std::string> files = read_scene(scene.string()).files;
  files[scene.filename().string()] = text_of(scene);
  for (const auto& [name, text] : files)
    if (fs::exists(folder / name))
      fail({Exit::file, "there is such a file already", (folder / name).string(), "", "",
            "another folder, by -o DIR, or another name for the file that is there"});
  make_folder(folder);
  for (const auto& [name, text] : files) {
    write_file(folder / name, text);
    fmt::print("{}\n", (folder / name).lexically_normal().string());
  }
}

void run(const CasesArguments& o) {
  if (o.name.empty())
    return list_scenes();
  const fs::path scene = find_shipped(o.name);
  if (o.copy)
    copy_scene(scene, o.folder);
  else
    fmt::print("{}", text_of(scene));
}

}  // namespace

void add_cases(CLI::App& app) {
  auto o = std::make_shared<CasesArguments>();
  CLI::App* command = app.add_subcommand("cases", "lists the shipped scenes, one a line, or shows or copies one");
  CLI::Option* name = command->add_option("name", o->name, "print this scene");
  CLI::Option* copy =
      command->add_flag("--copy", o->copy, "copy it instead, with the files that it names")->needs(name);
  command
      ->add_option("-o,--output", o->folder, "folder to copy to; this one unless said")

      ->needs(copy);
  command->callback([o] { run(*o); });
}

}  // namespace riven
