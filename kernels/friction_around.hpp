// Whether friction holds faces that are pressed together, as told by the nodes around.
//
// Particles lie as a whole on one side of a crack or the other, so that the fields of a node meet along stairs. What
// the solid presses them together with acts along the normal of the few steps that the node sees, not along that of
// the crack: under the same pressure all around and at 17 degrees to the grid the faces need up to 0.52 of what presses
// them to stay as they are, and more next to a tip. Added up over the node and those next to it these parts cancel
// (0.01 and 0.04 are left there). So with lambda the impulse that keeps the faces of a node from overlapping and tau
// the one that keeps them from sliding, they stick where
//   |sum tau| <= mu sum lambda      over the 3 x 3 nodes around, of this crack;
// elsewhere they slide by the law of their own node (core/laws/contact.hpp). Judged by each node alone, a crack that
// friction of 0.6 should hold altogether slips at its ends: to 0.07 (FMPM(1)) to 0.37 (FLIP) of its stress intensity
// without friction.
//
// A node that sees several cracks knows lambda and tau of each from what makes one of the fields that press together:
// with V their common velocity and m, v a field's own, n and t the normal and the tangent of the crack,
//   lambda n + tau t = sum m (V - v)      over the fields below the crack.
// That is well defined where four fields meet in a ring, in which an impulse that goes round changes nothing. Faces
// that still have a gap to close count there as shut.
//
// A node that sticks so bears no more than its stairs explain,
//   tau / lambda within [min(0, s) - r, max(0, s) + r],   s = d.t / d.n,   r = 2 mu (1 + s^2)
// with d from the mean position of the upper field's particles to that of the lower one's, which has the direction of
// the stairs' normal: tan of the angles above, to 0.01. Unbounded, impulses of either sign grow from node to node next
// to where faces slide, and K_II there in 1000 us from 0.8 to 1.16 of 0.9 MPa m^0.5; with 3 mu contact makes 1 % of the
// energy of a plate at 45 degrees, and with mu faces next to a tip that should be held slip with FLIP. A node that is
// pressed less than those around are in the mean bears as much as they do: a field of few particles is, and let go it
// moves alone, until FLIP has stress beside a crack at 130 degrees off by all of the pressure that holds it.
//
// Faces that have stuck in `settled` updates in a row go on as those of the law stick do in the stages without forces:
// let go there, those that are next to sliding creep on. It is alike with 4 and with 30 updates.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/laws/contact.hpp"
#include "kernels/contact_meetings.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// Slopes of the stairs, to either side of the crack's own.
struct Stairs {
  double least, most;
};

/// Those along which the fields of a meeting meet; `place`: ContactSums, null where not summed.
RIVEN_INLINE Stairs stairs_of(const Meeting& m, const double* place, const long* slot, const double* mass) {
  constexpr double steepest = 10;
  if (!place)
    return {-1, 1};
  const Vec2 d = between_means(m, place, slot, mass);
  const double across = dot(d, m.normal), along = dot(d, turned(m.normal));
  const double slope = across > std::abs(along) / steepest ? along / across : std::copysign(steepest, along);
  return {std::min(0., slope), std::max(0., slope)};
}

/// What a node that sticks bears along its faces; `around`: by how much more than on it the faces around press, if
/// more.
RIVEN_INLINE FrictionBounds held_along_stairs(double friction, double around, Stairs s) {
  const double steep = std::max(-s.least, s.most), more = 2 * friction * (1 + steep * steep);
  const double share = std::clamp(around, 1., 100.);  // a field of next to nothing is no matter
  return {share * (more - s.least), share * (s.most + more)};
}

struct FrictionAround {
  static constexpr std::uint8_t settled = 10;

  const Vec2* asked = nullptr;  ///< lambda and tau, N s, at entry_of() each; null where no faces bear friction
  const int* node_index = nullptr;
  const NodeCracks* nodes = nullptr;
  const std::uint8_t* held = nullptr;
  long flagged = 0;

  RIVEN_INLINE Vec2 asked_at(long index, int k) const { return asked[entry_of(nodes[index], index, k, flagged)]; }

  /// What friction bears at crack k of a node, if it holds the faces there; else none. `s`: of the two fields.
  RIVEN_INLINE FrictionBounds borne(const NodeCracks& n, long index, int k, double friction, Stairs s,
                                    const Lattice& l) const {
    const int i = n.node % l.nx, j = n.node / l.nx;
    const double own = asked_at(index, k).x;
    Vec2 sum;
    int pressing = 0;
    for (int y = j > 0 ? j - 1 : 0; y <= j + 1 && y < l.ny; ++y)
      for (int x = i > 0 ? i - 1 : 0; x <= i + 1 && x < l.nx; ++x)
        if (const int at = node_index[y * l.nx + x]; at >= 0 && held[at] > 0)
          if (const int which = nodes[at].which(n.crack[k]); which >= 0) {
            sum += asked_at(at, which);
            pressing += asked_at(at, which).x > 0;
          }
    if (!(own > 0) || std::abs(sum.y) > friction * sum.x)
      return {};
    return held_along_stairs(friction, sum.x / pressing / own, s);
  }
};

}  // namespace RIVEN_SIDE

}  // namespace riven
