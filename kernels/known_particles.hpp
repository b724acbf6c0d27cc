// Room for what is known of the particles of marked tiles: few of many, where cracks are.
#pragma once
#include "core/state/crack_fields.hpp"

namespace riven {

/// Room for particles [first, last) of a tile that is marked now, of whom nothing is known. Returns TileTrace::known.
inline int add_known(int first, int last, CrackFields& fields) {
  const long at = fields.memory.size(), end = at + last - first;
  fields.memory.resize(end);
  fields.limit.resize(end);
  return static_cast<int>(at - first);
}

}  // namespace riven
