// All contacts of one node solved together. A node that holds two cracks has up to four fields and up to four pairs of
// them, one that holds three up to eight and twelve; a field takes part in two or three pairs where cracks meet, so
// that pair after pair in one sweep satisfies only the last.
#pragma once
#include <algorithm>

#include "core/laws/contact.hpp"

namespace riven {

/// Pairs of fields that meet at a node which holds so many cracks, at most: those that differ on one crack only. A pair
/// that differs on more meets only where at least as many of these are missing.
constexpr int most_pairs_of(int cracks) {
  return cracks << (cracks - 1);
}

template <int cracks>
struct ContactNodeOf {
  static constexpr int fields = 1 << cracks, most_pairs = most_pairs_of(cracks);
  static constexpr int most_sweeps = 2000;
  static constexpr double tolerance = 1e-14;  ///< of the node's sum of m |v|

  double mass[fields] = {};  ///< kg; 0 where a field is absent
  Vec2 momentum[fields];     ///< kg m/s
  int group[fields];
  ContactPair pair[most_pairs];
  int pairs = 0;
  StickingPair sticking[most_pairs];
  int stickings = 0;

  RIVEN_INLINE ContactNodeOf() {
    for (int f = 0; f < fields; ++f)
      group[f] = f;
  }
  /// Makes two fields move as one.
  RIVEN_INLINE void bond(int f, int g) {
    const int from = std::max(group[f], group[g]), to = std::min(group[f], group[g]);
    for (int& x : group)
      if (x == from)
        x = to;
  }
  RIVEN_INLINE bool together(int f, int g) const { return group[f] == group[g]; }
  RIVEN_INLINE double group_mass(int f) const {
    double m = 0;
    for (int g = 0; g < fields; ++g)
      if (together(f, g))
        m += mass[g];
    return m;
  }
  RIVEN_INLINE Vec2 group_momentum(int f) const {
    Vec2 p;
    for (int g = 0; g < fields; ++g)
      if (together(f, g) && mass[g] > 0)
        p += momentum[g];
    return p;
  }
  /// Mass of the relative motion of two groups.
  RIVEN_INLINE double reduced_mass(int f, int g) const {
    const double a = group_mass(f), b = group_mass(g);
    return a * b / (a + b);
  }
  RIVEN_INLINE void add(const ContactPair& p) { pair[pairs++] = p; }
  RIVEN_INLINE void add(const StickingPair& p) { sticking[stickings++] = p; }
};

using ContactNode = ContactNodeOf<2>;

/// What contact made of a node.
template <int cracks>
struct ContactOutcomeOf {
  using Node = ContactNodeOf<cracks>;
  Vec2 velocity[Node::fields];  ///< m/s
  Vec2 impulse[Node::fields];   ///< change of momentum, kg m/s
  bool changed[Node::fields] = {};
  double lambda[Node::most_pairs] = {};  ///< normal impulse of each pair, kg m/s
  double tau[Node::most_pairs] = {};     ///< tangential impulse of each pair
  bool stuck[Node::most_pairs] = {};     ///< of Node::sticking
  int sweeps = 0;
  bool converged = true;
};
using ContactOutcome = ContactOutcomeOf<2>;

}  // namespace riven
