#include "kernels/return_surfaces.hpp"

#include <algorithm>
#include <utility>

#include "core/exec/parallel.hpp"

namespace riven {

namespace {

bool has_gap(const Cracks& c, int first, int last) {
  return !c.gap.empty() &&
         std::any_of(c.gap.data() + first, c.gap.data() + last + 1, [](Vec2 g) { return g.x + g.y > 0; });
}

void return_crack(const WayBack* ways, double share, int crack, Cracks& c) {
  const int first = c.end_point(crack, false), last = c.end_point(crack, true);
  if (has_gap(std::as_const(c), first, last))
    return;
  for (int k = first; k <= last; ++k) {
    const WayBack &up = ways[2 * k], &low = ways[2 * k + 1];
    const bool tip = (k == first && c.is_open(crack, false)) || (k == last && c.is_open(crack, true));
    if (tip || !up.known || !low.known)
      continue;
    const Vec2 apart = (0.5 * share) * (up.d - low.d);
    c.upper[k] += apart;
    c.lower[k] -= apart;
  }
}

}  // namespace

void return_surfaces(const exec::Space& space, const exec::Array<WayBack>& ways, double share, Cracks& cracks) {
  exec::parallel_tasks(space, "anchor cracks", cracks.count(),
                       [&, from = ways.data()](long c) { return_crack(from, share, static_cast<int>(c), cracks); });
}

}  // namespace riven
