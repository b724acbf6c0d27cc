// Which fields of a node meet across which crack, and how far apart they are.
#pragma once
#include <algorithm>

#include "core/laws/contact_node.hpp"
#include "core/state/crack_fields.hpp"
#include "core/state/grid.hpp"
#include "kernels/contact_sums.hpp"

namespace riven {

/// Two fields that meet across one crack, or diagonally across several.
struct Meeting {
  int above, below;
  int k;                 ///< the crack at the node (0, 1 or 2) whose law holds
  Vec2 normal, normal0;  ///< now and at the first position, from `above` to `below`
  ContactSettings law;
  double share;  ///< of the node's part of crack k that lies between these two fields
};

/// Those of a node that holds so many cracks at most.
template <int cracks>
struct Meetings {
  Meeting list[most_pairs_of(cracks)];
  int count = 0;
  RIVEN_INLINE const Meeting* begin() const { return list; }
  RIVEN_INLINE const Meeting* end() const { return list + count; }
};

/// Normals of all cracks that a node holds. `third` is not read where there is none.
struct HeldNormals {
  const NodeNormals* two;
  const ThirdNormal* third;
  RIVEN_INLINE Vec2 now(int k) const { return k < 2 ? two->now[k] : third->now; }
  RIVEN_INLINE Vec2 first(int k) const { return k < 2 ? two->first[k] : third->first; }
};

/// Normals of a node that holds so many cracks at most, and is entry `index` of CrackFields::nodes.
template <int cracks>
RIVEN_INLINE HeldNormals held_normals(const NodeCracks& n, long index, const NodeNormals* two,
                                      const ThirdNormal* third) {
  return {two + index, cracks > 2 ? third + n.third : nullptr};
}

/// Fields f and g, which crosses crack k, too, and meets f across that.
RIVEN_INLINE Meeting meeting_across(const NodeCracks& n, HeldNormals w, const ContactSettings* laws, int k, int f,
                                    int g, double share) {
  const bool crossing_above = n.side[k] == Side::above;
  return {crossing_above ? g : f, crossing_above ? f : g, k, w.now(k), w.first(k), laws[n.crack[k]], share};
}

/// Fields that differ on several cracks, from k = 0 on, and have none between them.
template <int cracks>
RIVEN_INLINE Meeting diagonal_meeting(const NodeCracks& n, HeldNormals w, const ContactSettings* laws, int f, int g,
                                      double share) {
  int strictest = -1;
  Vec2 sum, sum0, normal, normal0;
  for (int k = 0; k < cracks; ++k) {
    if (((f ^ g) >> k & 1) == 0)
      continue;
    const bool crosses = f & (1 << k), crossing_above = n.side[k] == Side::above;
    const double sign = crosses == crossing_above ? 1 : -1;  // +1: f lies above crack k and g below
    const Vec2 now = sign * w.now(k), first = sign * w.first(k);
    sum += now;
    sum0 += first;
    if (strictest >= 0 && !stricter(laws[n.crack[k]], laws[n.crack[strictest]]))
      continue;
    strictest = k;
    normal = now;
    normal0 = first;
  }
  if (norm(sum) < 1e-6 || norm(sum0) < 1e-6) {  // the cracks are parallel and f and g lie outside of them
    sum = normal;
    sum0 = normal0;
  }
  return {f, g, strictest, sum * (1 / norm(sum)), sum0 * (1 / norm(sum0)), laws[n.crack[strictest]], share};
}

/// Whether fields f < g differ on several cracks and none of those that lie on the side of one or the other of each of
/// these is present.
template <int cracks, class Present>
RIVEN_INLINE bool meet_diagonally(int f, int g, const Present& present) {
  const int across = f ^ g;
  if ((across & (across - 1)) == 0 || !present(f) || !present(g))
    return false;
  for (int h = 0; h < 1 << cracks; ++h)
    if (((h ^ f) & ~across) == 0 && h != f && h != g && present(h))
      return false;
  return true;
}

/// Whether the field g lies over the host from f, which is behind it, past the end of the crack that ends there.
RIVEN_INLINE bool meet_over_host(const NodeCracks& n, int f, int g) {
  const int across = n.host() + n.ending();
  return (f & across) == 0 && g == f + across;
}

/// All meetings of a node's fields; `mass` is 0 where a field is absent.
template <int cracks>
RIVEN_INLINE Meetings<cracks> find_meetings(const NodeCracks& n, HeldNormals w, const double (&mass)[1 << cracks],
                                            const ContactSettings* laws) {
  constexpr int fields = 1 << cracks;
  Meetings<cracks> m;
  const auto present = [&](int f) { return mass[f] > 0; };
  for (int k = 0; k < cracks; ++k) {
    if (n.crack[k] < 0)
      continue;
    for (int f = 0; f < fields; ++f)
      if (const int g = f + (1 << k); (f >> k & 1) == 0 && present(f) && present(g))
        m.list[m.count++] = meeting_across(n, w, laws, k, f, g, mass[f] + mass[g]);
    for (int f = 0; f < fields && n.behind != 0 && n.host() == 1 << k; ++f)
      if (const int g = f + n.host() + n.ending();
          meet_over_host(n, f, g) && present(f) && present(g) && !present(f + n.ending()))
        m.list[m.count++] = meeting_across(n, w, laws, k, f, g, mass[f] + mass[g]);
  }
  for (int f = 0; f < fields && n.crack[1] >= 0; ++f)
    for (int g = f + 1; g < fields; ++g)
      if (!(n.behind != 0 && meet_over_host(n, f, g)) && meet_diagonally<cracks>(f, g, present))
        m.list[m.count++] = diagonal_meeting<cracks>(n, w, laws, f, g, mass[f] + mass[g]);
  double total[cracks] = {};
  for (const Meeting& one : m)
    total[one.k] += one.share;
  for (int i = 0; i < m.count; ++i)
    m.list[i].share /= total[m.list[i].k];
  return m;
}

/// From the mean position of the upper field to that of the lower one, m; `place` and so on as below.
RIVEN_INLINE Vec2 between_means(const Meeting& m, const double* place, const long* slot, const double* mass) {
  const double *a = place + 4 * slot[m.above], *b = place + 4 * slot[m.below];
  return (1 / mass[m.below]) * Vec2{b[0], b[1]} - (1 / mass[m.above]) * Vec2{a[0], a[1]};
}

/// The same along the normal.
RIVEN_INLINE double distance_of(const Meeting& m, const double* place, const long* slot, const double* mass) {
  return dot(m.normal, between_means(m, place, slot, mass));
}

/// Opening of two faces along the normal, m. `place`: ContactSums::place; slots and masses of the node's fields.
RIVEN_INLINE double gap_of(const Meeting& m, const double* place, const long* slot, const double* mass) {
  const double *a = place + 4 * slot[m.above], *b = place + 4 * slot[m.below];
  const Vec2 first = (1 / mass[m.below]) * Vec2{b[2], b[3]} - (1 / mass[m.above]) * Vec2{a[2], a[3]};
  return distance_of(m, place, slot, mass) - dot(m.normal0, first);
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
