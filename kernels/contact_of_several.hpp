// The contacts of a node that sees several cracks, solved together (core/laws/contact_sweep.hpp).
#pragma once
#include <algorithm>

#include "core/laws/contact_sweep.hpp"
#include "kernels/contact.hpp"
#include "kernels/contact_finder.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// The contacts of a node that holds so many cracks at most and may have several meetings, from its slots to its slots.
template <int cracks, class Real, ContactStage stage>
struct NodeContact {
  using Node = ContactNodeOf<cracks>;
  using Outcome = ContactOutcomeOf<cracks>;
  static constexpr int most_pairs = Node::most_pairs;

  const FieldMotion<Real, stage>& motion;
  const ImpulseNotes& notes;
  const ContactFinder<Real>& found;
  const double dt;
  Node node{};
  long slot[Node::fields] = {};
  Meeting pair[most_pairs] = {};  ///< the meeting behind each of node.pair
  double gap[most_pairs] = {};
  double stick_gap[most_pairs] = {};
  bool firm[most_pairs] = {};  ///< an interface that is too stiff for its fields to be let go in other stages
  bool held[most_pairs] = {};  ///< by friction, as told by the nodes around
  double volume = 1;           ///< relative_volume()
  ContactReport report{};

  /// Fields of next to no mass are left out, and go on by themselves: the solution holds to so much of the node's
  /// momenta, which may be any velocity to them, and any energy.
  RIVEN_INLINE void load(const NodeCracks& n, const Lattice& lattice) {
    constexpr double least = 100 * Node::tolerance;
    double all = 0;
    for (int f = 0; f < n.fields(); ++f) {
      slot[f] = f == 0 ? n.node : long{lattice.nodes()} + n.extra + f - 1;
      node.mass[f] = motion.mass[slot[f]];
      all += node.mass[f];
    }
    for (int f = 0; f < n.fields(); ++f) {
      if (node.mass[f] <= least * all)
        node.mass[f] = 0;
      if (node.mass[f] > 0)
        node.momentum[f] = motion.momentum_of(slot[f]);
    }
  }

  RIVEN_INLINE void add(const Meeting& m, const ContactPair& p, double g) {
    pair[node.pairs] = m;
    gap[node.pairs] = g;
    node.add(p);
  }

  /// The pair that already stands for the same crack between the same groups of fields, or -1.
  RIVEN_INLINE int find_same(const Meeting& m) const {
    for (int k = 0; k < node.pairs; ++k)
      if (pair[k].k == m.k && node.together(pair[k].above, m.above) && node.together(pair[k].below, m.below))
        return k;
    return -1;
  }

  /// Of two meetings across one crack that bonded fields make one, the first to close counts, and an interface has the
  /// area of both.
  RIVEN_INLINE void list(const Meeting& m, const Verdict& v) {
    switch (v.touch) {
      case Touch::none: return;
      case Touch::apart: ++report.apart; return;
      case Touch::bonds:
        node.bond(m.above, m.below);
        ++report.touching;
        return;
      case Touch::sticks:
        stick_gap[node.stickings] = v.gap;
        node.add(StickingPair{m.above, m.below, m.normal});
        return;
      case Touch::pulls:
      case Touch::pushes: break;
    }
    const int k = find_same(m);
    if (k < 0) {
      add(m, v.pair, v.gap);
    } else if (v.touch == Touch::pulls) {
      pair[k].share += m.share;
    } else if (v.gap < gap[k]) {
      gap[k] = v.gap;
      node.pair[k] = v.pair;
    }
  }

  /// Faces that pressed in the last momentum update stay together across in the other stages, and go on as one if their
  /// law is to stick or friction has long held them (pressed_faces.hpp).
  RIVEN_INLINE void detect(const Meetings<cracks>& meetings, const NodeCracks& n) {
    const bool pressed = found.last(n.node) > 0, settled = found.settled(n.node);
    const auto as_one = [&](const Meeting& m) {
      return pressed && (m.law.law == ContactLaw::stick || (m.law.law == ContactLaw::coulomb && settled));
    };
    const auto touch = [&](const Meeting& m) {
      Verdict v = judge(found, slot, node.mass, dt, m, volume);
      if (as_one(m) && v.gap <= 0 && v.touch != Touch::apart)
        v.touch = Touch::bonds;
      if (pressed && v.gap <= 0 && v.touch == Touch::pushes)
        v.pair.unilateral = false;
      return v;
    };
    const auto given = [&](const Meeting& m) { return found.prescribed.both_given(slot, m); };
    for (const Meeting& m : meetings)
      if (m.law.law == ContactLaw::bonded || (as_one(m) && !given(m)))
        if (const Verdict v = touch(m); v.touch == Touch::bonds)
          list(m, v);
    for (const Meeting& m : meetings)
      if (!node.together(m.above, m.below) && !given(m))
        list(m, touch(m));
  }

