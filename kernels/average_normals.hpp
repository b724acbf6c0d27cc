// The normals by which a node tells above from below of the cracks that it holds,
//   n_i = sum_s l_s B(x_s - x_i) n_s,   normalised,
// over the pieces s of the crack, of length l_s and at most 0.6 cells long, with midpoints x_s; B is the product of
// quadratic B-splines of the cell's size. Their reach of one and a half cells along each axis is that of the paths
// which end at the node. Nairn et al. (appendix) average over the points where such paths cross the crack: the same up
// to the weights, but those points jump from segment to segment as particles move, and these weights do not.
#pragma once
#include <algorithm>
#include <cmath>

#include "core/state/crack_fields.hpp"
#include "core/state/cracks.hpp"
#include "core/state/grid.hpp"
#include "kernels/clearance.hpp"

namespace riven {

namespace detail {

/// Values of the quadratic B-splines of the three nodes around X.
struct SplineWeights {
  int base;
  double s[3];
};
RIVEN_INLINE SplineWeights spline_weights(double X) {
  const double nearest = std::floor(X + 0.5), r = X - nearest;
  return {static_cast<int>(nearest) - 1, {0.5 * (0.5 - r) * (0.5 - r), 0.75 - r * r, 0.5 * (0.5 + r) * (0.5 + r)}};
}

/// Normal of the segment a-b times its length, from above to below.
RIVEN_INLINE Vec2 weighted_normal(Vec2 a, Vec2 b) {
  return -turned(b - a);
}

RIVEN_INLINE Vec2 unit(Vec2 n) {
  const double length = norm(n);
  return length > 0 ? n * (1 / length) : Vec2{};
}

}  // namespace detail

/// Adds the pieces of crack c to the sums of the nodes around them that hold it.
inline void add_normals(const Lattice& lattice, const Cracks& cracks, int c, CrackFields& fields) {
  const double inv_h = 1 / lattice.h;
  for (int k = cracks.start[c]; k + 1 < cracks.start[c + 1]; ++k) {
    const Vec2 a = (cracks.plane[k] - lattice.origin) * inv_h, d = (cracks.plane[k + 1] - lattice.origin) * inv_h - a;
    const double length2 = dot(d, d);
    const int pieces = length2 <= 0.36 ? 1 : static_cast<int>(std::ceil(2 * std::sqrt(length2) - 0.2));
    const Vec2 n = detail::weighted_normal(cracks.plane[k], cracks.plane[k + 1]) * (1. / pieces);
    const Vec2 n0 = detail::weighted_normal(cracks.plane0[k], cracks.plane0[k + 1]) * (1. / pieces);
    for (int piece = 0; piece < pieces; ++piece) {
      const Vec2 X = a + ((piece + 0.5) / pieces) * d;
      const detail::SplineWeights x = detail::spline_weights(X.x), y = detail::spline_weights(X.y);
      if (x.base < 0 || y.base < 0 || x.base + 3 > lattice.nx || y.base + 3 > lattice.ny)
        continue;
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) {
          const int f = fields.node_index[(y.base + j) * lattice.nx + x.base + i];
          if (f < 0)
            continue;
          const NodeCracks& held = fields.nodes[f];
          const int m = held.crack[1] == c;
          const double weight = x.s[i] * y.s[j];
          if (held.crack[m] == c) {
            fields.normals[f].now[m] += weight * n;
            fields.normals[f].first[m] += weight * n0;
          } else if (held.crack[2] == c) {
            fields.third_normals[held.third].now += weight * n;
            fields.third_normals[held.third].first += weight * n0;
          }
        }
    }
  }
}

/// Makes the sums of flagged node f normals. A crack that only just reaches into sight of the node, or folds back so
/// that its normals cancel, has its nearest segment's.
inline void finish_normals(const Lattice& lattice, const Cracks& cracks, long f, CrackFields& fields) {
  const NodeCracks& node = fields.nodes[f];
  NodeNormals& normals = fields.normals[f];
  for (int m = 0; m < fields.held[f]; ++m) {
    Vec2& now = m < 2 ? normals.now[m] : fields.third_normals[node.third].now;
    Vec2& of_first = m < 2 ? normals.first[m] : fields.third_normals[node.third].first;
    const double least = 1e-9 * lattice.h;
    if (!(dot(now, now) > least * least && dot(of_first, of_first) > least * least)) {
      int c = fields.candidate_start[f];
      while (fields.candidate[c] != node.crack[m])
        ++c;
      const Vec2 place = lattice.position(node.node);
      const auto far = [&](int k) { return distance2(place, cracks.plane[k], cracks.plane[k + 1]); };
      const int* list = fields.node_segment.data();
      const int k = *std::min_element(list + fields.segment_start[c], list + fields.segment_start[c + 1],
                                      [&](int a, int b) { return far(a) < far(b); });
      now = detail::weighted_normal(cracks.plane[k], cracks.plane[k + 1]);
      of_first = detail::weighted_normal(cracks.plane0[k], cracks.plane0[k + 1]);
    }
    now = detail::unit(now);
    of_first = detail::unit(of_first);
  }
}

}  // namespace riven
