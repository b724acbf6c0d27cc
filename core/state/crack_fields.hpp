// Which crack velocity field each particle uses at each of its nodes, and how that was found.
// Made by the passes hash, trace and assign (kernels/); read by every transfer and by contact.
#pragma once
#include <cstdint>

#include "core/exec/array.hpp"
#include "core/math/vec.hpp"

namespace riven {

enum class Side : std::uint8_t { none = 0, above = 1, below = 2 };

inline constexpr int most_held = 3;  ///< cracks that a node can hold

/// What one node that may see cracks knows after `assign`. crack[k] < 0 where there is no such crack.
/// Field = 1 (crosses crack[0]) + 2 (crosses crack[1]) + 4 (crosses crack[2]). side[k] is where the particles that
/// cross crack k come from; the node itself lies on the opposite side. Cracks are in the order of their numbers.
struct alignas(32) NodeCracks {
  int node = -1;
  int extra = 0;   ///< CrackFields::extra of the node
  int sees = -1;   ///< the crack that the node may see, -1 where there are two, -2 where there are more
  int third = -1;  ///< number among the nodes that may see three cracks or more, or -1
  int crack[most_held] = {-1, -1, -1};
  Side side[most_held] = {Side::none, Side::none, Side::none};
  /// 0, or, of a node behind a crack on which another one ends (beyond_end.hpp), 1 + the former's place in `crack` + 3
  /// times the latter's.
  std::uint8_t behind = 0;

  /// Which of the held cracks is this one, or -1.
  RIVEN_INLINE int which(int c) const { return crack[0] == c ? 0 : crack[1] == c ? 1 : crack[2] == c ? 2 : -1; }
  /// Bits of the fields, if it lies behind one: of the host, and of the crack that ends on it.
  RIVEN_INLINE int host() const { return 1 << (behind - 1) % most_held; }
  RIVEN_INLINE int ending() const { return 1 << (behind - 1) / most_held; }
  /// Velocity fields for which the node has slots.
  RIVEN_INLINE int room() const { return sees >= 0 ? 2 : sees == -1 ? 4 : 8; }
  /// Those that it uses where it holds cracks.
  RIVEN_INLINE int fields() const { return crack[1] < 0 ? 2 : crack[2] < 0 ? 4 : 8; }
};
static_assert(sizeof(NodeCracks) == 32);

/// Normals of the first two cracks that a node holds, averaged around it, of unit length, from above to below.
struct alignas(64) NodeNormals {
  Vec2 now[2];
  Vec2 first[2];  ///< of the cracks' first positions
};

/// The same of the third.
struct ThirdNormal {
  Vec2 now, first;
};

/// What a segment adds to such averages (kernels/average_normals.hpp).
struct alignas(64) SegmentNormal {
  Vec2 middle;      ///< cells from the lattice's first node
  Vec2 now, first;  ///< m, its normal from above to below times its length
  int pieces = 1;   ///< that it is taken in
};

/// What the crossing of a crack from one side means at a node, where it is not field 1, 2 or 4.
enum CrossingVerdict : std::uint8_t { other_side = 8, fourth_crack = 16 };

/// The path from a particle to one of its nodes crosses a crack.
struct CrossingRecord {
  int node;                ///< position in CrackFields::nodes
  int entry;               ///< 2 * (position in CrackFields::candidate) + (comes from below)
  std::uint8_t neighbour;  ///< which of the particle's nodes, row by row from the lower left
  std::uint8_t weighs;     ///< the shape function is not zero there; else nothing follows from the crossing

