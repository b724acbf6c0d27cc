#include "io/crack_paths.hpp"

#include <fmt/format.h>

#include <iterator>
#include <string>
#include <vector>

#include "io/atomic_file.hpp"
#include "io/crack_opening.hpp"
#include "io/history.hpp"

namespace riven {

void write_crack_paths(const std::filesystem::path& path, const Cracks& cracks) {
  const std::vector<CrackOpening> openings = crack_openings(cracks);
  std::string text = "crack,point,x [m],y [m],first x [m],first y [m],opening [m],sliding [m]\n";
  for (int c = 0; c < cracks.count(); ++c) {
    const std::string name = csv_field(cracks.names[static_cast<std::size_t>(c)]);
    const int first = cracks.end_point(c, false);
    for (int i = first; i <= cracks.end_point(c, true); ++i) {
      const Vec2 now = cracks.plane[i], made = cracks.plane0[i];
      const CrackOpening& o = openings[static_cast<std::size_t>(i)];
      fmt::format_to(std::back_inserter(text), "{},{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", name,
                     i - first, now.x, now.y, made.x, made.y, o.normal, o.sliding);
    }
  }
  write_file(path, text);
}

}  // namespace riven
