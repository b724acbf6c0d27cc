// Ends cracks at their tips, wherever these lie between nodes.
//
// A node with a field for each side of a crack lets its faces part all around it; one without holds them together. So
// to the grid a crack ends some 0.6 cells beyond its last node, and as its tip moves on through a cell it does not grow
// at all, to grow by a cell when the tip reaches the next node. J of an edge crack in half of a plate under load, which
// rises by 17 % for each mm, was between +9 and -18 % of its own on cells of 2 mm, and where a stressed solid moves
// across the grid the crack ends where each node once let it end.
//
// Here the last nodes part by a share of how far those behind them do. With s the distance of a node ahead of the tip
// along the crack, in cells, w = v_above - v_below its jump and mu = m_a m_b / (m_a + m_b) its mass,
//   w_i = lambda(s_i) (phi / phi_i) W                        for  front - 1 < s < front,
//   W = sum mu_b w_b / M,  phi = sum mu_b phi_b / M,  M = sum mu_b  over  front - 2 < s < front - 1,
//   lambda = lambda_free (1 - sqrt(1 - (front - s))),
// and nothing ahead of that parts. lambda grows from 0 to what nodes at that distance do by themselves, so that they
// come free without a step; its shape is the inverse of how far a crack reaches for a given share, found with tips at
// ten places of a cell: the place of the tip then moves the end of the crack as far as itself. That is for shut cracks.
// As one opens its faces leave the nodes beyond them, and with the node d cells from the crack's line and g half the
// opening there feel what these do by
//   phi = 1 - g / (1 - d)
// of what they do when shut. The jumps are those that hold this with the least change of momentum; with
// l_i = lambda phi / phi_i
//   W = (M W* + sum l_i mu_i w_i*) / (M + sum l_i^2 mu_i),
// nodes behind moving on by W - W*: the momentum of each node is kept, and kinetic energy is lost if anything.
//
// The same J as above, tips at rows of nodes and between, along the grid and turned by 30 degrees (of the closed form):
//   2 mm  0.93 to 1.03   (without: 0.82 to 1.09)
//   1 mm  0.985 to 1.014
// And J of two tips a few cells apart over the square of the load, by which it rises as they come to open by 0.14 cells
// a cell behind them (finite elements at large strains: 1.0 %): 1.4 % with the crack on a row of nodes, 1.3 midway
// between rows (with phi = 1: 3.0 and 3.9).
#pragma once
#include "core/exec/space.hpp"
#include "core/state/state.hpp"
#include "kernels/field_impulses.hpp"

namespace riven {

/// Two velocity fields of a node on either side of a tip's crack.
struct BridgedPair {
  int node;
  int flagged;        ///< position in CrackFields::nodes
  long above, below;  ///< slots
  double share;       ///< lambda / phi, or -phi for a node behind
  Vec2 force;         ///< N, on the field above, in the momentum update
};

/// Those around one tip.
struct TipBridge {
  static constexpr int most = 64;
  int count;
  BridgedPair pair[most];
};

/// Those around all tips.
struct TipBridges {
  exec::Array<TipBridge> of_tip;  ///< [tips] of State::tips
  exec::Array<int> start;         ///< [groups + 1] tips that are near enough to share nodes, and have to wait for each
  exec::Array<int> tip;           ///< other; the groups need not
};

inline namespace RIVEN_SIDE {

/// Finds the nodes around all open tips.
template <class Real>
void list_bridges(const exec::Space&, const State<Real, 2>&, TipBridges&);

/// Changes their motion, the tips of a group in turns until they agree, and notes the impulses; `last`: that of the
/// last term of higher orders.
template <class Real>
void bridge_tips(const exec::Space&, State<Real, 2>&, TipBridges&, ContactStage, FieldImpulses&, bool last = false);

}  // namespace RIVEN_SIDE

}  // namespace riven
