// The segments of cracks with an interface law, and the nodes at which their faces meet, with weights
//   S*_is = mu_i S_i(x_s) / sum_j mu_j S_j(x_s),   mu the mass of the relative motion of the two faces at the node,
// x_s the segment's midpoint: the renormalised functions of crack surfaces (J.A. Nairn and Y.E. Aimene, Modeling
// Multiple Crack Propagation in the Material Point Method, eq. 4), with one mass for both faces. A node that one face
// barely reaches has a wild velocity there and next to no say.
//
// Crack by crack: no two cracks share a node's entry, and the segments of one are taken in order, so that sums over
// them do not depend on threads.
#pragma once
#include "core/math/shape.hpp"
#include "core/state/bodies.hpp"
#include "core/state/crack_fields.hpp"
#include "core/state/cracks.hpp"
#include "core/state/grid.hpp"
#include "kernels/contact_meetings.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

struct SegmentFrame {
  double length;  ///< m, of what lies in a body
  Vec2 along;     ///< from the first to the second point
  Vec2 normal;    ///< from above to below
};

template <class Shape, class Real>
struct InterfaceSegments {
  DomainSetting<Real, 2> domain;  ///< of crack points: that of the first body's particles
  Lattice lattice;
  const Real* mass;  ///< of the grid's slots
  const int* extra;
  const int* node_index;
  const NodeCracks* nodes;
  const NodeNormals* normals;
  const ThirdNormal* third_normals;
  const int* start;
  const Vec2* plane;
  const double* in_solid;  ///< null: all of it
  const ContactSettings* law;

  InterfaceSegments(const exec::Array<DomainSetting<Real, 2>>& domains, const Grid<Real>& g, const CrackFields& f,
                    const Cracks& c)
      : domain(domains[0]),
        lattice(g.lattice),
        mass(exec::data(g.mass)),
        extra(exec::data(f.extra)),
        node_index(exec::data(f.node_index)),
        nodes(exec::data(f.nodes)),
        normals(exec::data(f.normals)),
        third_normals(exec::data(f.third_normals)),
        start(exec::data(c.start)),
        plane(exec::data(c.plane)),
        in_solid(c.in_solid.empty() ? nullptr : exec::data(c.in_solid)),
        law(exec::data(c.contact)) {}

  RIVEN_INLINE long slot(const NodeCracks& n, int f) const {
    return f == 0 ? n.node : long{lattice.nodes()} + extra[n.node] + f - 1;
  }
  /// f(meeting) for those across crack k of a node.
  template <class F>
  RIVEN_INLINE void each_meeting(const NodeCracks& n, int k, const F& f) const {
    if (n.crack[2] < 0)
      each_meeting_of<2>(n, k, f);
    else
      each_meeting_of<3>(n, k, f);
  }
  template <int cracks, class F>
  RIVEN_INLINE void each_meeting_of(const NodeCracks& n, int k, const F& f) const {
    double m[1 << cracks] = {};
    for (int field = 0; field < n.fields(); ++field)
      m[field] = mass[slot(n, field)];
    for (const Meeting& meeting :
         find_meetings<cracks>(n, held_normals<cracks>(n, &n - nodes, normals, third_normals), m, law))
      if (meeting.k == k)
        f(meeting);
  }
  /// Mass of the relative motion across crack k of a node, kg.
  RIVEN_INLINE double relative_mass(const NodeCracks& n, int k) const {
    double sum = 0;
    each_meeting(n, k, [&](const Meeting& m) {
      const double a = mass[slot(n, m.above)], b = mass[slot(n, m.below)];
      sum += a * b / (a + b);
    });
    return sum;
  }

  /// body(p, frame, nodes) for each segment of crack c that starts at point p, where nodes(f) calls f(i, k, S*) for
  /// each of its nodes: entry i of CrackFields::nodes, which holds the crack as its k-th, and the weight.
  template <class Body>
  RIVEN_INLINE void each(long c, const Body& body) const {
    if (law[c].law != ContactLaw::interface)
      return;
    const double inv_h = 1 / lattice.h;
    for (int p = start[c]; p + 1 < start[c + 1]; ++p) {
      const Vec2 line = plane[p + 1] - plane[p], at = (0.5 * inv_h) * (plane[p] + plane[p + 1] - 2 * lattice.origin);
      const double length = norm(line), inside = in_solid ? in_solid[p] : 1;
      if (length == 0 || inside == 0)
        continue;
      const auto a = Shape::axis(at.x, domain.axis[0]);
      const auto b = Shape::axis(at.y, domain.axis[1]);
      int index[neighbours<Shape, 2>], which[neighbours<Shape, 2>], count = 0;
      double weight[neighbours<Shape, 2>], sum = 0;
      for (int n = 0; n < neighbours<Shape, 2>; ++n) {
        const int x = a.base + n % Shape::width, y = b.base + n / Shape::width;
        if (x < 0 || y < 0 || x >= lattice.nx || y >= lattice.ny)
          continue;
        const int i = node_index[y * lattice.nx + x];
        const int k = i < 0 ? -1 : nodes[i].which(static_cast<int>(c));
        if (k < 0)
          continue;
        const double w = double(a.s[n % Shape::width]) * b.s[n / Shape::width] * relative_mass(nodes[i], k);
        if (!(w > 0))
          continue;
        index[count] = i;
        which[count] = k;
        weight[count++] = w;
        sum += w;
      }
      const Vec2 along = line * (1 / length);
      body(p, SegmentFrame{inside * length, along, -turned(along)}, [&](auto&& f) {
        for (int n = 0; n < count; ++n)
          f(index[n], which[n], weight[n] / sum);
      });
    }
  }
};

}  // namespace RIVEN_SIDE

}  // namespace riven
