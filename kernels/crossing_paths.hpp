// The paths from one particle to its nodes, and a first test that sorts out the segments which surely cross none.
#pragma once
#include <algorithm>
#include <cmath>

#include "core/exec/floats.hpp"
#include "core/math/vec.hpp"
#include "core/state/grid.hpp"

namespace riven {

/// A list of segments, by their first points, ascending.
struct SegmentList {
  const int* segment;
  int count;
};

inline namespace RIVEN_SIDE {

using exec::Floats, exec::Masks, exec::float_lanes;

template <class Shape>
struct Paths {
  static constexpr int N = Shape::width;
  static constexpr int nodes = N * N;
  static constexpr int batch = 32;  ///< segments that the first test takes at once: one bit each
  static constexpr int groups = (nodes + float_lanes - 1) / float_lanes;

  Vec2 particle;
  int i, j;           ///< first node
  Floats dx[groups];  ///< from the particle to the nodes, in cells; lanes past the last node repeat it
  Floats dy[groups];
  Floats inv_length2[groups];  ///< 0 for a path of next to no length

  RIVEN_FN Paths(Vec2 p, int i0, int j0, const Lattice& lattice, double inv_h) : particle(p), i(i0), j(j0) {
    float x[N], y[N];
    for (int a = 0; a < N; ++a) {
      const Vec2 node = lattice.position(i + a, j + a);
      x[a] = static_cast<float>((node.x - p.x) * inv_h);
      y[a] = static_cast<float>((node.y - p.y) * inv_h);
    }
    for (int k = 0; k < groups * float_lanes; ++k) {
      const int node = k < nodes ? k : nodes - 1;
      exec::put_lane(dx[k / float_lanes], k % float_lanes, x[node % N]);
      exec::put_lane(dy[k / float_lanes], k % float_lanes, y[node / N]);
    }
    for (int g = 0; g < groups; ++g) {
      const Floats length2 = dx[g] * dx[g] + dy[g] * dy[g], one = Floats{} + 1.f;
      inv_length2[g] = length2 > 1e-12f ? one / length2 : Floats{};
    }
  }

  /// Takes the squared distances (in cells) of a point from the paths into `least`.
  RIVEN_FN void take_distance2(Vec2 point, double inv_h, Floats* least) const {
    const float x = static_cast<float>((point.x - particle.x) * inv_h);
    const float y = static_cast<float>((point.y - particle.y) * inv_h);
    const Floats zero{}, one = zero + 1.f;
    for (int g = 0; g < groups; ++g) {
      Floats t = (x * dx[g] + y * dy[g]) * inv_length2[g];
      t = t < zero ? zero : t > one ? one : t;
      const Floats off_x = x - t * dx[g], off_y = y - t * dy[g], d2 = off_x * off_x + off_y * off_y;
      least[g] = d2 < least[g] ? d2 : least[g];
    }
  }

  /// For each node, a bit for every segment (of at most `batch`) that may be crossed. With the corners of the
  /// signed areas relative to the particle, (12a) = d x a, (12b) = d x b, (ab1) = a x b, (ab2) = (ab1) + (12a) - (12b).
  /// Returns whether there is any.
  RIVEN_FN bool may_cross(SegmentList list, const Vec2* point, double inv_h, Masks* bits) const {
    constexpr float reach = 2.f;  // bounds |dx| and |dy|, in cells
    Floats area_a[groups];
    for (int g = 0; g < groups; ++g) {
      bits[g] = Masks{};
      area_a[g] = Floats{};
    }
    int next = -1;
    float ax = 0, ay = 0;
    const auto relative = [&](int p, float& x, float& y) {
      x = static_cast<float>((point[p].x - particle.x) * inv_h);
      y = static_cast<float>((point[p].y - particle.y) * inv_h);
    };
    for (int s = 0; s < list.count; ++s) {
      const int segment = list.segment[s];
      if (segment != next) {
        relative(segment, ax, ay);
        for (int g = 0; g < groups; ++g)
          area_a[g] = dx[g] * ay - dy[g] * ax;
      }
      next = segment + 1;
      float bx, by;
      relative(next, bx, by);
      const float from = ax * by - ay * bx;
      const float size = reach * (std::fabs(ax) + std::fabs(ay) + std::fabs(bx) + std::fabs(by)) + std::fabs(ax * by) +
                         std::fabs(ay * bx);
      const float rounding = 1e-6f * size;  // > 8 float roundings of every area below
      const float far = rounding * size;    // beats the product of two areas unless both are beyond rounding
      const int bit = static_cast<int>(1u << s);
      const float sign_from = std::copysign(std::fabs(from) > rounding ? 1.f : 0.f, from);
      for (int g = 0; g < groups; ++g) {
        const Floats a = area_a[g], b = dx[g] * by - dy[g] * bx, to = from + (a - b);
        const Masks surely_not = (a * b > far) | (sign_from * to > rounding);
        bits[g] |= exec::unless(surely_not, bit);
        area_a[g] = b;
      }
      ax = bx;
      ay = by;
    }
    Masks any{};
    for (int g = 0; g < groups; ++g)
      any |= bits[g];
    int all = 0;
    for (int k = 0; k < float_lanes; ++k)
      all |= exec::lane(any, k);
    return all != 0;
  }
};

}  // namespace RIVEN_SIDE

}  // namespace riven
