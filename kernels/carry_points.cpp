#include "kernels/carry_points.hpp"

#include "core/fracture/crack_path.hpp"
#include "kernels/known_particles.hpp"

namespace riven {

PointMap::PointMap(const CrackLists& former, const CrackLists& now)
    : former_of(now.serial.size()),
      now_of(former.serial.size()),
      is_new(now.serial.size()),
      is_gone(former.serial.size()) {
  exec::Array<int> by_serial(now.serial.size());
  for (int& k : by_serial)
    k = -1;
  for (int k = 0; k < former.serial.size(); ++k)
    by_serial[former.serial[k]] = k;
  for (int k = 0; k < now.serial.size(); ++k) {
    former_of[k] = by_serial[now.serial[k]];
    if (former_of[k] >= 0)
      now_of[former_of[k]] = k;
  }
  const auto stays = [&](int k) { return former_of[k] >= 0 && former.kind[former_of[k]] == now.kind[k]; };
  for (std::uint8_t& gone : is_gone)
    gone = 1;
  for (int k = 0; k < now.serial.size(); ++k) {
    const bool same = k + 1 < now.serial.size() && stays(k) && stays(k + 1) && former_of[k + 1] == former_of[k] + 1;
    is_new[k] = !same;
    if (same)
      is_gone[former_of[k]] = 0;
  }
}

void carry_points(const PointMap& map, const Lattice& lattice, const Cracks& cracks, CrackFields& fields) {
  const CrackLists& was = fields.former;
  fields.traced.resize(cracks.points());
  for (int k = 0; k < cracks.points(); ++k) {
    const int former = map.former_of[k];
    fields.traced[k] =
        former >= 0 && was.kind[former] == fields.kind[k] ? was.traced[former] : seen_point(cracks, k, lattice.h);
  }
}

void carry_tiles(const Tiles& tiles, CrackFields& fields) {
  const CrackLists& was = fields.former;
  const long marked = fields.marked_tiles.size(), blocks = fields.fields.size() / exec::block + marked + 1;
  fields.tiles.resize(marked);
  for (long m = 0; m < marked; ++m) {
    const int tile = fields.marked_tiles[m], former = was.tile_marked[tile];
    TileTrace& t = fields.tiles[m] = former ? was.tiles[former - 1] : TileTrace{};
    t.limit = 0;
    t.changed = 1;
    if (!former)
      t.known = add_known(tiles.start[tile], tiles.start[tile + 1], fields);
  }
  fields.block_limit.resize(blocks);
  fields.block_limit.zero();
  fields.crossing.resize(blocks);
  fields.block_slots.resize(blocks);
}

}  // namespace riven
