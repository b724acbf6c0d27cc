// Whether friction holds faces that are pressed together, as told by the nodes around.
//
// Particles lie as a whole on one side of a crack or the other, so that the fields of a node meet along stairs. What
// the solid presses them together with acts along the normal of the few steps that the node sees, not along that of
// the crack: under the same pressure all around and at 17 degrees to the grid the faces need up to 0.52 of what presses
// them to stay as they are, and more next to a tip. Added up over the node and those next to it these parts cancel
// (0.01 and 0.04 are left there). So with lambda the impulse that keeps the faces of a node from overlapping and tau
// the one that keeps them from sliding, they stick where
//   |sum tau| <= mu sum lambda      over the 3 x 3 nodes around that see this crack alone;
// elsewhere they slide by the law of their own node (core/laws/contact.hpp). Judged by each node alone, a crack that
// friction of 0.6 should hold altogether slips at its ends: to 0.07 (FMPM(1)) to 0.37 (FLIP) of its stress intensity
// without friction.
//
// A node that sticks so bears no more than its stairs explain,
//   tau / lambda within [min(0, s) - r, max(0, s) + r],   s = d.t / d.n,   r = 2 mu (1 + s^2)
// with d from the mean position of the upper field's particles to that of the lower one's, which has the direction of
// the stairs' normal: tan of the angles above, to 0.01. Unbounded, impulses of either sign grow from node to node next
// to where faces slide, and K_II there in 1000 us from 0.8 to 1.16 of 0.9 MPa m^0.5; with 3 mu contact makes 1 % of the
// energy of a plate at 45 degrees, and with mu faces next to a tip that should be held slip with FLIP.
//
// Faces that have stuck in `settled` updates in a row go on as those of the law stick do in the stages without forces:
// let go there, those that are next to sliding creep on. It is alike with 4 and with 30 updates.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/state/crack_fields.hpp"
#include "core/state/grid.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// Slopes of the stairs, to either side of the crack's own.
struct Stairs {
  double least, most;
};

/// What a node that sticks bears along its faces of what would hold them, N s.
RIVEN_INLINE double held_along_stairs(double to_stick, double pressed, double friction, Stairs s) {
  const double steep = std::max(-s.least, s.most), more = 2 * friction * (1 + steep * steep);
  return std::clamp(to_stick, (s.least - more) * pressed, (s.most + more) * pressed);
}

struct FrictionAround {
  static constexpr std::uint8_t settled = 10;

  const Vec2* asked = nullptr;  ///< [flagged] lambda and tau, N s; null where no faces bear friction
  const int* node_index = nullptr;
  const NodeCracks* nodes = nullptr;
  const std::uint8_t* held = nullptr;

  /// Does friction hold the faces of a node that sees one crack?
  RIVEN_INLINE bool holds(const NodeCracks& n, double friction, const Lattice& l) const {
    const int i = n.node % l.nx, j = n.node / l.nx;
    Vec2 sum;
    for (int y = j > 0 ? j - 1 : 0; y <= j + 1 && y < l.ny; ++y)
      for (int x = i > 0 ? i - 1 : 0; x <= i + 1 && x < l.nx; ++x)
        if (const int k = node_index[y * l.nx + x]; k >= 0 && held[k] == 1 && nodes[k].crack[0] == n.crack[0])
          sum += asked[k];
    return std::abs(sum.y) <= friction * sum.x;
  }
};

}  // namespace RIVEN_SIDE

}  // namespace riven
