#include "kernels/begin_traces.hpp"

#include <algorithm>
#include <cmath>

#include "core/exec/parallel.hpp"
#include "core/fracture/crack_path.hpp"
#include "kernels/known_particles.hpp"

namespace riven {

void begin_traces(const Tiles& tiles, long particles, const Lattice& lattice, const Cracks& cracks,
                  CrackFields& fields) {
  fields.turned.resize(lattice.nodes());
  fields.block_limit.resize(particles / exec::block + fields.marked_tiles.size() + 1);
  fields.tiles.resize(fields.marked_tiles.size());
  fields.crack_move.resize(cracks.count());
  fields.traced.resize(cracks.points());
  for (int k = 0; k < cracks.points(); ++k)
    fields.traced[k] = seen_point(cracks, k, lattice.h);
  fields.fields.resize(particles);
  fields.crossing.resize(fields.block_limit.size());
  fields.block_slots.resize(fields.block_limit.size());
  long known = 0;
  for (const int tile : fields.marked_tiles)
    known += tiles.start[tile + 1] - tiles.start[tile];
  fields.memory.clear();
  fields.memory.reserve(known + known / 8);
  fields.limit.clear();
  fields.limit.reserve(known + known / 8);
  fields.block_limit.zero();
  fields.tiles.zero();
  for (long m = 0; m < fields.tiles.size(); ++m) {
    const int* start = tiles.start.data() + fields.marked_tiles[m];
    fields.tiles[m].known = add_known(start[0], start[1], fields);
    fields.tiles[m].changed = 1;
  }
  fields.fields.zero();
  fields.crossing.zero();
  fields.tally.zero();
  std::fill(fields.recount.begin(), fields.recount.end(), std::uint8_t{1});
  fields.used[0] = 0;
  fields.slots_used = 0;
}

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
