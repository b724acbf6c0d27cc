// Which crack velocity field each particle uses at each of its nodes, and how that was found.
// Made by the passes hash, trace and assign (kernels/); read by every transfer and by contact.
#pragma once
#include <cstdint>

#include "core/exec/array.hpp"
#include "core/math/vec.hpp"

namespace riven {

enum class Side : std::uint8_t { none = 0, above = 1, below = 2 };

/// What one node that may see cracks knows after `assign`. crack[k] < 0 where there is no such crack.
/// Field = 1 (crosses crack[0]) + 2 (crosses crack[1]). side[k] is where the particles that cross crack k
/// come from; the node itself lies on the opposite side. Of two cracks the lower number is first.
struct NodeCracks {
  int node = -1;
  int crack[2] = {-1, -1};
  Side side[2] = {Side::none, Side::none};
  Vec2 normal[2];   ///< averaged over the crossings, unit length, from above to below
  Vec2 normal0[2];  ///< the same of the crack's first position
};

/// One particle-node pair that crosses one crack.
struct CrossingRecord {
  int particle;                 ///< position in the particle arrays
  int entry;                    ///< 2 * (position in CrackFields::candidate) + (comes from below)
  int segment;                  ///< the crossed segment (the last, if there are several)
  std::uint16_t neighbour = 0;  ///< which of the particle's nodes, row by row from the lower left
  std::uint16_t weighs = 0;     ///< the shape function is not zero there; else nothing follows from the crossing
};

/// What the last trace of a particle found, and for how long that holds.
struct CrossingMemory {
  int stamp = 0;  ///< CrackFields::stamp when it was last used: void unless at the trace before
  int id = -1;    ///< of the particle, which may since have been sorted to another position
  int cell = -1;  ///< of the particle
  int first = 0;  ///< its records in CrackFields::records
  int count = 0;
  double clear = 0;   ///< m, sum of the moves of the particle and the cracks up to which they hold
  double travel = 0;  ///< CrackFields::travel of that time
  Vec2 x;             ///< the particle's position then
};

struct RecordChunk {
  long begin, count;
};

struct CrackFields {
  static constexpr int bits = 2;             ///< of a field number
  static constexpr double margin = 0.25;     ///< cells that a crack point may move before the hash is due
  static constexpr double unit = 1ll << 40;  ///< fixed-point one of the summed normals

  // hash: cells, tiles and nodes that may see cracks; remade when a crack has moved by more than the margin.
  // A cell carries the number of the node that the shape function sorts its particles by.
  exec::Array<int> cell_index;       ///< [nodes] index into `cells`, or -1
  exec::Array<int> cells;            ///< [marked] cells that see a segment, ascending
  exec::Array<int> cell_start;       ///< [marked + 1] CSR of the segments seen by each such cell
  exec::Array<int> cell_segment;     ///< first point of each seen segment, ascending within a cell
  exec::Array<int> tile_marked;      ///< [tiles] 1 where particles sorted into the tile may see a crack
  exec::Array<int> marked_tiles;     ///< the same as a list
  exec::Array<int> node_index;       ///< [nodes] index into `nodes`, or -1
  exec::Array<NodeCracks> nodes;     ///< [flagged] every node that may see a crack, in ascending node number
  exec::Array<int> candidate_start;  ///< [flagged + 1] CSR of the cracks that each such node may see
  exec::Array<int> candidate;        ///< crack numbers, ascending within a node
  exec::Array<int> extra;            ///< [nodes] see grid.hpp
  int extra_slots = 0;
  exec::Array<Vec2> hashed;  ///< [points] crack points when the hash was made

  // trace: crossings, and their sums for each candidate and side. Sums are of integers, so that they do not depend on
  // the order of the particles.
  exec::Array<std::int64_t> segment_normal;  ///< [4 points] fixed-point unit normals of now and of the first position
  exec::Array<CrossingRecord> records, last_records;
  exec::Array<RecordChunk> chunks;  ///< parts of `records`, in the order in which they were finished
  long chunk_count = 0;
  exec::Array<CrossingMemory> memory;      ///< [particles]
  exec::Array<Vec2> traced;                ///< [points] crack points at the last trace
  double travel = 0;                       ///< m, sum over the steps of the largest move of any crack point
  int stamp = 1;                           ///< counts the traces, and one more for what voids all memories
  exec::Array<int> tally;                  ///< [2 candidates] crossings from above and from below
  exec::Array<std::int64_t> tally_normal;  ///< [4][2 candidates] sums of the segments' normals

  // assign
  exec::Array<std::uint8_t> verdict;  ///< [2 candidates] what a crossing of this entry means
  exec::Array<std::uint32_t> fields;  ///< [particles] `bits` for each neighbour node, row by row from the lower left
  long warning_both_sides = 0;  ///< warning 1 (see assign_fields.hpp), summed over steps: pairs that cross a crack from
                                ///< the side which fewer pairs of the node come from
  long warning_third_crack = 0;  ///< warning 2: pairs that cross a crack beyond the two held by the node
  Vec2 warning_place[2];         ///< the node at which each was seen first
};

}  // namespace riven
