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
#include "core/state/grid.hpp"
#include "kernels/clearance.hpp"
#include "kernels/lists_view.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

namespace detail {

/// The quadratic B-spline at r cells from its node.
RIVEN_INLINE double spline(double r) {
  const double wide = std::max(0., 1.5 - std::fabs(r)), near = std::max(0., 0.5 - std::fabs(r));
  return 0.5 * wide * wide - 1.5 * near * near;
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

/// Segment k for the averages of the nodes around it.
RIVEN_INLINE SegmentNormal segment_normal(const Lattice& lattice, const Vec2* plane, const Vec2* plane0, long k) {
  const double inv_h = 1 / lattice.h;
  const Vec2 d = (plane[k + 1] - plane[k]) * inv_h;
  SegmentNormal s;
  s.middle = (0.5 * (plane[k] + plane[k + 1]) - lattice.origin) * inv_h;
  s.now = detail::weighted_normal(plane[k], plane[k + 1]);
  s.first = detail::weighted_normal(plane0[k], plane0[k + 1]);
  if (const double length2 = dot(d, d); length2 > 0.36)
    s.pieces = static_cast<int>(std::ceil(2 * std::sqrt(length2) - 0.2));
  return s;
}

/// Finds the normals of flagged nodes from the segments that each may see, in their order.
struct NormalAverager {
  ListsView lists;
  const Vec2* plane;             ///< Cracks
  const SegmentNormal* segment;  ///< [points]
  const NodeCracks* nodes;       ///< [flagged]
  const std::uint8_t* held;      ///< [flagged]
  NodeNormals* normals;          ///< [flagged]
  ThirdNormal* third;

  /// Those of node f. A crack that only just reaches into sight of the node, or folds back so that its normals cancel,
  /// has its nearest segment's.
  RIVEN_FN void find(long f) const {
    normals[f] = {};
    const NodeCracks& node = nodes[f];
    const int column = node.node % lists.lattice.nx, row = node.node / lists.lattice.nx;
    const Vec2 at{double(column), double(row)};
    int c = lists.candidate_start[f];
    for (int m = 0; m < held[f]; ++m, ++c) {
      while (lists.candidate[c] != node.crack[m])
        ++c;
      const int first = lists.segment_start[c], last = lists.segment_start[c + 1];
      Sums sums;
      for (int s = first; s < last; ++s)
        add(at, segment[lists.node_segment[s]], sums);
      const double least = 1e-9 * lists.lattice.h;
      if (!(dot(sums.now, sums.now) > least * least && dot(sums.first, sums.first) > least * least)) {
        const SegmentNormal& near = segment[nearest(lists.lattice.position(node.node), first, last)];
        sums = {near.now, near.first};
      }
      (m < 2 ? normals[f].now[m] : third[node.third].now) = detail::unit(sums.now);
      (m < 2 ? normals[f].first[m] : third[node.third].first) = detail::unit(sums.first);
    }
  }

 private:
  struct Sums {
    Vec2 now, first;
  };

  /// Adds a segment to the sums of a node, which is so many cells from the lattice's first one.
  RIVEN_FN void add(Vec2 node, const SegmentNormal& s, Sums& sums) const {
    const Vec2 r = s.middle - node;
    const double weight = s.pieces == 1 ? detail::spline(r.x) * detail::spline(r.y) : mean_of_pieces(s, r);
    sums.now += weight * s.now;
    sums.first += weight * s.first;
  }
  RIVEN_FN double mean_of_pieces(const SegmentNormal& s, Vec2 middle) const {
    const Vec2 along = (1 / lists.lattice.h) * turned(s.now);
    double sum = 0;
    for (int piece = 0; piece < s.pieces; ++piece) {
      const Vec2 r = middle + ((piece + 0.5) / s.pieces - 0.5) * along;
      sum += detail::spline(r.x) * detail::spline(r.y);
    }
    return sum / s.pieces;
  }

  RIVEN_FN int nearest(Vec2 place, int first, int last) const {
    int found = lists.node_segment[first];
    double least2 = distance2(place, plane[found], plane[found + 1]);
    for (int s = first + 1; s < last; ++s) {
      const int k = lists.node_segment[s];
      if (const double far2 = distance2(place, plane[k], plane[k + 1]); far2 < least2) {
        found = k;
        least2 = far2;
      }
    }
    return found;
  }
};

}  // namespace RIVEN_SIDE

}  // namespace riven
