#include "io/require_memory.hpp"

#include <fmt/format.h>

#include <fstream>
#include <limits>
#include <string>

#include "core/error.hpp"
#include "core/plan/predict_memory.hpp"
#include "io/check_scene.hpp"
#include "io/progress.hpp"

namespace riven {

double available_memory() {
  std::ifstream in("/proc/meminfo");
  for (std::string word; in >> word;)
    if (double kibibytes = 0; word == "MemAvailable:" && in >> kibibytes)
      return 1024 * kibibytes;
  return std::numeric_limits<double>::infinity();
}

void require_memory(const Scene& scene, double available) {
  const MemoryNeed need = predict_memory(scene, make_plan(scene));
  if (need.peak() > available)
    fail({Exit::bad_input, "the scene takes more memory than is available", place(scene, "grid.cell"),
          fmt::format("{} for about {:.3g} particles and {:.3g} nodes", format_bytes(static_cast<long>(need.peak())),
                      need.particles, need.nodes),
          format_bytes(static_cast<long>(available)),
          "larger cells, fewer particles_per_cell, or precision = \"float\""});
}

}  // namespace riven
