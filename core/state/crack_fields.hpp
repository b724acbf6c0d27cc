// Which crack velocity field each particle uses at each of its nodes, and how that was found.
// Made by the passes hash, trace and assign (kernels/); read by every transfer and by contact.
#pragma once
#include <cstdint>
#include <vector>

#include "core/exec/array.hpp"
#include "core/math/vec.hpp"

namespace riven {

enum class Side : std::uint8_t { none = 0, above = 1, below = 2 };

/// What one node that may see cracks knows after `assign`. cracks[k] < 0 where there is no such crack.
/// Field = 1 (crosses cracks[0]) + 2 (crosses cracks[1]). side[k] is where the particles that cross crack k
/// come from; the node itself lies on the opposite side.
struct NodeCracks {
  int node = -1;
  int crack[2] = {-1, -1};
  Side side[2] = {Side::none, Side::none};
  Vec2 normal[2];   ///< averaged over the crossings, unit length, from above to below
  Vec2 normal0[2];  ///< the same of the crack's first position
};

struct CrackFields {
  static constexpr int bits = 2;  ///< of a field number

  // hash: cells and nodes that may see cracks; remade when a crack has moved by more than the margin
  exec::Array<int> cell_start;     ///< [nodes + 1] segments seen by the dual cell of each node, a CSR list
  exec::Array<int> cell_segment;   ///< first point of each seen segment, ordered by crack within a cell
  exec::Array<int> tile_marked;    ///< [tiles] 1 where particles sorted into the tile may see a crack
  exec::Array<int> node_index;     ///< [nodes] index into `nodes`, or -1
  exec::Array<NodeCracks> nodes;   ///< [flagged] every node that may see a crack, in ascending node number
  exec::Array<int> candidate_start;///< [flagged + 1] CSR of the cracks each such node may see, ascending
  exec::Array<int> candidate;      ///< crack numbers
  exec::Array<int> extra;          ///< [nodes] see grid.hpp
  int extra_slots = 0;

  // trace and assign
  exec::Array<std::uint32_t> fields;  ///< [particles] `bits` for each neighbour node, row by row from the lower left
  long warning_both_sides = 0;        ///< warning 1 of seed 000: pairs that cross one crack from both sides
  long warning_third_crack = 0;       ///< warning 2: pairs that cross a crack beyond the two held by the node
  Vec2 warning_place[2];              ///< where each was seen first
};

}  // namespace riven