  /// Fields whose motion is prescribed do not give way, where they are firm. One that is prescribed in one component
  /// alone does, half-way: what it resists is not given to it.
  RIVEN_INLINE void hold_prescribed() {
    constexpr double heavy = 1e6;  // tolerances of the solution go by the sum of m |v|
    double all = 0;
    for (const double m : node.mass)
      all += m;
    for (int f = 0; f < Node::fields; ++f)
      if (node.mass[f] > 0 && found.prescribed.of(slot[f]) == 3 && firmness(node.mass[f], all) == 1) {
        node.mass[f] *= heavy;
        node.momentum[f] *= heavy;
      }
  }

  /// Velocity of a group of fields before the step's forces.
  RIVEN_INLINE Vec2 first_velocity(int f) const {
    Vec2 p;
    for (int g = 0; g < Node::fields; ++g)
      if (node.mass[g] > 0 && node.together(f, g))
        p += node.mass[g] * motion.first_velocity(slot[g], dt);
    return p * (1 / node.group_mass(f));
  }

  RIVEN_INLINE void respond(int k, const ContactArea& a) {
    ContactPair& p = node.pair[k];
    const Meeting& m = pair[k];
    const double factor = m.share * a.area * dt * dt / node.reduced_mass(m.above, m.below);
    const double across = factor * m.law.normal_stiffness, along = factor * m.law.shear_stiffness;
    firm[k] = std::max(across, along) >= stiff_phase2;
    if constexpr (stage == ContactStage::after) {
      const Vec2 n = m.normal, t = turned(n), u = first_velocity(m.above) - first_velocity(m.below);
      p.across = interface_response(across, dot(u, n), dot(a.opening, n), dt);
      p.along = interface_response(along, dot(u, t), dot(a.opening, t), dt);
    } else {
      p.across = interface_hold(across);
      p.along = interface_hold(along);
    }
  }

  /// Lets friction bear what it does where it holds the faces around.
  RIVEN_INLINE void bear_along_stairs(const NodeCracks& n, long index, const Lattice& lattice) {
    for (int k = 0; k < node.pairs; ++k) {
      const Meeting& m = pair[k];
      const double mu = friction_of(m.law);
      if (mu == 0 || (found.prescribed.of(slot[m.above]) | found.prescribed.of(slot[m.below])) != 0)
        continue;
      const Stairs stairs = stairs_of(m, found.sums.place, slot, node.mass);
      const FrictionBounds b = found.around.borne(n, index, m.k, mu, stairs, lattice);
      held[k] = !b.none();
      if (held[k])
        node.pair[k].friction = b;
    }
  }

  /// Does friction hold all faces that press and bear any, of which there are some?
  RIVEN_INLINE bool all_held(const Outcome& out) const {
    bool any = false, all = true;
    for (int k = 0; k < node.pairs; ++k) {
      const auto [back, forward] = node.pair[k].friction;
      const double lambda = out.lambda[k], tau = out.tau[k];
      if (lambda > 0 && friction_of(pair[k].law) > 0) {
        any = true;
        all = all && held[k] && -back * lambda < tau && tau < forward * lambda;
      }
    }
    return any && all;
  }

  RIVEN_INLINE void tally(const Outcome& out) {
    report.capped += !out.converged;
    bool touched = false;
    for (int k = 0; k < node.pairs; ++k) {
      const bool push = out.lambda[k] != 0 || out.tau[k] != 0;
      report.touching += push;
      if (pair[k].law.law == ContactLaw::interface)
        continue;
      report.apart += !push;
      touched = touched || push;
      if (push) {
        report.penetration = std::max(report.penetration, -gap[k]);
        report.gap = std::max(report.gap, gap[k]);
      }
    }
    for (int i = 0; i < node.stickings; ++i) {
      ++(out.stuck[i] ? report.touching : report.apart);
      if (!out.stuck[i])
        continue;
      touched = true;
      report.penetration = std::max(report.penetration, -stick_gap[i]);
    }
    report.early = touched && volume < found.v_sep;
  }

  /// By what faces press, N s.
  RIVEN_INLINE double pressing(const Outcome& out) const {
    double sum = 0;
    for (int k = 0; k < node.pairs; ++k)
      if (pair[k].law.law != ContactLaw::interface)
        sum += std::max(out.lambda[k], 0.);
    for (int i = 0; i < node.stickings; ++i)
      if (out.stuck[i])
        sum += std::abs(dot(out.impulse[node.sticking[i].above], node.sticking[i].normal));
    return sum;
  }

