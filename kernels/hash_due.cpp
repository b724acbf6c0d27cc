#include <cmath>

#include "core/exec/parallel.hpp"
#include "core/fracture/beyond_end.hpp"
#include "core/fracture/crack_path.hpp"
#include "kernels/hash_cracks.hpp"

namespace riven {

bool hash_due(const exec::Space& space, const Lattice& lattice, const Cracks& cracks, const CrackFields& fields) {
  const long points = cracks.points();
  if (fields.cell_index.size() != lattice.nodes() || fields.hashed.size() != points)
    return true;
  const double limit = 0.99 * CrackFields::margin * lattice.h;  // less a little for rounding
  const auto moved = [&, then = fields.hashed.data()](long k) {
    const Vec2 now = seen_point(cracks, static_cast<int>(k), lattice.h);
    return long{std::fabs(now.x - then[k].x) > limit || std::fabs(now.y - then[k].y) > limit};
  };
  bool turned = false;
  each_end_on_crack(cracks, fields, [&](int end, bool last) {
    const Vec2 *const then = fields.hashed.data() + end, *const now = cracks.plane.data() + end;
    const double reach = seen_beyond * lattice.h;
    turned = turned || norm(BeyondEnd(now, last, reach).far - BeyondEnd(then, last, reach).far) > limit;
  });
  return turned || exec::parallel_reduce<long>(space, "hash cracks: due", points, moved) > 0;
}

}  // namespace riven
