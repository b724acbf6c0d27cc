// The velocity fields of a node that move with a rigid particle near cracks: those on the particle's side of them.
#pragma once
#include <algorithm>
#include <cstdint>

#include "core/fracture/beyond_end.hpp"
#include "core/fracture/crossing.hpp"
#include "core/state/cracks.hpp"
#include "kernels/lists_view.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// Sees nodes as a particle of the body in its place would (trace_crossings.hpp), but adds nothing to what they hold.
class RigidSight {
 public:
  /// Fields must have been determined in this step.
  RigidSight(const Lattice& lattice, const Cracks& cracks, const CrackFields& fields)
      : lists_(lists_view(lattice, fields)),
        any_(!fields.nodes.empty()),
        tally_(exec::data(fields.tally)),
        verdict_(exec::data(fields.verdict)),
        traced_(exec::data(fields.traced)),
        start_(exec::data(cracks.start)),
        laws_(exec::data(cracks.contact)) {}

  bool sees_cracks(int node) const { return any_ && lists_.node_index[node] >= 0; }

  /// A bit for each field of the node that moves with a rigid particle at x: none where no body on its side of a crack
  /// reaches the node, and those on both sides of a crack that is bonded.
  unsigned fields_of(Vec2 x, int node) const {
    const int f = any_ ? lists_.node_index[node] : -1;
    unsigned fields = 1;
    for (int c = f < 0 ? 0 : lists_.candidate_start[f]; f >= 0 && c < lists_.candidate_start[f + 1]; ++c) {
      const std::uint8_t above = verdict_[2 * c], below = verdict_[2 * c + 1];
      const bool held = tally_[2 * c] + tally_[2 * c + 1] > 0;
      if (laws_[lists_.candidate[c]].law == ContactLaw::bonded) {
        if (const std::uint8_t field = std::min(above, below); held && field < other_side)
          fields |= fields << field;
        continue;
      }
      const Side side = crossed(x, lists_.lattice.position(node), c, held);
      if (side == Side::none)
        continue;
      if (!held)
        return 0;
      if (const std::uint8_t field = side == Side::above ? above : below; field < other_side)
        fields <<= field;
    }
    return fields;
  }

 private:
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
  const Vec2* traced_;
  const int* start_;
  const ContactSettings* laws_;
};

}  // namespace RIVEN_SIDE

}  // namespace riven