  bool operator==(const CrossingRecord&) const = default;
};

/// Where what a trace found holds.
enum class Known : int {
  nowhere,
  in_its_cell,  ///< as long as the particle stays in the cell of its trace
  roaming,      ///< in the cells around it, too
};

/// What the last trace of a particle found, and for how long that holds.
struct CrossingMemory {
  int first = 0;  ///< its records in CrackFields::records
  int count = 0;
  int room = 0;   ///< records that fit there
  int cell = -1;  ///< of the particle, or -1: off the grid
  Known known = Known::nowhere;
  unsigned weighed = 0;  ///< a bit for each node on which it has a weight, where that matters
  double weighs = 0;     ///< TileTrace::path up to which these stay
  double clear = 0;   ///< m, sum of the moves of the particle and the cracks up to which the crossings stay in a cell
  double travel = 0;  ///< TileTrace::travel of that time
  Vec2 x;             ///< the particle's position then
};

/// How far a node is from the segments that it may see. A node that is all but on one segment, or on the joint of two,
/// is followed by the sides on which it lies of these, and its distance is that from all others.
struct NodeClearance {
  double measured = 0;  ///< m
  double travel = 0;    ///< CrackFields::travel of that time
  int near = -1;        ///< the segment that the node is all but on, or -1
  int joined = 0;       ///< 1 if that goes for the next segment, too
  int sides = 0;        ///< see follow_node
};

/// What trace and assign know of one marked tile.
struct TileTrace {
  double travel = 0;  ///< m, sum over the steps of the largest move of a crack in sight
  double path = 0;    ///< the same, and of the largest move of a particle
  double limit = 0;   ///< path up to which no particle of the tile needs to be looked at
  int turned = 0;     ///< 1 if particles of the tile may be in a cell of CrackFields::turned
  int changed = 0;    ///< 1 if records of its particles have changed, or what they mean
  int crossing = 0;   ///< particles that see a node across a crack
  int room = 0;       ///< how many of them CrackFields::slots has room for, from `slots` on
  int slots = 0;
  int known = 0;  ///< what is known of particle p of the tile stands at p + known
  int warnings[2] = {0, 0};
};

/// The crack on which an end of another one lies, between its own ends, and the side from which that one comes.
struct EndOnCrack {
  int host = -1;
  Side from = Side::none;
};

/// How a point bounds the segments that it ends.
enum class PointKind : std::uint8_t { joint, end, open_end };

/// What hash lists, remade when cracks have grown or one has moved by more than the margin, and what trace and assign
/// keep in terms of these lists.
struct CrackLists {
  // A cell carries the number of the node that the shape function sorts its particles by.
  exec::Array<int> cell_index;    ///< [nodes] index into `cells`, or -1
  exec::Array<int> cells;         ///< [marked] cells that see a segment, ascending
  exec::Array<int> cell_start;    ///< [marked + 1] CSR of the segments seen by each such cell
  exec::Array<int> cell_segment;  ///< first point of each seen segment, ascending within a cell
  exec::Array<int> tile_marked;   ///< [tiles] 1 + index into `marked_tiles`, or 0
  exec::Array<int> marked_tiles;  ///< tiles whose particles may see a crack, ascending
  exec::Array<int>
      tile_crack_start;  ///< [marked tiles + 1] CSR of the cracks that such particles may see, some more than once
  exec::Array<int> tile_crack;
  exec::Array<int> node_index;       ///< [nodes] index into `nodes`, or -1
  exec::Array<NodeCracks> nodes;     ///< [flagged] every node that may see a crack, in ascending node number
  exec::Array<int> candidate_start;  ///< [flagged + 1] CSR of the cracks that each such node may see
  exec::Array<int> candidate;        ///< crack numbers, ascending within a node
  exec::Array<int> segment_start;    ///< [candidates + 1] CSR of the segments of this crack that the node may see
  exec::Array<int> node_segment;     ///< first points of these, ascending
  exec::Array<Vec2> hashed;          ///< [points] crack points as paths saw them when the hash was made
  exec::Array<int> serial;           ///< [points] Cracks::serial
  exec::Array<PointKind> kind;       ///< [points]

