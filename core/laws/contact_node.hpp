// All contacts of one node solved together. A node that holds two cracks has up to four fields and up to four pairs of
// them, one that holds three up to eight and twelve; a field takes part in two or three pairs where cracks meet, so
// that pair after pair in one sweep satisfies only the last.
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
#include <limits>

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

namespace detail {

enum class PairState { apart, held, slides_forward, slides_back };

/// The pairs between groups of fields, and the groups' motion.
template <int cracks>
struct ContactSweep {
  using Node = ContactNodeOf<cracks>;
  using Outcome = ContactOutcomeOf<cracks>;
  static constexpr int most_rows = 2 * Node::most_pairs;
  static constexpr int few_pairs = 4;  ///< whose combinations of states can all be tried

  const Node& node;
  double tiny;                ///< impulse below which nothing matters
  double mass[Node::fields];  ///< of the group that bears a field's number
  Vec2 momentum[Node::fields];
  int pairs = 0;                 ///< those between different groups
  int number[Node::most_pairs];  ///< in node.pair
  int above[Node::most_pairs], below[Node::most_pairs];
  double reduced[Node::most_pairs];
  double r[most_rows] = {};  ///< lambda and tau of each pair

  RIVEN_INLINE ContactSweep(const Node& n, double scale) : node(n), tiny(Node::tolerance * scale) {
    for (int f = 0; f < Node::fields; ++f) {
      mass[f] = node.group[f] == f ? node.group_mass(f) : 0;
      momentum[f] = node.group[f] == f ? node.group_momentum(f) : Vec2{};
    }
    for (int k = 0; k < node.pairs; ++k) {
      const int a = node.group[node.pair[k].above], b = node.group[node.pair[k].below];
      if (a == b)
        continue;
      number[pairs] = k;
      above[pairs] = a;
      below[pairs] = b;
      reduced[pairs++] = node.reduced_mass(a, b);
    }
  }

  RIVEN_INLINE const ContactPair& pair(int k) const { return node.pair[number[k]]; }
  RIVEN_INLINE Vec2 velocity(int f) const { return momentum[node.group[f]] * (1 / mass[node.group[f]]); }
  RIVEN_INLINE Vec2 approach(int k) const { return velocity(above[k]) - velocity(below[k]); }
  RIVEN_INLINE void exchange(int k, Vec2 impulse) {
    momentum[above[k]] -= impulse;
    momentum[below[k]] += impulse;
  }

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

  RIVEN_INLINE Vec2 direction(int row) const {
    const Vec2 n = pair(row / 2).normal;
    return row % 2 == 0 ? n : turned(n);
  }
  /// Loss of velocity of approach in one row by a unit impulse in another.
  RIVEN_INLINE double coupling(int row, int other) const {
    const int k = row / 2, l = other / 2;
    double w = 0;
    if (above[k] == above[l])
      w += 1 / mass[above[k]];
    if (below[k] == below[l])
      w += 1 / mass[below[k]];
    if (above[k] == below[l])
      w -= 1 / mass[above[k]];
    if (below[k] == above[l])
      w -= 1 / mass[below[k]];
    return w * dot(direction(row), direction(other));
  }

  using Matrix = double[most_rows][most_rows + 1];
  using States = PairState[Node::most_pairs];

  /// Equations for the change of all impulses, given the pairs' states.
  RIVEN_INLINE void equations(const States& state, Matrix& A) const {
    const int n = 2 * pairs;
    for (int row = 0; row < n; ++row) {
      const int k = row / 2;
      const ContactPair& p = pair(k);
      const bool normal = row % 2 == 0;
      for (int c = 0; c <= n; ++c)
        A[row][c] = 0;
      if (state[k] == PairState::apart) {
        A[row][row] = 1;
        A[row][n] = -r[row];
      } else if (!normal && state[k] != PairState::held) {
        const double slope = state[k] == PairState::slides_forward ? p.friction : -p.friction;
        A[row][row] = 1;
        A[row][row - 1] = -slope;
        A[row][n] = slope * r[row - 1] - r[row];
      } else {
        // (1 - give) u - give r/m = bias, times m to make rows alike
        const PairResponse& q = normal ? p.across : p.along;
        const double m = reduced[k], u = dot(approach(k), direction(row));
        for (int c = 0; c < n; ++c)
          A[row][c] = (1 - q.give) * m * coupling(row, c);
        A[row][row] += q.give;
        A[row][n] = m * ((1 - q.give) * u - q.bias) - q.give * r[row];
      }
    }
  }

