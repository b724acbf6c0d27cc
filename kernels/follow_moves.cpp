#include "kernels/follow_moves.hpp"

#include <algorithm>
#include <cmath>

#include "core/exec/parallel.hpp"
#include "core/fracture/crack_path.hpp"

namespace riven {

void follow_moves(const exec::Space& space, const Lattice& lattice, const Cracks& cracks, CrackFields& fields) {
  exec::launch(space, cracks.count(), [&](long c) {
    double most2 = 0;
    for (int k = cracks.start[c]; k < cracks.start[c + 1]; ++k) {
      const Vec2 now = seen_point(cracks, k, lattice.h), move = now - fields.traced[k];
      most2 = std::max(most2, dot(move, move));
      fields.traced[k] = now;
    }
    fields.crack_move[c] = std::sqrt(most2);
  });
  double most = 0;
  for (const double move : fields.crack_move)
    most = std::max(most, move);
  fields.travel += most;
}

}  // namespace riven
