// What the grid says of the motion of a crack's points: sums over the nodes around them, each in the field that the
// point sees there (surface_field.hpp), and the motion that fits them (surface_velocity.hpp).
#pragma once
#include <algorithm>
#include <cmath>
#include <type_traits>

#include "core/math/quad.hpp"
#include "core/math/shape.hpp"
#include "kernels/cells_around.hpp"
#include "kernels/surface_field.hpp"
#include "kernels/surface_velocity.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

template <class Shape, class Real>
struct Extrapolation {
  static constexpr int width = AxisWeights::width;
  static_assert(width == surface_width);
  static constexpr int off_grid = -1;

  SurfaceView view;
  const Real* mass;          ///< Grid
  const Real* q;             ///< Grid::q, or Grid::again
  bool again;                ///< the latter
  const int* extra;          ///< CrackFields
  const std::uint8_t* held;  ///< CrackFields
  double inv_h, dt;

  Extrapolation(const Grid<Real>& grid, bool by_again, const Cracks& cracks, const CrackFields& fields, double dt_)
      : view(surface_view(grid.lattice, cracks, fields)),
        mass(exec::data(grid.mass)),
        q(exec::data(by_again ? grid.again : grid.q)),
        again(by_again),
        extra(exec::data(fields.extra)),
        held(exec::data(fields.held)),
        inv_h(1 / grid.lattice.h),
        dt(dt_) {}

  /// The nodes around a point.
  struct Around {
    AxisWeights x, y;
  };

  RIVEN_INLINE AxisWeights along(double X, int axis) const {
    const Lattice& l = view.lattice;
    const double nearest = std::floor(X + 0.5), r = X - nearest;
    const double below = 0.5 - r, above = 0.5 + r;
    AxisWeights w{{l.h * (-1 - r), l.h * -r, l.h * (1 - r)},
                  {std::max(0., -r), 1 - std::fabs(r), std::max(0., r)},
                  {0.5 * below * below, 0.75 - r * r, 0.5 * above * above}};
    if constexpr (std::is_same_v<Shape, BSpline>) {
      const auto near = BSpline::axis(X, AxisSetting<double>{0, 0, l.wall_lower[axis], l.wall_upper[axis]});
      for (int i = 0; i < width; ++i)
        w.near[i] = near.s[i];
    }
    return w;
  }
  RIVEN_INLINE Around around(Vec2 x) const {
    const Vec2 X = (x - view.lattice.origin) * inv_h;
    return {along(X.x, 0), along(X.y, 1)};
  }
  /// The first node around a point, or off_grid if some are.
  RIVEN_INLINE int corner(Vec2 x) const {
    const Vec2 X = (x - view.lattice.origin) * inv_h;
    const int i = static_cast<int>(std::floor(X.x + 0.5)) - 1, j = static_cast<int>(std::floor(X.y + 0.5)) - 1;
    return on_grid(i, j) ? j * view.lattice.nx + i : off_grid;
  }
  RIVEN_INLINE bool on_grid(int i, int j) const {
    return i >= 0 && j >= 0 && i + width <= view.lattice.nx && j + width <= view.lattice.ny;
  }
  /// [vx vy ax ay] of a slot: of Grid::again = [v w], w the mean over the step, a = 2 (v - w) / dt.
  RIVEN_INLINE Quad<Real> motion(long slot) const {
    const Real* m = q + 4 * slot;
    if (!again)
      return quad_at<Real>(m);
    const Real twice = Real(2 / dt);
    return Quad<Real>{m[0], m[1], twice * (m[0] - m[2]), twice * (m[1] - m[3])};
  }
  /// Adds node (i, j) of those around a point, of mass m and the given motion [vx vy ax ay].
  RIVEN_INLINE void add(SurfaceSums& sums, const Around& at, int i, int j, const Real* motion, double m) const {
    const Vec2 a{double(motion[2]), double(motion[3])}, v{motion[0] - dt * a.x, motion[1] - dt * a.y};
    sums.add(m * at.x.near[i] * at.y.near[j], m * at.x.wide[i] * at.y.wide[j], at.x.r[i], at.y.r[j], v, a);
  }

  RIVEN_INLINE void add_slot(SurfaceSums& sums, const Around& at, int i, int j, long slot) const {
    alignas(4 * sizeof(Real)) Real m[4];
    quad_at<Real>(m) = motion(slot);
    add(sums, at, i, j, m, double(mass[slot]));
  }

