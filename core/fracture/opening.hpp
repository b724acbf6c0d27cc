// The opening of a crack behind its tip.
#pragma once
#include "core/math/vec.hpp"
#include "core/state/cracks.hpp"
#include "core/state/tips.hpp"

namespace riven {

/// Unit vector out of the tip along its last segment; of the crack as it was laid if `first`.
Vec2 heading_of(const Cracks& cracks, const Tip& tip, bool first = false);

/// Opening behind a tip, x across its heading (> 0: open), y along it (> 0: the face to the left of the heading has
/// moved forwards), summed over the points that are between `from` and `to` (m) behind it; if there is none, of the one
/// next to it.
Vec2 opening_behind(const Cracks& cracks, const Tip& tip, double from, double to);

}  // namespace riven
