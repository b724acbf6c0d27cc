// The part of carry_traces.hpp that is done on the host: points of cracks, and the tiles around them, are few.
#pragma once
#include "core/state/crack_fields.hpp"
#include "core/state/cracks.hpp"
#include "core/state/grid.hpp"
#include "core/state/particles.hpp"

namespace riven {

/// Points and segments of the former lists in the new ones.
struct PointMap {
  PointMap(const CrackLists& former, const CrackLists& now);

  exec::Array<int> former_of;        ///< [points] -1: a new one
  exec::Array<int> now_of;           ///< [former points]
  exec::Array<std::uint8_t> is_new;  ///< [points] the segment that starts here was not there before, or ended otherwise
  exec::Array<std::uint8_t> is_gone;  ///< [former points] and the other way round
};

/// Where the last trace saw the points, or, for new ones, where they are.
void carry_points(const PointMap& map, const Lattice& lattice, const Cracks& cracks, CrackFields& fields);

/// What is known of tiles. All are to be looked at, and to be given slots: nodes have others.
void carry_tiles(const Tiles& tiles, CrackFields& fields);

}  // namespace riven