  /// Asks for the nodes around a point some steps ahead, and, once those are known, for what they say of cracks: the
  /// points of a crack follow each other over the grid, where no processor would look next.
  RIVEN_INLINE void prefetch_nodes(Vec2 x) const {
    int node = std::max(corner(x), 0);
    for (int j = 0; j < width; ++j, node += view.lattice.nx) {
      exec::prefetch(view.node_index + node);
      exec::prefetch(view.cell_index + node);
      exec::prefetch(extra + node);
      exec::prefetch(mass + node);
      exec::prefetch(q + 4L * node);
      exec::prefetch(q + 4L * node + 8);
    }
  }
  RIVEN_INLINE void prefetch_fields(Vec2 x) const {
    int node = std::max(corner(x), 0);
    for (int j = 0; j < width; ++j, node += view.lattice.nx) {
      const int f = std::max(view.node_index[node], 0);  // any node, where it sees no crack
      const long slot = long{view.lattice.nodes()} + extra[node];
      exec::prefetch(view.nodes + f);
      exec::prefetch(view.nodes + f + 2);
      exec::prefetch(mass + slot);
      exec::prefetch(q + 4 * slot);
      exec::prefetch(q + 4 * slot + 8);
    }
  }

  /// Looks at what the nodes around a point know of cracks; false if the surfaces x are off the grid.
  RIVEN_INLINE bool look_around(const CrackPoint& point, const Vec2* x, SurfacePair& pair) const {
    const Lattice& l = view.lattice;
    pair.own = point;
    for (int k = 0; k < 2; ++k) {
      pair.x[k] = x[k];
      pair.cell[k] = cell_at<Shape>(l, (x[k] - l.origin) * inv_h);
      pair.first[k] = corner(x[k]);
    }
    if (pair.first[0] == off_grid || pair.first[1] == off_grid)
      return false;
    pair.around.load(view, pair.first[0]);
    return true;
  }

  /// use(k, around, slot) for the upper (k = 0) and the lower surface of a point: slot[k][n] is the slot of the n-th
  /// node around it, row by row, or -1. Not at all if the surfaces are off the grid.
  template <class Use>
  RIVEN_INLINE void each_surface(const CrackPoint& point, const Vec2* x, const Use& use) const {
    SurfacePair pair;
    if (!look_around(point, x, pair))
      return;
    alignas(64) SurfaceSlots slot;
    slots_of_surfaces(view, pair, slot);
    for (int k = 0; k < 2; ++k)
      use(k, around(x[k]), slot);
  }

  /// Copies the nodes around a surface at x to a lane; without slots, as nodes without mass.
  RIVEN_INLINE void put(SurfaceLanes<Real>& to, int lane, Vec2 x, const int* slot) const {
    to.x[lane] = x.x;
    to.y[lane] = x.y;
    for (int n = 0; n < width * width; ++n) {
      const int there = std::max(slot[n], 0);
      quad_at<Real>(to.q[n][lane]) = motion(there);
      to.mass[n][lane] = slot[n] < 0 ? Real(0) : mass[there];
    }
  }

  /// The motions of surfaces side by side, zeros where there is no mass.
  RIVEN_INLINE void fit(const SurfaceLanes<Real>& surfaces, MotionLanes& to) const {
    const Extrapolation from = *this;  // known to the compiler not to change
#pragma omp simd
    for (int k = 0; k < MotionLanes::lanes; ++k) {
      const Around at = from.around({surfaces.x[k], surfaces.y[k]});
      SurfaceSums sums;
#pragma GCC unroll 3
      for (int j = 0; j < width; ++j)
#pragma GCC unroll 3
        for (int i = 0; i < width; ++i) {
          const int n = j * width + i;
          from.add(sums, at, i, j, surfaces.q[n][k], double(surfaces.mass[n][k]));
        }
      to.put(k, fit_motion(sums, from.view.lattice.h));
    }
  }

  RIVEN_FN PointMotion of_all_fields(Vec2 x) const {
    const int first = corner(x);
    if (first == off_grid)
      return {};
    const Around at = around(x);
    SurfaceSums sums;
    for (int j = 0; j < width; ++j)
      for (int i = 0; i < width; ++i) {
        const int node = first + j * view.lattice.nx + i, f = view.node_index[node];
        const int cracks = f < 0 ? 0 : held[f];
        add_slot(sums, at, i, j, node);
        for (int field = 0; field < (1 << cracks) - 1; ++field)
          add_slot(sums, at, i, j, long{view.lattice.nodes()} + extra[node] + field);
      }
    return fit_motion(sums, view.lattice.h);
  }
};

}  // namespace RIVEN_SIDE

}  // namespace riven
