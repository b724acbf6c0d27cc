// The normals by which a node tells above from below of the cracks that it holds,
//   n_i = sum_s l_s B(x_s - x_i) n_s,   normalised,
// over the pieces s of the crack, of length l_s and at most 0.6 cells long, with midpoints x_s; B is the product of
// quadratic B-splines of the cell's size. Their reach of one and a half cells along each axis is that of the paths
// which end at the node. Nairn et al. (appendix) average over the points where such paths cross the crack: the same up
// to the weights, but those points jump from segment to segment as particles move, and these weights do not.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/state/crack_fields.hpp"
#include "core/state/cracks.hpp"
#include "core/state/grid.hpp"
#include "kernels/clearance.hpp"

namespace riven {

namespace detail {

RIVEN_INLINE double bspline(double r) {
  const double outer = std::max(0., 1.5 - std::fabs(r)), inner = std::max(0., 0.5 - std::fabs(r));
  return 0.5 * outer * outer - 1.5 * inner * inner;
}

/// Mean of B over the pieces of a segment, its ends in cells from the node.
RIVEN_INLINE double weight_of(Vec2 a, Vec2 b) {
  const Vec2 d = b - a;
  const double length2 = dot(d, d);
  const int pieces = length2 <= 0.36 ? 1 : static_cast<int>(std::ceil(2 * std::sqrt(length2) - 0.2));
  double sum = 0;
  for (int k = 0; k < pieces; ++k) {
    const double t = (k + 0.5) / pieces;
    sum += bspline(a.x + t * d.x) * bspline(a.y + t * d.y);
  }
  return sum / pieces;
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

/// Sets the normals of flagged node f, by the segments of now and in their first position. A crack that only just
/// reaches into sight of the node, or folds back so that its normals cancel, has its nearest segment's.
inline void average_normals(const Lattice& lattice, const Cracks& cracks, CrackFields& fields, long f) {
  NodeCracks& node = fields.nodes[f];
  const double inv_h = 1 / lattice.h;
  const Vec2 place = lattice.position(node.node);
  int c = fields.candidate_start[f];
  for (int m = 0; m < fields.held[f]; ++m) {
    while (fields.candidate[c] != node.crack[m])
      ++c;
    Vec2 sum, sum0;
    const auto add = [&](int k, double weight) {
      sum += weight * detail::weighted_normal(cracks.plane[k], cracks.plane[k + 1]);
      sum0 += weight * detail::weighted_normal(cracks.plane0[k], cracks.plane0[k + 1]);
    };
    const int first = fields.segment_start[c], last = fields.segment_start[c + 1];
    for (int s = first; s < last; ++s) {
      const int k = fields.node_segment[s];
      add(k, detail::weight_of((cracks.plane[k] - place) * inv_h, (cracks.plane[k + 1] - place) * inv_h));
    }
    if (const double least = 1e-9 * lattice.h; !(norm(sum) > least && norm(sum0) > least)) {
      const auto far = [&](int k) { return distance2(place, cracks.plane[k], cracks.plane[k + 1]); };
      const int* list = fields.node_segment.data();
      sum = sum0 = {};
      add(*std::min_element(list + first, list + last, [&](int a, int b) { return far(a) < far(b); }), 1);
    }
    node.normal[m] = detail::unit(sum);
    node.normal0[m] = detail::unit(sum0);
  }
}

}  // namespace riven
