#include "kernels/trace_crossings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/exec/parallel.hpp"
#include "core/fracture/crack_path.hpp"
#include "kernels/carry_traces.hpp"
#include "kernels/known_particles.hpp"
#include "kernels/tracer.hpp"
#include "kernels/turned.hpp"

namespace riven {

namespace {

/// Marked tiles that one task traces.
constexpr long tiles_of_task = 8;

/// Forgets all crossings, after a sort or when room ran out.
void begin_anew(const Tiles& tiles, long particles, const Lattice& lattice, const Cracks& cracks, CrackFields& fields) {
  fields.turned.resize(lattice.nodes());
  fields.block_limit.resize(particles / exec::lanes + fields.marked_tiles.size() + 1);
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
  fields.used = 0;
  fields.slots_used = 0;
}

/// Moves of the cracks since the last trace.
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

/// Nearer than this (in cells) to a segment, nodes are followed by their sides.
constexpr double near_cells = 0.02;

/// Distance of a node from its segments, and which of them it is next to. Next to any but one or two joined ones it is
/// not followed.
void measure_node(const Lattice& lattice, const Cracks& cracks, const CrackFields& fields, long f, NodeClearance& c) {
  const Vec2 x = lattice.position(fields.nodes[f].node);
  const double near2 = near_cells * near_cells * lattice.h * lattice.h;
  double least2 = std::numeric_limits<double>::max(), others2 = least2;
  int count = 0, segment[2] = {-1, -1};
  const int end = fields.segment_start[fields.candidate_start[f + 1]];
  for (int s = fields.segment_start[fields.candidate_start[f]]; s < end; ++s) {
    const int k = fields.node_segment[s];
    const double d2 = distance2(x, fields.traced[k], fields.traced[k + 1]);
    least2 = std::min(least2, d2);
    if (d2 >= near2)
      others2 = std::min(others2, d2);
    else if (count++ < 2)
      segment[count - 1] = k;
  }
  const bool joined =
      count == 2 && segment[1] == segment[0] + 1 && cracks.crack[segment[0]] == cracks.crack[segment[1]];
  const bool followed = count == 1 || joined;
  c.measured = std::sqrt(followed ? others2 : least2);
  c.travel = fields.travel;
  c.near = followed ? segment[0] : -1;
  c.joined = joined;
}

/// `travel` of the cracks after which a node is measured again: they have moved by a good part of its distance.
double measured_until(const Lattice& lattice, const NodeClearance& c) {
  return c.travel + std::max(0.25 * c.measured, 0.1 * near_cells * lattice.h);
}

/// Measures the distance of a node from the cracks again where that is due, and sees on which sides of a segment it is
/// that it is next to. Returns whether it has come to another side, or next to another segment.
bool follow_node(const Lattice& lattice, const Cracks& cracks, CrackFields& fields, long f, bool afresh) {
  NodeClearance& c = fields.clearance[f];
  const NodeClearance before = c;
  if (afresh || fields.travel > measured_until(lattice, c))
    measure_node(lattice, cracks, fields, f, c);
  fields.follow_at[f] = c.near >= 0 ? -1 : measured_until(lattice, c);
  if (c.near >= 0) {
    const Vec2* at = fields.traced.data() + c.near;
    const Vec2 x = lattice.position(fields.nodes[f].node);
    c.sides = c.joined ? pack_sides(orientation(at[0], at[1], x), orientation(at[1], at[2], x),
                                    orientation(at[0], at[1], at[2]))
                       : pack_sides(orientation(at[0], at[1], x), 0, 0);
  }
  return !afresh && (before.near != c.near || before.joined != c.joined || (c.near >= 0 && before.sides != c.sides));
}

}  // namespace

template <class Shape, class Real>
void trace_crossings(const exec::Space& space, const Particles<Real, 2>& particles,
                     const DomainSetting<Real, 2>* domains, const Lattice& lattice, const Cracks& cracks,
                     const double* tile_move, CrackFields& fields) {
  const exec::Stopwatch watch(space.timers(), "trace crossings");
  const bool afresh = fields.order != particles.tiles.order || fields.fields.size() != particles.count();
  ++fields.traces;
  if (afresh)
    begin_anew(particles.tiles, particles.count(), lattice, cracks, fields);
  else if (fields.relisted)
    carry_traces(space, particles.tiles, lattice, cracks, fields);
  fields.order = particles.tiles.order;
  fields.relisted = false;
  follow_moves(space, lattice, cracks, fields);
  exec::launch(space, (fields.nodes.size() + exec::chunk - 1) / exec::chunk, [&](long c) {
    const long end = std::min(fields.nodes.size(), (c + 1) * exec::chunk);
    for (long f = c * exec::chunk; f < end; ++f)
      if ((afresh || fields.travel > fields.follow_at[f]) && follow_node(lattice, cracks, fields, f, afresh))
        turn_node(lattice, fields.nodes[f].node, fields);
  });
  const bool shared = space.threads() > 1;
  const TraceInput<Real> input{particles, domains, lattice, cracks, tile_move};
  for (;;) {
    const long tiles = fields.marked_tiles.size();
    exec::launch(space, (tiles + tiles_of_task - 1) / tiles_of_task, [&](long task) {
      const long first = task * tiles_of_task;
      Tracer<Shape, Real>(input, fields, shared).tiles(first, std::min(tiles, first + tiles_of_task));
    });
    if (fields.used <= fields.records.size())
      return;
    fields.records.resize(fields.used + fields.used / 2);
    begin_anew(particles.tiles, particles.count(), lattice, cracks, fields);
  }
}

#define RIVEN_TRACE(Shape, Real)                                                                           \
  template void trace_crossings<Shape, Real>(const exec::Space&, const Particles<Real, 2>&,                \
                                             const DomainSetting<Real, 2>*, const Lattice&, const Cracks&, \
                                             const double*, CrackFields&);
#define RIVEN_TRACE_EACH(Real) RIVEN_EACH_SHAPE(RIVEN_TRACE, Real)
RIVEN_EACH_REAL(RIVEN_TRACE_EACH)
#undef RIVEN_TRACE_EACH
#undef RIVEN_TRACE

}  // namespace riven