  /// The node with those fields bonded that are one now.
  RIVEN_INLINE Node linked(const Outcome& out) const {
    Node linked = node;
    for (int k = 0; k < node.pairs; ++k)
      if (pair[k].law.law == ContactLaw::interface ? firm[k] : out.lambda[k] != 0)
        linked.bond(pair[k].above, pair[k].below);
    for (int i = 0; i < node.stickings; ++i)
      if (out.stuck[i])
        linked.bond(node.sticking[i].above, node.sticking[i].below);
    return linked;
  }

  /// Sum of m |v|, before make_ready().
  RIVEN_INLINE double momenta() const {
    double sum = 0;
    for (int f = 0; f < Node::fields; ++f)
      sum += node.mass[f] > 0 ? norm(node.momentum[f]) : 0;
    return sum;
  }

  RIVEN_INLINE HeldNormals normals(const NodeCracks& n, long index) const {
    return held_normals<cracks>(n, index, found.normals, found.third_normals);
  }

  /// What meets; false if nothing does.
  RIVEN_INLINE bool find(const NodeCracks& n, long index, const Lattice& lattice, const ContactSettings* laws) {
    load(n, lattice);
    const Meetings<cracks> meetings = find_meetings<cracks>(n, normals(n, index), node.mass, laws);
    if (meetings.count == 0)
      return false;
    found.sums.ask(index, n);
    if (found.sums.volume) {
      volume = 0;
      for (int f = 0; f < n.fields(); ++f)
        volume += found.sums.volume[slot[f]];
      volume = relative_volume(lattice, n.node, volume);
    }
    detect(meetings, n);
    return true;
  }

  /// The fields as they give way to each other, and what interfaces do.
  RIVEN_INLINE void make_ready(const NodeCracks& n, long index) {
    hold_prescribed();
    for (int k = 0; k < node.pairs; ++k)
      if (pair[k].law.law == ContactLaw::interface)
        respond(k, found.area[entry_of(n, index, pair[k].k, found.flagged)]);
  }

  /// What keeps the faces of crack k from overlapping and from sliding, N s (friction_around.hpp); `moved`: momenta().
  RIVEN_INLINE Vec2 asked(const NodeCracks& n, int k, Vec2 normal, const Node& as_one, double moved) const {
    Vec2 given;
    for (int f = 0; f < Node::fields; ++f)
      if (const bool above = (f >> k & 1) == (n.side[k] == Side::above); node.mass[f] > 0 && !above)
        given += node.mass[f] / as_one.group_mass(f) * as_one.group_momentum(f) - node.momentum[f];
    const double lambda = dot(given, normal);
    return lambda > 0 && acts(given, moved) ? Vec2{lambda, dot(given, turned(normal))} : Vec2{};
  }

  /// The same of all its cracks, to their places in ContactSums::asked.
  RIVEN_INLINE void ask(const NodeCracks& n, long index, const Lattice& lattice, const ContactSettings* laws,
                        Vec2* to) {
    bool bears[cracks], any = false;
    for (int k = 0; k < cracks; ++k) {
      bears[k] = n.crack[k] >= 0 && friction_of(laws[n.crack[k]]) > 0;
      any = any || bears[k];
    }
    const bool meets = any && find(n, index, lattice, laws);
    const double moved = momenta();
    if (meets)
      make_ready(n, index);
    const Node as_one = meets ? linked(solve(node)) : node;
    for (int k = 0; k < cracks; ++k)
      if (bears[k])
        to[entry_of(n, index, k, found.flagged)] =
            meets ? asked(n, k, normals(n, index).now(k), as_one, moved) : Vec2{};
  }

  /// Does any of them act?
  RIVEN_INLINE bool run(const NodeCracks& n, long index, const Lattice& lattice, const ContactSettings* laws) {
    if (!find(n, index, lattice, laws))
      return false;
    if (found.around.asked)
      bear_along_stairs(n, index, lattice);
    const double moved = momenta();
    make_ready(n, index);
    const Outcome out = solve(node);
    tally(out);
    if (stage == ContactStage::after && found.pressed && (found.pressed[n.node] = pressing(out)) > 0) {
      ++report.pressing;
      found.count_held(n.node, found.stuck && all_held(out));
    }
    if (stage == ContactStage::after && found.links)
      found.links[index].link_groups(linked(out).group);
    if (!out.converged)
      report.capped_node = n.node;
    bool acting = false;
    for (int f = 0; f < Node::fields; ++f) {
      if (!out.changed[f])
        continue;
      found.prescribed.give(motion, notes, index, n, slot[f], out.impulse[f], out.velocity[f], dt);
      acting = acting || acts(out.impulse[f], moved);
    }
    return acting;
  }
};

}  // namespace RIVEN_SIDE

}  // namespace riven
