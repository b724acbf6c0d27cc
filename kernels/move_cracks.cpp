#include "kernels/move_cracks.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

#include "core/exec/parallel.hpp"
#include "core/math/shape.hpp"
#include "kernels/surface_field.hpp"
#include "kernels/surface_velocity.hpp"

namespace riven {

namespace {

/// Points that one task takes.
constexpr long points_of_task = 32;

/// What the grid says of a crack point; mass 0 where that is nothing.
struct Found {
  PointMotion surface[2];  ///< upper and lower
  PointMotion all;         ///< of all fields (motion with the centre of mass)
};

/// How far a crack point moves in this step.
struct Moves {
  Vec2 upper, lower, plane;
  double angle = 0;  ///< by which the body turns there
  bool known = false;
};

template <class Shape, class Real>
struct Extrapolation {
  static constexpr int width = AxisWeights::width;

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
  bool on_grid(const Around& a) const {
    return a.x.base >= 0 && a.y.base >= 0 && a.x.base + width <= grid.lattice.nx && a.y.base + width <= grid.lattice.ny;
  }

  RIVEN_INLINE void add(RowSums& row, const AxisWeights& x, int i, long slot, double mass) const {
    const Real* q = grid.q.data() + 4 * slot;
    row.add(mass, Quad<double>{double(q[0]), double(q[1]), double(q[2]), double(q[3])}, x, i);
  }

  /// What the surfaces s[first] to s[last - 1] of a point find on the nodes around them.
  RIVEN_INLINE void sum_surfaces(const SurfacePoint* s, const Around* a, int first, int last, MotionSums* sums) const {
    const Lattice& l = grid.lattice;
    int slot[width * width][2];
    for (int n = 0; n < width * width; ++n) {
      const int i = a[first].x.base + n % width, j = a[first].y.base + n / width;
      slots_of_surfaces(view, s, j * l.nx + i, l.position(i, j), slot[n]);
    }
    for (int k = first; k < last; ++k)
      for (int j = 0; j < width; ++j) {
        RowSums row;
#pragma GCC unroll 3
        for (int i = 0; i < width; ++i) {
          const int at = slot[j * width + i][k], there = std::max(at, 0);
          add(row, a[k].x, i, there, at < 0 ? 0. : double(grid.mass[there]));
        }
        sums[k].add(row, a[k].y, j);
      }
  }

  /// Motions of the upper and the lower surface of a point.
  void of_surfaces(const CrackPoint& point, const Vec2* x, PointMotion* motion) const {
    const Lattice& l = grid.lattice;
    const Around a[2] = {around(x[0]), around(x[1])};
    if (!on_grid(a[0]) || !on_grid(a[1]))
      return;
    SurfacePoint s[2];
    for (int k = 0; k < 2; ++k) {
      const int i = Shape::cell((x[k].x - l.origin.x) * inv_h), j = Shape::cell((x[k].y - l.origin.y) * inv_h);
      s[k] = surface_point(view, point, k == 0 ? Side::above : Side::below, x[k], j * l.nx + i);
    }
    MotionSums sums[2];
    if (a[0].x.base == a[1].x.base && a[0].y.base == a[1].y.base) {
      sum_surfaces(s, a, 0, 2, sums);
    } else {
      sum_surfaces(s, a, 0, 1, sums);
      sum_surfaces(s, a, 1, 2, sums);
    }
    for (int k = 0; k < 2; ++k)
      motion[k] = fit_motion(sums[k], l.h, dt);
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
        for (int field = 0; field < (held < 2 ? held : 3); ++field) {
          const long slot = long{grid.lattice.nodes()} + fields.extra[node] + field;
          add(row, a.x, i, slot, grid.mass[slot]);
        }
      }
      sums.add(row, a.y, j);
    }
    return fit_motion(sums, grid.lattice.h, dt);
  }
};

/// The move of one surface; `velocity` is that kept by XPIC(1).
Vec2 surface_move(const PointMotion& m, SurfaceUpdate update, double dt, bool velocity_known, Vec2* velocity) {
  const Vec2 after = m.after(dt);
  switch (update) {
    case SurfaceUpdate::pic: return after * dt;
    case SurfaceUpdate::flip: return 0.5 * (m.before + after) * dt;
    case SurfaceUpdate::xpic: break;
  }
  const Vec2 last = velocity_known ? *velocity : m.before;
  *velocity = after;
  return (m.before + 0.5 * (after - last)) * dt;
}

/// Drops what comes from nodes that the body barely reaches, those of a crack's points that lie outside of it: their
/// accelerations f/m have no bound.
void drop_light(const Cracks& cracks, long crack, std::vector<Found>& found) {
  const auto first = found.begin() + cracks.start[static_cast<size_t>(crack)];
  const auto last = found.begin() + cracks.start[static_cast<size_t>(crack) + 1];
  double most = 0;
  for (auto f = first; f != last; ++f)
    most = std::max({most, f->surface[0].mass, f->surface[1].mass});
  for (auto f = first; f != last; ++f)
    for (PointMotion* m : {&f->surface[0], &f->surface[1], &f->all})
      if (m->mass < 0.2 * most)
        *m = {};
}

