#include "kernels/trace_crossings.hpp"

#include <cmath>
#include <limits>

#include "core/exec/parallel.hpp"
#include "kernels/begin_traces.hpp"
#include "kernels/carry_traces.hpp"
#include "kernels/follow_moves.hpp"
#include "kernels/trace_tiles.hpp"
#include "kernels/turned.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

namespace {

/// Nearer than this (in cells) to a segment, nodes are followed by their sides.
constexpr double near_cells = 0.02;

/// How nodes are followed while cracks move past them.
struct NodeFollower {
  ListsView lists;
  Turning turning;
  const int* crack;    ///< Cracks
  const Vec2* traced;  ///< CrackFields
  const NodeCracks* nodes;
  NodeClearance* clearance;
  double* follow_at;
  double travel;  ///< CrackFields
  bool afresh;    ///< nothing is known

  RIVEN_FN bool due(long f) const { return afresh || travel > follow_at[f]; }

  /// Measures the distance of a node from the cracks again where that is due, and sees on which sides of a segment it
  /// is that it is next to. If it has come to another side, or next to another segment, it is turned.
  RIVEN_FN void follow(long f) const {
    NodeClearance& c = clearance[f];
    const NodeClearance before = c;
    if (afresh || travel > measured_until(c))
      measure(f, c);
    follow_at[f] = c.near >= 0 ? -1 : measured_until(c);
    if (c.near >= 0) {
      const Vec2* at = traced + c.near;
      const Vec2 x = lists.lattice.position(nodes[f].node);
      c.sides = c.joined ? pack_sides(orientation(at[0], at[1], x), orientation(at[1], at[2], x),
                                      orientation(at[0], at[1], at[2]))
                         : pack_sides(orientation(at[0], at[1], x), 0, 0);
    }
    if (!afresh && (before.near != c.near || before.joined != c.joined || (c.near >= 0 && before.sides != c.sides)))
      turning.node(nodes[f].node);
  }

 private:
  /// `travel` of the cracks after which a node is measured again: they have moved by a good part of its distance.
  RIVEN_FN double measured_until(const NodeClearance& c) const {
    return c.travel + std::max(0.25 * c.measured, 0.1 * near_cells * lists.lattice.h);
  }

  /// Distance of a node from its segments, and which of them it is next to. Next to any but one or two joined ones it
  /// is not followed.
  RIVEN_FN void measure(long f, NodeClearance& c) const {
    const Vec2 x = lists.lattice.position(nodes[f].node);
    const double near2 = near_cells * near_cells * lists.lattice.h * lists.lattice.h;
    double least2 = std::numeric_limits<double>::max(), others2 = least2;
    int count = 0, segment[2] = {-1, -1};
    const int end = lists.segment_start[lists.candidate_start[f + 1]];
    for (int s = lists.segment_start[lists.candidate_start[f]]; s < end; ++s) {
      const int k = lists.node_segment[s];
      const double d2 = distance2(x, traced[k], traced[k + 1]);
      least2 = std::min(least2, d2);
      if (d2 >= near2)
        others2 = std::min(others2, d2);
      else if (count++ < 2)
        segment[count - 1] = k;
    }
    const bool joined = count == 2 && segment[1] == segment[0] + 1 && crack[segment[0]] == crack[segment[1]];
    const bool followed = count == 1 || joined;
    c.measured = std::sqrt(followed ? others2 : least2);
    c.travel = travel;
    c.near = followed ? segment[0] : -1;
    c.joined = joined;
  }
};

void follow_nodes(const exec::Space& space, const Lattice& lattice, const Cracks& cracks, bool afresh,
                  CrackFields& fields) {
  const NodeFollower follower{lists_view(lattice, fields),
                              turning(lattice, fields),
                              exec::data(cracks.crack),
                              exec::data(std::as_const(fields.traced)),
                              exec::data(std::as_const(fields.nodes)),
                              exec::data(fields.clearance),
                              exec::data(fields.follow_at),
                              fields.travel,
                              afresh};
  exec::launch_some(space, fields.nodes.size(), exec::few, [=] RIVEN_KERNEL(long f) {
    if (follower.due(f))
      follower.follow(f);
  });
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
    begin_traces(space, particles.tiles, particles.count(), lattice, cracks, fields);
  else if (fields.relisted)
    carry_traces(space, particles.tiles, lattice, cracks, fields);
  fields.order = particles.tiles.order;
  fields.relisted = false;
  follow_moves(space, lattice, cracks, fields);
  follow_nodes(space, lattice, cracks, afresh, fields);
  for (;;) {
    const TraceInput<Real> input{lists_view(lattice, fields),
                                 exec::data(particles.x[0]),
                                 exec::data(particles.x[1]),
                                 exec::data(particles.body),
                                 exec::data(particles.tiles.start),
                                 domains,
                                 tile_move,
                                 exec::data(cracks.crack),
                                 exec::data(cracks.start),
                                 exec::data(std::as_const(fields.traced)),
                                 fields.ends.empty() ? nullptr : exec::data(std::as_const(fields.ends)),
                                 exec::data(std::as_const(fields.crack_move)),
                                 exec::data(std::as_const(fields.clearance)),
                                 exec::data(std::as_const(fields.turned)),
                                 fields.travel,
                                 fields.traces,
                                 exec::data(fields.tiles),
                                 exec::data(fields.memory),
                                 exec::data(fields.limit),
                                 exec::data(fields.block_limit)};
    trace_tiles<Shape, Real>(space, fields.marked_tiles.size(), input, crossing_store(fields, exec::concurrent(space)));
    const long used = std::as_const(fields.used)[0];
    if (used <= fields.records.size())
      return;
    fields.records.resize(used + used / 2);
    begin_traces(space, particles.tiles, particles.count(), lattice, cracks, fields);
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

}  // namespace RIVEN_SIDE

}  // namespace riven