  /// The state that a pair should be in, if not the one it was solved for; `badness` says how far off it is.
  RIVEN_INLINE PairState corrected(int k, PairState state, const double (&change)[most_rows], double& badness) const {
    const ContactPair& p = pair(k);
    const double lambda = r[2 * k] + change[2 * k], tau = r[2 * k + 1] + change[2 * k + 1], m = reduced[k];
    double un = dot(approach(k), direction(2 * k)), ut = dot(approach(k), direction(2 * k + 1));
    for (int c = 0; c < 2 * pairs; ++c) {
      un -= coupling(2 * k, c) * change[c];
      ut -= coupling(2 * k + 1, c) * change[c];
    }
    badness = 0;
    const bool slides = state == PairState::slides_forward || state == PairState::slides_back;
    if ((state == PairState::apart && !p.unilateral) || (slides && !p.frictional)) {
      badness = std::numeric_limits<double>::infinity();
      return PairState::held;
    }
    if (state == PairState::apart) {
      badness = m * (un - p.across.bias);
      if (badness <= tiny)
        return state;
      return p.frictional && p.friction == 0 ? PairState::slides_forward : PairState::held;
    }
    if (p.unilateral && lambda < -tiny)
      return badness = -lambda, PairState::apart;
    if (!p.frictional || p.friction == 0)
      return state;
    if (state == PairState::held) {
      badness = std::abs(tau) - p.friction * std::abs(lambda);
      if (badness <= tiny)
        return state;
      return (tau > 0) == (lambda > 0) ? PairState::slides_forward : PairState::slides_back;
    }
    badness = -m * ut * (tau > 0 ? 1 : -1);  // friction must oppose sliding
    return badness <= tiny || std::abs(tau) <= tiny ? state : PairState::held;
  }

  /// Solves with the given states. Returns -1 if all of them agree with the solution; otherwise the pair that is
  /// furthest off, and the state that it should rather be in.
  RIVEN_INLINE int solve_for(const States& state, double (&change)[most_rows], PairState& better) const {
    Matrix A;
    equations(state, A);
    eliminate(A, 2 * pairs, change);
    double worst = 0;
    int which = -1;
    for (int k = 0; k < pairs; ++k) {
      double badness = 0;
      const PairState s = corrected(k, state[k], change, badness);
      if (s == state[k] || badness <= worst)
        continue;
      worst = badness;
      which = k;
      better = s;
    }
    return which;
  }

  /// Adds to all impulses; returns the largest addition.
  RIVEN_INLINE double apply(const double (&change)[most_rows]) {
    double largest = 0;
    for (int k = 0; k < pairs; ++k) {
      exchange(k, change[2 * k] * direction(2 * k) + change[2 * k + 1] * direction(2 * k + 1));
      for (int row = 2 * k; row < 2 * k + 2; ++row) {
        r[row] += change[row];
        largest = std::max(largest, std::abs(change[row]));
      }
    }
    return largest;
  }

  /// Solves for the impulses with every pair in the state that the sweeps left it in, corrects the worst state and
  /// tries again; with `all`, tries every combination of states. Keeps an answer, refined once or twice, only if all
  /// states agree with it; true if so.
  RIVEN_INLINE bool solve_directly(bool all) {
    States state = {};
    for (int k = 0; k < pairs && !all; ++k) {
      const ContactPair& p = pair(k);
      const double lambda = r[2 * k], tau = r[2 * k + 1];
      if (p.unilateral && lambda == 0)
        state[k] = PairState::apart;
      else if (p.frictional && std::abs(tau) >= p.friction * std::abs(lambda))
        state[k] = (tau > 0) == (lambda > 0) || p.friction == 0 ? PairState::slides_forward : PairState::slides_back;
      else
        state[k] = PairState::held;
    }
    double change[most_rows];
    PairState better = PairState::held;
    const int combinations = 1 << (2 * pairs), attempts = all ? combinations : 4 * pairs;
    for (int attempt = 0; attempt < attempts; ++attempt) {
      for (int k = 0; k < pairs && all; ++k)
        state[k] = static_cast<PairState>(attempt >> (2 * k) & 3);
      const int which = solve_for(state, change, better);
      if (which < 0) {
        for (int refinement = 0; refinement < 3 && apply(change) > 0.1 * tiny; ++refinement)
          solve_for(state, change, better);
        return true;
      }
      if (!all)
        state[which] = better;
    }
    return false;
  }

  /// Gauss elimination with full pivoting; unknowns that the equations leave open become 0 (the pairs around a node
  /// form a ring, where some combinations of impulses have no effect).
  static RIVEN_INLINE void eliminate(Matrix& A, int n, double (&x)[most_rows]) {
    int column[most_rows];
    for (int c = 0; c < n; ++c)
      column[c] = c;
    double largest = 0;
    int rank = 0;
    for (; rank < n; ++rank) {
      int pr = rank, pc = rank;
      for (int i = rank; i < n; ++i)
        for (int j = rank; j < n; ++j)
          if (std::abs(A[i][column[j]]) > std::abs(A[pr][column[pc]]))
            pr = i, pc = j;
      const double pivot = std::abs(A[pr][column[pc]]);
      largest = std::max(largest, pivot);
      if (!(pivot > 1e-13 * largest))
        break;
      std::swap(column[rank], column[pc]);
      for (int c = 0; c <= n; ++c)
        std::swap(A[rank][c], A[pr][c]);
      for (int i = rank + 1; i < n; ++i) {
        const double f = A[i][column[rank]] / A[rank][column[rank]];
        for (int c = 0; c <= n; ++c)
          A[i][c] -= f * A[rank][c];
      }
    }
    for (int c = 0; c < n; ++c)
      x[c] = 0;
    for (int i = rank - 1; i >= 0; --i) {
      double sum = A[i][n];
      for (int j = i + 1; j < rank; ++j)
        sum -= A[i][column[j]] * x[column[j]];
      x[column[i]] = sum / A[i][column[i]];
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