  exec::Array<Vec2> traced;  ///< [points] crack points at the last trace, as paths see them (crack_path.hpp)
  exec::Array<NodeClearance> clearance;  ///< [flagged]
  exec::Array<double> follow_at;         ///< [flagged] m, `travel` up to which nodes are left alone, or -1: in no step
  exec::Array<TileTrace> tiles;          ///< [marked tiles]
  exec::Array<int> tally;                ///< [2 candidates] crossings from above and from below
  exec::Array<std::uint8_t> verdict;     ///< [2 candidates] field, or CrossingVerdict, of a crossing of this entry
  exec::Array<std::uint8_t> held;        ///< [flagged] how many cracks the node holds
};

struct CrackFields : CrackLists {
  static constexpr int bits = most_held;  ///< of a field number
  static_assert(9 * bits <= 32);          // all neighbours of a particle in one of `fields`
  static_assert(exec::block <= 16);       // bits in `crossing`
  static constexpr double margin = 0.25;  ///< cells that a crack point may move before the hash is due

  exec::Array<SegmentNormal> segment_normals;  ///< [points] of the segments that begin there
  exec::Array<NodeNormals> normals;            ///< [flagged]
  exec::Array<ThirdNormal> third_normals;      ///< [nodes that may see three cracks or more] see NodeCracks::third
  exec::Array<int> extra;                      ///< [nodes] see grid.hpp
  int extra_slots = 0;

  exec::Array<EndOnCrack> ends;  ///< [2 cracks] first and last ends; empty where none lies on a crack

  exec::Array<double> pressed;      ///< [nodes] N s, by which faces pressed in the last momentum update
                                    ///< (pressed_faces.hpp); empty where contact does not ask
  exec::Array<std::uint8_t> stuck;  ///< [nodes] in how many updates in a row, up to 255, friction has held them, too
                                    ///< (friction_around.hpp); empty where no faces bear any
  long pressing = 0;                ///< nodes whose faces pressed

  CrackLists former;      ///< as the last trace knew them
  bool relisted = false;  ///< the lists are others since then

  // trace: crossings, and their sums for each node. They are kept from step to step and changed where a particle's
  // crossings change. Sums are of integers, so that they do not depend on the order of the particles.
  exec::Array<double> crack_move;  ///< [cracks] m, largest move of its points since the trace before
  double travel = 0;               ///< m, sum over the steps of the largest of these
  int traces = 0;                  ///< so far
  exec::Array<int> turned;         ///< [nodes] the last trace before which a node of this cell changed sides
  exec::Array<CrossingRecord> records;
  exec::Array<long> used = exec::Array<long>(1);  ///< records given away
  exec::Array<CrossingMemory> memory;  ///< [particles of marked tiles] see TileTrace::known; of tiles, too, that have
                                       ///< been marked since the last sort
  exec::Array<double> limit;           ///< [the same] as TileTrace::limit
  exec::Array<double> block_limit;     ///< [blocks of particles] the least of these; see block_of
  long order = -1;                     ///< Tiles::order of the particles that `memory` is about; -1: nothing is known
  exec::Array<std::uint8_t> recount;   ///< [flagged] 1 where sums have changed

  // assign
  exec::Array<std::uint32_t> fields;    ///< [particles] `bits` for each neighbour node, row by row from the lower left
  exec::Array<std::uint16_t> crossing;  ///< [blocks of particles] a bit for each whose `fields` is not 0; see block_of
  exec::Array<int> block_slots;         ///< [blocks of particles] where the slots of the first of these stand
  exec::Array<int> slots;  ///< grid slots of all nodes of each particle that crosses, one after the other in a tile
  long slots_used = 0;
  long warning_both_sides = 0;  ///< warning 1 (see assign_fields.hpp), summed over steps: pairs that cross a crack from
                                ///< the side which fewer pairs of the node come from
  long warning_fourth_crack = 0;  ///< warning 2: pairs that cross a crack beyond those held by the node
  Vec2 warning_place[2];          ///< the node at which each was seen first

  static RIVEN_INLINE int field_of(std::uint32_t word, int neighbour) {
    return static_cast<int>(word >> (bits * neighbour) & ((1u << bits) - 1));
  }
  /// Number of the block that begins with particle `first`, in the marked tile of this number.
  static RIVEN_INLINE long block_of(long first, long marked) { return first / exec::block + marked; }
};

}  // namespace riven
