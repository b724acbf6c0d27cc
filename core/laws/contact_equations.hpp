// The linear equations that follow from the states of a node's pairs (apart, held, sliding), solved directly, the
// states being corrected until they agree with the solution.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/laws/contact_node.hpp"

namespace riven::detail {

enum class PairState { apart, held, slides_forward, slides_back };

/// The pairs between groups of fields, and the groups' motion.
template <int cracks>
struct ContactEquations {
  using Node = ContactNodeOf<cracks>;
  static constexpr int most_rows = 2 * Node::most_pairs;

  const Node& node;
  double tiny;                ///< impulse below which nothing matters
  double mass[Node::fields];  ///< of the group that bears a field's number
  Vec2 momentum[Node::fields];
  int pairs = 0;                 ///< those between different groups
  int number[Node::most_pairs];  ///< in node.pair
  int above[Node::most_pairs], below[Node::most_pairs];
  double reduced[Node::most_pairs];
  double r[most_rows] = {};  ///< lambda and tau of each pair

  RIVEN_INLINE ContactEquations(const Node& n, double scale) : node(n), tiny(Node::tolerance * scale) {
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
        const double slope = state[k] == PairState::slides_forward ? p.friction.forward : -p.friction.back;
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

  /// What friction would have to bear more to hold faces; negative where it could bear more than it has to.
  static RIVEN_INLINE double beyond(const ContactPair& p, double lambda, double tau) {
    const double size = std::abs(lambda), forward = lambda < 0 ? -tau : tau;
    return std::max(forward - p.friction.forward * size, -forward - p.friction.back * size);
  }
  /// Which way they slide.
  static RIVEN_INLINE PairState sliding(double lambda, double tau) {
    return (tau > 0) == (lambda > 0) ? PairState::slides_forward : PairState::slides_back;
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
      return p.frictional && p.friction.none() ? PairState::slides_forward : PairState::held;
    }
    if (p.unilateral && lambda < -tiny)
      return badness = -lambda, PairState::apart;
    if (!p.frictional || p.friction.none())
      return state;
    if (state == PairState::held) {
      badness = beyond(p, lambda, tau);
      return badness <= tiny ? state : sliding(lambda, tau);
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
      else if (p.frictional && beyond(p, lambda, tau) >= 0)
        state[k] = p.friction.none() ? PairState::slides_forward : sliding(lambda, tau);
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
};

}  // namespace riven::detail
