// The velocity fields of a node that move with a rigid particle near cracks: those on the particle's side of them.
#pragma once
#include <algorithm>
#include <cstdint>
#include <limits>

#include "core/fracture/beyond_end.hpp"
#include "core/fracture/crossing.hpp"
#include "core/state/cracks.hpp"
#include "kernels/lists_view.hpp"

namespace riven {

/// Sees nodes as a particle of the body in the same place would (trace_crossings.hpp), but for one next to a crack,
/// which the body moves past it by little: it stays on the side where it was at first.
class RigidSight {
 public:
  /// Fields must have been determined in this step.
  RigidSight(const Lattice& lattice, const Cracks& cracks, const CrackFields& fields)
      : lists_(lists_view(lattice, fields)),
        any_(!fields.nodes.empty()),
        tally_(exec::data(fields.tally)),
        verdict_(exec::data(fields.verdict)),
        traced_(exec::data(fields.traced)),
        plane0_(exec::data(cracks.plane0)),
        start_(exec::data(cracks.start)),
        laws_(exec::data(cracks.contact)) {}

  bool sees_cracks(int node) const { return any_ && lists_.node_index[node] >= 0; }

  /// A bit for each field of the node that moves with a rigid particle at x: none where no body on its side of a crack
  /// reaches the node, and those on both sides of a crack that is bonded. `x0`: where the particle was at first; null
  /// for a place that is no particle's.
  unsigned fields_of(Vec2 x, const Vec2* x0, int node) const {
    if (!sees_cracks(node))
      return 1;
    const int f = lists_.node_index[node];
    unsigned fields = 1;
    for (int c = lists_.candidate_start[f]; c < lists_.candidate_start[f + 1]; ++c) {
      const std::uint8_t above = verdict_[2 * c], below = verdict_[2 * c + 1];
      const bool held = tally_[2 * c] + tally_[2 * c + 1] > 0;
      if (laws_[lists_.candidate[c]].law == ContactLaw::bonded) {
        if (const std::uint8_t field = std::min(above, below); held && field < other_side)
          fields |= fields << field;
        continue;
      }
      const Vec2 at = lists_.lattice.position(node);
      const Nearest to_node = nearest(traced_, at, c), at_first = x0 ? nearest(plane0_, *x0, c) : Nearest{};
      const bool stays = at_first.distance < beside * lists_.lattice.h &&
                         nearest(traced_, x, c).distance < next_to * lists_.lattice.h && (held || !to_node.beyond);
      Side side = Side::none;
      if (!stays)
        side = crossed(x, at, c, held);
      else if (held || (at_first.turn >= 0) != (to_node.turn > 0))  // what lies on a crack: crossing.hpp
        side = at_first.turn >= 0 ? Side::above : Side::below;
      if (side == Side::none)
        continue;
      if (!held)
        return 0;
      if (const std::uint8_t field = side == Side::above ? above : below; field < other_side)
        fields <<= field;
    }
    return fields;
  }

  /// From x to the cracks that the node, which sees some, may see, m.
  double distance_to_cracks(Vec2 x, int node) const {
    const int f = lists_.node_index[node];
    double least = std::numeric_limits<double>::infinity();
    for (int c = lists_.candidate_start[f]; c < lists_.candidate_start[f + 1]; ++c)
      least = std::min(least, nearest(traced_, x, c).distance);
    return least;
  }

 private:
  static constexpr double beside = 1.5, next_to = 0.5;  ///< cells, at first and now

  struct Nearest {
    double distance = std::numeric_limits<double>::infinity();  ///< m
    int turn = 0;                                               ///< > 0 above the line through the segment, < 0 below
    bool beyond = false;                                        ///< it is an end of the crack that is nearest
  };

  /// Of the segments that a node may see of its candidate c, the one nearest to x.
  Nearest nearest(const Vec2* point, Vec2 x, int c) const {
    const int crack = lists_.candidate[c], first = start_[crack], last = start_[crack + 1] - 1;
    Nearest least;
    for (int at = lists_.segment_start[c]; at < lists_.segment_start[c + 1]; ++at) {
      const int k = lists_.node_segment[at];
      const Vec2 a = point[k], b = point[k + 1], d = b - a;
      const double length2 = dot(d, d), t = length2 > 0 ? std::clamp(dot(x - a, d) / length2, 0., 1.) : 0;
      if (const double distance = norm(x - a - t * d); distance < least.distance)
        least = {distance, orientation(a, b, x), (k == first && t == 0) || (k + 1 == last && t == 1)};
    }
    return least;
  }

  /// The side from which the path from x to n, a node, crosses its candidate c. Where the node holds that crack, it
  /// goes on beyond its ends: grips reach farther out of a body than the mouths of its cracks are drawn.
  Side crossed(Vec2 x, Vec2 n, int c, bool held) const {
    const int crack = lists_.candidate[c], first = start_[crack], last = start_[crack + 1] - 1;
    CrossingSum sum;
    for (int at = lists_.segment_start[c]; at < lists_.segment_start[c + 1]; ++at) {
      const int k = lists_.node_segment[at];
      sum.add(crossing(x, n, traced_ + k, k == first, k + 1 == last));
      if (held && k == first)
        sum.add(beyond(first, false).crossed(x, n));
      if (held && k + 1 == last)
        sum.add(beyond(last, true).crossed(x, n));
    }
    return sum.side();
  }

  BeyondEnd beyond(int point, bool last) const { return {traced_ + point, last, crossed_beyond * lists_.lattice.h}; }

  ListsView lists_;
  bool any_;
  const int* tally_;
  const std::uint8_t* verdict_;
  const Vec2 *traced_, *plane0_;
  const int* start_;
  const ContactSettings* laws_;
};

}  // namespace riven
