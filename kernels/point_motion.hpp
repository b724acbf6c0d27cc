// What the grid says of the motion of a crack's points: sums over the nodes around them, each in the field that the
// point sees there (surface_field.hpp), and the motion that fits them (surface_velocity.hpp).
#pragma once
#include <algorithm>
#include <cmath>
#include <type_traits>

#include "core/math/shape.hpp"
#include "kernels/cells_around.hpp"
#include "kernels/surface_field.hpp"
#include "kernels/surface_velocity.hpp"

namespace riven {

template <class Shape, class Real>
struct Extrapolation {
  static constexpr int width = AxisWeights::width;
  static_assert(width == surface_width);

  const Grid<Real>& grid;
  const CrackFields& fields;
  SurfaceView view;
  double inv_h, dt;

  /// The nodes around a point.
  struct Around {
    AxisWeights x, y;
  };

  RIVEN_INLINE AxisWeights along(double X, int axis) const {
    const Lattice& l = grid.lattice;
    const double nearest = std::floor(X + 0.5), r = X - nearest;
    const double below = 0.5 - r, above = 0.5 + r;
    AxisWeights w{static_cast<int>(nearest) - 1,
                  {l.h * (-1 - r), l.h * -r, l.h * (1 - r)},
                  {std::max(0., -r), 1 - std::fabs(r), std::max(0., r)},
                  {0.5 * below * below, 0.75 - r * r, 0.5 * above * above}};
    if constexpr (std::is_same_v<Shape, BSpline>) {
      const auto near = BSpline::axis(X, AxisSetting<double>{0, 0, l.wall_lower[axis], l.wall_upper[axis]});
      std::copy(near.s, near.s + width, w.near);
    }
    return w;
  }
  RIVEN_INLINE Around around(Vec2 x) const {
    const Vec2 X = (x - grid.lattice.origin) * inv_h;
    return {along(X.x, 0), along(X.y, 1)};
  }
  /// The first node around a point, or 0 if some are off the grid.
  RIVEN_INLINE int corner(Vec2 x) const {
    const Vec2 X = (x - grid.lattice.origin) * inv_h;
    const int i = static_cast<int>(std::floor(X.x + 0.5)) - 1, j = static_cast<int>(std::floor(X.y + 0.5)) - 1;
    return on_grid(i, j) ? j * grid.lattice.nx + i : 0;
  }
  RIVEN_INLINE bool on_grid(int i, int j) const {
    return i >= 0 && j >= 0 && i + width <= grid.lattice.nx && j + width <= grid.lattice.ny;
  }
  RIVEN_INLINE bool on_grid(const Around& a) const { return on_grid(a.x.base, a.y.base); }

  RIVEN_INLINE void add(RowSums& row, const AxisWeights& x, int i, long slot, double mass) const {
    const Real* q = grid.q.data() + 4 * slot;
    row.add(mass, Quad<double>{double(q[0]), double(q[1]), double(q[2]), double(q[3])}, x, i);
  }

  /// Asks for the nodes around a point some steps ahead, and, once those are known, for what they say of cracks: the
  /// points of a crack follow each other over the grid, where no processor would look next.
  RIVEN_INLINE void prefetch_nodes(Vec2 x) const {
    int node = corner(x);
    for (int j = 0; j < width; ++j, node += grid.lattice.nx) {
      exec::prefetch(view.node_index + node);
      exec::prefetch(fields.extra.data() + node);
      exec::prefetch(grid.mass.data() + node);
      exec::prefetch(grid.q.data() + 4L * node);
      exec::prefetch(grid.q.data() + 4L * node + 8);
    }
  }
  RIVEN_INLINE void prefetch_fields(Vec2 x) const {
    int node = corner(x);
    for (int j = 0; j < width; ++j, node += grid.lattice.nx) {
      const int f = view.node_index[node];
      if (f < 0)
        continue;
      const long slot = long{grid.lattice.nodes()} + fields.extra[node];
      exec::prefetch(view.nodes + f);
      exec::prefetch(view.nodes + f + 2);
      exec::prefetch(grid.mass.data() + slot);
      exec::prefetch(grid.q.data() + 4 * slot);
      exec::prefetch(grid.q.data() + 4 * slot + 8);
    }
  }

  /// use(k, around, slot) for the upper (k = 0) and the lower surface of a point: slot[k][n] is the slot of the n-th
  /// node around it, row by row, or -1. Not at all if the surfaces are off the grid.
  template <class Use>
  RIVEN_INLINE void each_surface(const CrackPoint& point, const Vec2* x, const Use& use) const {
    const Lattice& l = grid.lattice;
    const Around a[2] = {around(x[0]), around(x[1])};
    if (!on_grid(a[0]) || !on_grid(a[1]))
      return;
    const auto cell = [&](Vec2 at) { return cell_at<Shape>(l, (at - l.origin) * inv_h); };
    SurfacePoint s[2] = {{point, Side::above, x[0], cell(x[0])}, {point, Side::below, x[1], cell(x[1])}};
    const bool together = a[0].x.base == a[1].x.base && a[0].y.base == a[1].y.base;
    alignas(64) SurfaceSlots slot;
    for (int first = 0; first < 2; first += together ? 2 : 1) {
      slots_of_surfaces(view, s, a[first].x.base, a[first].y.base, slot);
      for (int k = first; k < (together ? 2 : first + 1); ++k)
        use(k, a[k], slot);
    }
  }

  /// put(k, sums) for the upper (k = 0) and the lower surface of a point; not at all if they are off the grid.
  template <class Put>
  RIVEN_INLINE void sum_surfaces(const CrackPoint& point, const Vec2* x, const Put& put) const {
    each_surface(point, x, [&](int k, const Around& a, const SurfaceSlots& slot) {
      MotionSums sums;
      for (int j = 0; j < width; ++j) {
        RowSums row;
#pragma GCC unroll 3
        for (int i = 0; i < width; ++i) {
          const int at = slot[k][j * width + i], there = std::max(at, 0);
          add(row, a.x, i, there, at < 0 ? 0. : double(grid.mass[there]));
        }
        sums.add(row, a.y, j);
      }
      put(k, surface_sums(sums, dt));
    });
  }

  PointMotion of_all_fields(Vec2 x) const {
    const Around a = around(x);
    if (!on_grid(a))
      return {};
    MotionSums sums;
    for (int j = 0; j < width; ++j) {
      RowSums row;
      for (int i = 0; i < width; ++i) {
        const int node = (a.y.base + j) * grid.lattice.nx + a.x.base + i, f = fields.node_index[node];
        const int held = f < 0 ? 0 : fields.held[f];
        add(row, a.x, i, node, grid.mass[node]);
        for (int field = 0; field < (1 << held) - 1; ++field) {
          const long slot = long{grid.lattice.nodes()} + fields.extra[node] + field;
          add(row, a.x, i, slot, grid.mass[slot]);
        }
      }
      sums.add(row, a.y, j);
    }
    return fit_motion(surface_sums(sums, dt), grid.lattice.h);
  }
};

}  // namespace riven
