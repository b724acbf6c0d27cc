// Which fields of a node meet across which crack, and how far apart they are.
#pragma once
#include <algorithm>

#include "core/laws/contact_node.hpp"
#include "core/state/crack_fields.hpp"
#include "core/state/grid.hpp"
#include "kernels/contact_sums.hpp"

namespace riven {

/// Two fields that meet across one crack, or diagonally across both.
struct Meeting {
  int above, below;
  int k;                 ///< the crack at the node (0 or 1) whose law holds
  Vec2 normal, normal0;  ///< now and at the first position, from `above` to `below`
  ContactSettings law;
  double share;  ///< of the node's part of crack k that lies between these two fields
};

struct Meetings {
  Meeting list[ContactNode::most_pairs];
  int count = 0;
  const Meeting* begin() const { return list; }
  const Meeting* end() const { return list + count; }
};

/// Fields f and f + 2^k, which meet across crack k alone.
RIVEN_INLINE Meeting neighbour_meeting(const NodeCracks& n, const NodeNormals& w, const ContactSettings* laws, int k,
                                       int f, double share) {
  const int g = f + (1 << k);
  const bool crossing_above = n.side[k] == Side::above;
  return {crossing_above ? g : f, crossing_above ? f : g, k, w.now[k], w.first[k], laws[n.crack[k]], share};
}

/// Fields that differ on both cracks and have none between them.
RIVEN_INLINE Meeting diagonal_meeting(const NodeCracks& n, const NodeNormals& w, const ContactSettings* laws, int f,
                                      int g) {
  const ContactSettings &a = laws[n.crack[0]], &b = laws[n.crack[1]];
  const int k = stricter(b, a) ? 1 : 0;
  Vec2 normal[2], normal0[2];
  for (int c = 0; c < 2; ++c) {
    const bool crosses = f & (1 << c), crossing_above = n.side[c] == Side::above;
    const double sign = crosses == crossing_above ? 1 : -1;  // +1: f lies above crack c and g below
    normal[c] = sign * w.now[c];
    normal0[c] = sign * w.first[c];
  }
  Vec2 sum = normal[0] + normal[1], sum0 = normal0[0] + normal0[1];
  if (norm(sum) < 1e-6 || norm(sum0) < 1e-6) {  // both cracks are parallel and f and g lie outside of them
    sum = normal[k];
    sum0 = normal0[k];
  }
  return {f, g, k, sum * (1 / norm(sum)), sum0 * (1 / norm(sum0)), k == 1 ? b : a, 1};
}

/// All meetings of a node's fields; `mass` is 0 where a field is absent.
RIVEN_INLINE Meetings find_meetings(const NodeCracks& n, const NodeNormals& w,
                                    const double (&mass)[ContactNode::fields], const ContactSettings* laws) {
  Meetings m;
  const auto present = [&](int f) { return mass[f] > 0; };
  for (int k = 0; k < 2; ++k) {
    if (n.crack[k] < 0)
      continue;
    const int first = m.count;
    double total = 0;
    for (int f : {0, k == 0 ? 2 : 1}) {
      const int g = f + (1 << k);
      if (!present(f) || !present(g))
        continue;
      const double both = mass[f] + mass[g];
      total += both;
      m.list[m.count++] = neighbour_meeting(n, w, laws, k, f, both);
    }
    for (int i = first; i < m.count; ++i)
      m.list[i].share /= total;
  }
  if (n.crack[0] < 0 || n.crack[1] < 0)
    return m;
  if (present(0) && present(3) && !present(1) && !present(2))
    m.list[m.count++] = diagonal_meeting(n, w, laws, 0, 3);
  if (present(1) && present(2) && !present(0) && !present(3))
    m.list[m.count++] = diagonal_meeting(n, w, laws, 1, 2);
  return m;
}

/// Opening of two faces along the normal, m. `place`: ContactSums::place; slots and masses of the node's fields.
RIVEN_INLINE double gap_of(const Meeting& m, const double* place, const long* slot, const double* mass) {
  const double *a = place + 4 * slot[m.above], *b = place + 4 * slot[m.below];
  const double of_a = 1 / mass[m.above], of_b = 1 / mass[m.below];
  return dot(m.normal, of_b * Vec2{b[0], b[1]} - of_a * Vec2{a[0], a[1]}) -
         dot(m.normal0, of_b * Vec2{b[2], b[3]} - of_a * Vec2{a[2], a[3]});
}

/// Area in the plane of a node's particles over the area that its cells have inside the walls.
RIVEN_INLINE double relative_volume(const Lattice& l, int node, double area) {
  const int i = node % l.nx, j = node / l.nx;
  double cells = l.h * l.h;
  if (i == l.wall_lower[0] || i == l.wall_upper[0])
    cells /= 2;
  if (j == l.wall_lower[1] || j == l.wall_upper[1])
    cells /= 2;
  return area / cells;
}

}  // namespace riven
