// The segments of cracks with an interface law, and the nodes that each belongs to: those that hold the crack and have
// a weight at the segment's midpoint. Crack by crack: no two cracks share a node's entry, and the segments of one are
// taken in order, so that sums over them do not depend on threads.
#pragma once
#include "core/math/shape.hpp"
#include "core/state/bodies.hpp"
#include "core/state/crack_fields.hpp"
#include "core/state/cracks.hpp"
#include "core/state/grid.hpp"

namespace riven {

/// Size of a crack point's domain: that of the particles of the first body.
template <class Real>
DomainSetting<double, 2> crack_point_domain(const DomainSetting<Real, 2>& body) {
  DomainSetting<double, 2> d;
  for (int axis = 0; axis < 2; ++axis) {
    const AxisSetting<Real>& a = body.axis[axis];
    d.axis[axis] = {double(a.half), double(a.inv_4half), a.wall_lower, a.wall_upper};
  }
  return d;
}

struct SegmentFrame {
  double length;  ///< m
  Vec2 along;     ///< from the first to the second point
  Vec2 normal;    ///< from above to below
};

template <class Shape>
struct InterfaceSegments {
  DomainSetting<double, 2> domain;
  Lattice lattice;
  const int* node_index;
  const NodeCracks* nodes;
  const int* start;
  const Vec2* plane;
  const ContactSettings* law;

  InterfaceSegments(const DomainSetting<double, 2>& d, const Lattice& l, const CrackFields& f, const Cracks& c)
      : domain(d),
        lattice(l),
        node_index(f.node_index.data()),
        nodes(f.nodes.data()),
        start(c.start.data()),
        plane(c.plane.data()),
        law(c.contact.data()) {}

  /// body(p, frame, nodes) for each segment of crack c that starts at point p, where nodes(f) calls f(i, k, S) for each
  /// of its nodes: entry i of CrackFields::nodes, which holds the crack as its k-th, and the weight.
  template <class Body>
  RIVEN_INLINE void each(long c, const Body& body) const {
    if (law[c].law != ContactLaw::interface)
      return;
    const double inv_h = 1 / lattice.h;
    for (int p = start[c]; p + 1 < start[c + 1]; ++p) {
      const Vec2 line = plane[p + 1] - plane[p], at = (0.5 * inv_h) * (plane[p] + plane[p + 1] - 2 * lattice.origin);
      const double length = norm(line);
      if (length == 0)
        continue;
      const Vec2 along = line * (1 / length);
      const auto a = Shape::axis(at.x, domain.axis[0]);
      const auto b = Shape::axis(at.y, domain.axis[1]);
      body(p, SegmentFrame{length, along, -turned(along)}, [&](auto&& f) {
        for (int k = 0; k < neighbours<Shape, 2>; ++k) {
          const int x = a.base + k % Shape::width, y = b.base + k / Shape::width;
          if (x < 0 || y < 0 || x >= lattice.nx || y >= lattice.ny)
            continue;
          const int i = node_index[y * lattice.nx + x];
          if (i < 0)
            continue;
          const double S = a.s[k % Shape::width] * b.s[k / Shape::width];
          if (nodes[i].crack[0] == c)
            f(i, 0, S);
          else if (nodes[i].crack[1] == c)
            f(i, 1, S);
        }
      });
    }
  }
};

}  // namespace riven