/// The moves of point k by what was found for it.
Moves moves_of(const Found& found, CrackRules rules, double dt, long k, Cracks& cracks) {
  const PointMotion &up = found.surface[0], &low = found.surface[1], &all = found.all;
  const bool has_up = up.mass > 0, has_low = low.mass > 0, xpic = rules.update == SurfaceUpdate::xpic;
  Vec2* const up_velocity = xpic ? &cracks.upper_velocity[k] : nullptr;
  Vec2* const low_velocity = xpic ? &cracks.lower_velocity[k] : nullptr;
  Moves m;
  if (has_up)
    m.upper = surface_move(up, rules.update, dt, cracks.velocities_known, up_velocity);
  if (has_low)
    m.lower = surface_move(low, rules.update, dt, cracks.velocities_known, low_velocity);
  const PointMotion& any = has_up ? up : has_low ? low : all;
  if (xpic && !has_up)
    *up_velocity = any.after(dt);
  if (xpic && !has_low)
    *low_velocity = any.after(dt);
  m.plane = has_up && has_low ? 0.5 * (m.upper + m.lower) : has_up ? m.upper : m.lower;
  m.angle = dt * (has_up && has_low ? 0.5 * (up.spin + low.spin) : up.spin + low.spin);
  m.known = has_up || has_low;
  if (all.mass > 0) {
    m.plane = surface_move(all, SurfaceUpdate::flip, dt, true, nullptr);
    m.angle = dt * all.spin;
    m.known = true;
  }
  if (!has_up)
    m.upper = m.plane;
  if (!has_low)
    m.lower = m.plane;
  return m;
}

/// The nearest point of the same crack, along it, whose moves are known; k itself if there is none.
long nearest_known(const std::vector<Moves>& moves, const Cracks& cracks, long k) {
  const int c = cracks.crack[k];
  const long first = cracks.start[static_cast<size_t>(c)], last = cracks.start[static_cast<size_t>(c) + 1];
  for (long d = 0; k - d >= first || k + d < last; ++d)
    for (long at : {k - d, k + d})
      if (at >= first && at < last && moves[static_cast<size_t>(at)].known)
        return at;
  return k;
}

/// Moves a point without moves of its own as if it were fixed to another one, which has not been moved yet.
void follow(const std::vector<Moves>& moves, long other, long k, Cracks& cracks) {
  const Moves& m = moves[static_cast<size_t>(other)];
  const Vec2 arm = cracks.plane[k] - cracks.plane[other];
  const Vec2 move = m.plane + (std::cos(m.angle) - 1) * arm + std::sin(m.angle) * turned(arm);
  cracks.upper[k] += move;
  cracks.lower[k] += move;
  cracks.plane[k] += move;
  if (!cracks.upper_velocity.empty()) {
    cracks.upper_velocity[k] = cracks.upper_velocity[other];
    cracks.lower_velocity[k] = cracks.lower_velocity[other];
  }
}

}  // namespace

template <class Shape, class Real>
void move_cracks(const exec::Space& space, const Grid<Real>& grid, const CrackFields& fields, CrackRules rules,
                 double dt, Cracks& cracks) {
  const Extrapolation<Shape, Real> from{.grid = grid,
                                        .fields = fields,
                                        .view = surface_view(grid.lattice, cracks, fields),
                                        .inv_h = 1 / grid.lattice.h,
                                        .dt = dt};
  const size_t points = static_cast<size_t>(cracks.points());
  std::vector<Found> found(points);
  std::vector<Moves> moves(points);
  exec::parallel_tasks(space, "move cracks", (cracks.points() + points_of_task - 1) / points_of_task, [&](long task) {
    const long first = task * points_of_task, end = std::min<long>(cracks.points(), first + points_of_task);
    for (long k = first; k < end; ++k) {
      Found& f = found[static_cast<size_t>(k)];
      const CrackPoint point = crack_point(from.view, static_cast<int>(k));
      const Vec2 surface[2] = {cracks.upper[k], cracks.lower[k]};
      from.of_surfaces(point, surface, f.surface);
      if (rules.motion == CrackMotion::center_of_mass)
        f.all = from.of_all_fields(cracks.plane[k]);
    }
  });
  exec::parallel_for(space, "move cracks", cracks.count(), [&](long c) { drop_light(cracks, c, found); });
  exec::parallel_for(space, "move cracks", cracks.points(), [&](long k) {
    moves[static_cast<size_t>(k)] = moves_of(found[static_cast<size_t>(k)], rules, dt, k, cracks);
  });
  exec::parallel_for(space, "move cracks", cracks.points(), [&](long k) {
    if (!moves[static_cast<size_t>(k)].known)
      follow(moves, nearest_known(moves, cracks, k), k, cracks);
  });
  exec::parallel_for(space, "move cracks", cracks.points(), [&](long k) {
    const Moves& m = moves[static_cast<size_t>(k)];
    cracks.upper[k] += m.upper;
    cracks.lower[k] += m.lower;
    cracks.plane[k] += m.plane;
  });
  cracks.velocities_known = true;
}

#define RIVEN_MOVE(Shape, Real)                                                                                 \
  template void move_cracks<Shape, Real>(const exec::Space&, const Grid<Real>&, const CrackFields&, CrackRules, \
                                         double, Cracks&);
RIVEN_MOVE(Linear, double)
RIVEN_MOVE(UGimp, double)
RIVEN_MOVE(BSpline, double)
RIVEN_MOVE(Linear, float)
RIVEN_MOVE(UGimp, float)
RIVEN_MOVE(BSpline, float)
#undef RIVEN_MOVE

}  // namespace riven
