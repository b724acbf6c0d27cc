// The opening of a crack behind its tip, which tells K_I from K_II.
//
// Within a cell and a half of a tip the fields of the grid are no longer those of a crack: faces slide there by up to
// 1.4 times (at half a cell; 1.05 times at one and a half) what they do in the continuum, and open by 1.2 times.
// Further off, the next term of Williams' expansion makes its share, sqrt(r^3), which is not the same in both modes: in
// a beam split in two arms of 12 cells it is 13 % of mode I for each cell. So both terms are fitted where the first is
// sound. For one arm loaded (beam_modes.toml; K_I, K_II off by, with the tip in the middle of a cell of 1 mm, of 2 mm):
//   points from .. to, terms      1 mm              2 mm
//   0.9 .. 2.1, one               +6.1, -10.9 %     +10.0, -18.8 %
//   0.9 .. 4, two                 +2.8,  -4.8 %      +3.0,  -5.1 %
//   1.5 .. 4, two                 +2.2,  -3.6 %      +2.0,  -3.3 %
//   0.9 .. 6, three               +3.8,  -6.6 %      +5.1,  -8.9 %
#pragma once
#include <limits>

#include "core/math/vec.hpp"
#include "core/state/cracks.hpp"
#include "core/state/tips.hpp"

namespace riven {

/// Unit vector out of the tip along its last segment; of the crack as it was laid if `first`.
Vec2 heading_of(const Cracks& cracks, const Tip& tip, bool first = false);

/// Opening of the crack near its tip, x across its heading (> 0: open), y along it (> 0: the face to the left of the
/// heading has moved forwards), over the root of the distance, m^0.5: the a of
///   delta(r) = a sqrt(r) + b sqrt(r^3)
/// that fits its points from 1.5 to 4 cells behind the tip best (all the same distances in weight). `h`: the cell.
/// Of a shorter crack, or one whose faces are `whole` (m) for less than that before another crack cuts them, it is the
/// mean of delta / sqrt(r) over the points from 0.9 cells on, or that next to the tip; zero if the crack has no points
/// between its ends.
Vec2 opening_behind(const Cracks& cracks, const Tip& tip, double h,
                    double whole = std::numeric_limits<double>::infinity());

}  // namespace riven
