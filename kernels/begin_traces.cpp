#include "kernels/begin_traces.hpp"

#include "core/exec/parallel.hpp"
#include "core/fracture/crack_path.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

namespace {

/// Tiles know where what is known of their particles stands. Returns how many these are.
long place_known(const Tiles& tiles, CrackFields& fields) {
  const int *start = tiles.start.data(), *marked = std::as_const(fields.marked_tiles).data();
  long known = 0;
  for (long m = 0; m < fields.tiles.size(); ++m) {
    const int first = start[marked[m]], last = start[marked[m] + 1];
    fields.tiles[m] = TileTrace{};
    fields.tiles[m].known = static_cast<int>(known - first);
    fields.tiles[m].changed = 1;
    known += last - first;
  }
  return known;
}

/// Room for what will be known of particles in tiles that are marked later, too.
template <class T>
void renew_with_room(exec::Array<T>& array, long n) {
  array.renew(0);
  array.reserve(n + n / 8);
  array.renew(n);
}

}  // namespace

void begin_traces(const exec::Space& space, const Tiles& tiles, long particles, const Lattice& lattice,
                  const Cracks& cracks, CrackFields& fields) {
  const long marked = fields.marked_tiles.size(), blocks = particles / exec::block + marked + 1;
  fields.turned.resize(lattice.nodes());
  fields.crack_move.resize(cracks.count());
  fields.traced.resize(cracks.points());
  for (int k = 0; k < cracks.points(); ++k)
    fields.traced[k] = seen_point(cracks, k, lattice.h);
  fields.tiles.renew(marked);
  const long known = place_known(tiles, fields);
  renew_with_room(fields.memory, known);
  renew_with_room(fields.limit, known);
  fields.block_limit.renew(blocks);
  fields.block_slots.renew(blocks);
  fields.crossing.renew(blocks);
  fields.fields.renew(particles);
  exec::parallel_zero(space, "begin traces", fields.memory, fields.limit, fields.block_limit, fields.crossing,
                      fields.fields, fields.tally);
  exec::launch_some(space, fields.recount.size(), exec::chunk,
                    [recount = exec::data_to_fill(fields.recount)] RIVEN_KERNEL(long n) { recount[n] = 1; });
  fields.used[0] = 0;
  fields.slots_used = 0;
}

}  // namespace RIVEN_SIDE

}  // namespace riven
