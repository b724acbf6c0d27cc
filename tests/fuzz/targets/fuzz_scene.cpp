// Feeds arbitrary text to the scene reader: it either gives a scene or throws riven::Error. Lines that start with
// "--set " become settings; text that starts with "csv" and a line end is read as a crack file instead.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "io/check_scene.hpp"
#include "io/crack_file.hpp"
#include "io/read_scene.hpp"
#include "io/units.hpp"

namespace {

/// The source text, settings applied, must read back as the same scene.
void check_source(const riven::Scene& scene) {
  try {
    const riven::Scene again = riven::parse_scene(scene.source_text, scene.source_path);
    if (again.defaults != scene.defaults || again.cell != scene.cell || again.title != scene.title)
      std::abort();
  } catch (const riven::Error&) {
    std::abort();
  }
}

}  // namespace

/// UDUNITS-2 forgets two bytes when its lexer gives up on the text of a unit.
extern "C" const char* __lsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier)
  return "leak:utlex";
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  std::string_view input(reinterpret_cast<const char*>(data), size);
  constexpr std::string_view set = "--set ", csv = "csv\n", toughness = "toughness\n";
  try {
    if (input.starts_with(csv)) {
      riven::parse_crack_file(input.substr(csv.size()), "fuzz.csv", "fuzz");
      return 0;
    }
    if (input.starts_with(toughness)) {
      riven::parse_toughness(input.substr(toughness.size()));
      return 0;
    }
    std::string text;
    std::vector<std::string> overrides;
    while (!input.empty()) {
      const size_t end = input.find('\n');
      const std::string_view line = input.substr(0, end);
      input.remove_prefix(end == std::string_view::npos ? input.size() : end + 1);
      if (line.starts_with(set))
        overrides.emplace_back(line.substr(set.size()));
      else
        text.append(line).append("\n");
    }
    const riven::Scene scene = riven::parse_scene(text, "fuzz.toml", overrides);
    check_source(scene);
    riven::check_scene(scene);
  } catch (const riven::Error&) {
    return 0;
  }
  return 0;
}
