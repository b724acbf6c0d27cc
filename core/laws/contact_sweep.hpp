// Solves all contacts of a node together.
//
// Bonded fields are merged and move with their common velocity, exactly; so do sticking fields from the moment that
// they approach each other. The impulses of the other pairs are accumulated and projected pair by pair (Gauss-Seidel on
// the conditions in contact.hpp) until a sweep changes none by more than 1e-14 of the node's sum of m |v|. A light
// field between heavy ones lets sweeps creep (they pass on its own momentum each time), and so do two stiff interfaces
// side by side; after some sweeps the linear equations that follow from the pairs' states (apart, held, sliding) are
// solved directly, the states being corrected until they agree with the solution, and the sweeps go on from there.
//
// Momentum is kept because each pair gives its fields opposite impulses. Everything is in double.
#pragma once
#include <algorithm>
#include <cmath>

#include "core/laws/contact_equations.hpp"

namespace riven {

namespace detail {

/// The sweeps over the pairs of a node.
template <int cracks>
struct ContactSweep : ContactEquations<cracks> {
  using Base = ContactEquations<cracks>;
  using Node = ContactNodeOf<cracks>;
  using Outcome = ContactOutcomeOf<cracks>;
  using Base::above, Base::below, Base::mass, Base::node, Base::number, Base::pairs, Base::r, Base::reduced, Base::tiny;
  using Base::approach, Base::exchange, Base::pair, Base::solve_directly, Base::velocity;
  static constexpr int few_pairs = 4;  ///< whose combinations of states can all be tried

  RIVEN_INLINE ContactSweep(const Node& n, double scale) : Base(n, scale) {}

  /// One visit of pair k; returns the size of the change of its impulse.
  RIVEN_INLINE double visit(int k) {
    const ContactPair& p = pair(k);
    const Vec2 n = p.normal, t = turned(n), u = approach(k);
    const double m = reduced[k];
    const auto [lambda, tau] = pair_impulse(p, {m, m}, {dot(u, n) + r[2 * k] / m, dot(u, t) + r[2 * k + 1] / m});
    const double dn = lambda - r[2 * k], dt = tau - r[2 * k + 1];
    r[2 * k] = lambda;
    r[2 * k + 1] = tau;
    exchange(k, dn * n + dt * t);
    return std::max(std::abs(dn), std::abs(dt));
  }

  /// A field so light that sweeps change next to nothing while its heavy neighbours still approach each other.
  RIVEN_INLINE bool uneven() const {
    double least = reduced[0], most = 0;
    for (int k = 0; k < pairs; ++k) {
      least = std::min(least, reduced[k]);
      most = std::max({most, mass[above[k]], mass[below[k]]});
    }
    return least < 1e-2 * most;
  }

  /// Sweeps until nothing changes; returns the number of sweeps, with `limit` exceeded if that does not happen.
  RIVEN_INLINE int sweep(int limit) {
    bool finished = pairs == 1 || !uneven();
    int count = 0;
    for (int next = 8;;) {
      double change = 0;
      for (int k = 0; k < pairs; ++k)
        change = std::max(change, visit(k));
      ++count;
      const bool settled = pairs == 1 || change <= tiny;
      if (settled && finished)
        return count;
      if (count >= limit)
        return settled ? count : limit + 1;
      if (settled || count == next) {
        const bool solved = solve_directly(count >= 64 && pairs <= few_pairs);
        finished = finished || settled || solved;
        if (count == next)
          next *= 2;
      }
    }
  }

  /// Merges the sticking fields that approach each other; true if there were any.
  RIVEN_INLINE bool stick(Node& n, Outcome& out) const {
    bool any = false;
    for (int i = 0; i < node.stickings; ++i) {
      const StickingPair& s = node.sticking[i];
      if (out.stuck[i] || node.together(s.above, s.below))
        continue;
      const double u = dot(velocity(s.above) - velocity(s.below), s.normal);
      out.stuck[i] = node.reduced_mass(s.above, s.below) * u > tiny;
      any = any || out.stuck[i];
    }
    for (int i = 0; i < node.stickings; ++i)
      if (out.stuck[i])
        n.bond(n.sticking[i].above, n.sticking[i].below);
    return any;
  }

  /// Final velocities from sums of the final impulses, so that no rounding of the sweeps is left behind.
  RIVEN_INLINE void finish(Outcome& out) const {
    Vec2 given[Node::fields];
    bool touched[Node::fields] = {};
    for (int k = 0; k < pairs; ++k) {
      out.lambda[number[k]] = r[2 * k];
      out.tau[number[k]] = r[2 * k + 1];
      if (r[2 * k] == 0 && r[2 * k + 1] == 0)
        continue;
      const Vec2 n = pair(k).normal, impulse = r[2 * k] * n + r[2 * k + 1] * turned(n);
      given[above[k]] -= impulse;
      given[below[k]] += impulse;
      touched[above[k]] = touched[below[k]] = true;
    }
    for (int f = 0; f < Node::fields; ++f) {
      if (!(node.mass[f] > 0))
        continue;
      const int g = node.group[f];
      const bool alone = mass[g] == node.mass[f];
      const Vec2 own = node.momentum[f] * (1 / node.mass[f]);
      out.changed[f] = touched[g] || !alone;
      if (!out.changed[f]) {
        out.velocity[f] = own;
      } else if (alone) {
        out.velocity[f] = (node.momentum[f] + given[g]) * (1 / node.mass[f]);
        out.impulse[f] = given[g];
      } else {
        out.velocity[f] = (node.group_momentum(g) + given[g]) * (1 / mass[g]);
        out.impulse[f] = node.mass[f] * (out.velocity[f] - own);
      }
    }
  }
};

}  // namespace detail

/// Solves the contacts of a node. Fields without mass are left alone.
template <int cracks>
RIVEN_INLINE ContactOutcomeOf<cracks> solve(ContactNodeOf<cracks> node) {
  using Node = ContactNodeOf<cracks>;
  ContactOutcomeOf<cracks> out;
  double scale = 0;
  for (int f = 0; f < Node::fields; ++f)
    if (node.mass[f] > 0)
      scale += norm(node.momentum[f]);
  if (node.stickings > 0)
    detail::ContactSweep<cracks>(node, scale).stick(node, out);
  for (bool again = true; again;) {
    const Node now = node;  // `stick` merges fields of `node` while the sweep looks at this one
    detail::ContactSweep<cracks> sweep(now, scale);
    if (sweep.pairs > 0) {
      const int count = sweep.sweep(Node::most_sweeps);
      out.converged = count <= Node::most_sweeps;
      out.sweeps += std::min(count, int{Node::most_sweeps});  // a copy: std::min takes an address
    }
    again = sweep.stick(node, out);
    if (!again)
      sweep.finish(out);
  }
  return out;
}

}  // namespace riven
