#include <algorithm>
#include <cstddef>

#include "core/state/first_gaps.hpp"
#include "core/state/lay_points.hpp"
#include "io/checks.hpp"
#include "io/doubts.hpp"

namespace riven {

using namespace checks;

void doubt_gaps(const Scene& s, std::vector<Doubt>& list) {
  constexpr double closed = 0.2, far = 2;  // cells: no more than how particles make up an edge; what no node sees
  if (s.contact_rules.detection == ContactDetection::displacement || s.bodies.size() < 2)
    return;
  const Cracks cracks = make_cracks(s, least_particle_distance(s));
  const auto gaps = first_gaps(s, cracks);
  for (int c = 0; !gaps.empty() && c < cracks.count(); ++c) {
    double widest = 0;
    for (int k = cracks.end_point(c, false); k <= cracks.end_point(c, true); ++k)
      if (const double gap = gaps[k].x + gaps[k].y; gap < far * s.cell)
        widest = std::max(widest, gap);
    if (widest > closed * s.cell)
      list.push_back(
          {place(s, "crack " + cracks.names[static_cast<std::size_t>(c)]),
           fmt::format("a gap of up to {} lies between solids along the crack, which counts as shut where it "
                       "is drawn: they press on each other before they meet",
                       format_length(widest, 2)),
           "detection = \"displacement\" in [contact] knows gaps"});
  }
}

}  // namespace riven
