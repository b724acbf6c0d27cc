// Where the rectangle around a tip goes, so that it leaves out the tips of other cracks (Nairn and Aimene, section
// 2.2.2, step 6 with notes 1 and 2).
#pragma once
#include <vector>

#include "core/fracture/j_domain.hpp"

namespace riven {

struct PlacedDomain {
  JDomain domain;
  bool adapted = false;  ///< an edge was moved because of another tip
  bool in_cell = false;  ///< another tip is too near for any rectangle between the two (note 2)
};

/// A rectangle about `tip` whose edges are `most` (m) away at the outside, with each edge moved in as far as needed for
/// q to be 0 at all `others` (other tips), and half a cell ahead of them, where that can be. Of the edges that leave a
/// tip out the one is moved that moves least; wherever there is room it stays two cells away from either tip. `h`: the
/// cell.
PlacedDomain place_domain(Vec2 tip, const double most[4], double h, const std::vector<Vec2>& others);

/// Edges `far` (m) from the tip, or as those of `d` where these are nearer.
JDomain core_of(const JDomain& d, double far, double h);

/// The rectangle alone: edges `reach` away.
JDomain plain_domain(Vec2 tip, const double reach[4], double h);

}  // namespace riven
