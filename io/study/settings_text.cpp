#include "io/study/settings_text.hpp"

#include <algorithm>

#include "io/overrides.hpp"
#include "io/toml_text.hpp"

namespace riven::study {

namespace {

bool in_a_list(const std::string& setting) {
  static const std::vector<std::string> lists{"material", "body", "fix", "symmetry", "grip", "load", "crack", "probe"};
  const size_t dot = setting.find('.');
  return dot < setting.find('=') && std::find(lists.begin(), lists.end(), setting.substr(0, dot)) != lists.end();
}

}  // namespace

std::string settings_as_toml(const std::vector<std::string>& set) {
  std::vector<std::string> plain;
  std::string remarks;
  for (const std::string& s : set)
    if (in_a_list(s))
      remarks += "# " + s + "\n";
    else
      plain.push_back(s);
  toml::table document;
  apply_overrides(document, plain);
  return toml_text(document) + remarks;
}

std::string as_command(const std::string& scene, const std::vector<std::string>& set) {
  std::string command = "riven run " + scene;
  for (const std::string& s : set) {
    std::string quoted;
    for (const char c : s)
      quoted += c == '\'' ? "'\\''" : std::string(1, c);
    command += " --set '" + quoted + "'";
  }
  return command;
}

}  // namespace riven::study
