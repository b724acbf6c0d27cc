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

/// What the grid says of a crack point; mass 0 where that is nothing.
struct Found {
  PointMotion up, low, all;  ///< of the surfaces, and of all fields (motion with the centre of mass)
};

/// How far a crack point moves in this step.
struct Moves {
  Vec2 upper, lower, plane;
  double angle = 0;  ///< by which the body turns there
  bool known = false;
};

template <class Shape, class Real>
struct Extrapolation {
  using Ordinary = std::conditional_t<std::is_same_v<Shape, BSpline>, BSpline, Linear>;
  static constexpr int width = 3;

  const Grid<Real>& grid;
  const CrackFields& fields;
  SurfaceView view;
  double inv_h, dt;

  /// What one point sees of the nodes around it, with so many fields on each.
  template <int fields_each>
  struct Seen {
    Vec2 x;
    int count = 0;
    NodeMotion node[fields_each * width * width];
  };
  Vec2 in_cells(Vec2 x) const { return (x - grid.lattice.origin) * inv_h; }

  /// Along one axis: the first of the three nodes around the nearest one, and their weights.
  struct Weights {
    int base;
    double near[width], wide[width];
  };
  static Weights along(double X, int wall_lower, int wall_upper) {
    const int base = static_cast<int>(std::floor(X + 0.5)) - 1;
    const double r = X - (base + 1);
    Weights w{base, {}, {0.5 * (0.5 - r) * (0.5 - r), 0.75 - r * r, 0.5 * (0.5 + r) * (0.5 + r)}};
    const auto ordinary = Ordinary::axis(X, AxisSetting<double>{0, 0, wall_lower, wall_upper});
    for (int i = 0; i < Ordinary::width; ++i)
      w.near[ordinary.base + i - base] = ordinary.s[i];
    return w;
  }

  /// add(node, its place, N_i, B_i) for the nodes around a point.
  template <class Add>
  void each_node(Vec2 x, const Add& add) const {
    const Lattice& l = grid.lattice;
    const Vec2 X = in_cells(x);
    const Weights along_x = along(X.x, l.wall_lower[0], l.wall_upper[0]);
    const Weights along_y = along(X.y, l.wall_lower[1], l.wall_upper[1]);
    for (int j = 0; j < width; ++j)
      for (int i = 0; i < width; ++i) {
        const int nx = along_x.base + i, ny = along_y.base + j;
        if (nx >= 0 && ny >= 0 && nx < l.nx && ny < l.ny)
          add(ny * l.nx + nx, l.position(nx, ny), along_x.near[i] * along_y.near[j], along_x.wide[i] * along_y.wide[j]);
      }
  }

  template <int fields_each>
  void add(Seen<fields_each>& seen, int node, Vec2 place, int field, double near, double wide) const {
    const long slot = field == 0 ? node : long{grid.lattice.nodes()} + fields.extra[node] + field - 1;
    const double mass = grid.mass[slot];
    if (!(mass > 0))
      return;
    const Real* q = grid.q.data() + 4 * slot;
    const Vec2 v{double(q[0]), double(q[1])}, a{double(q[2]), double(q[3])};
    seen.node[seen.count++] = {mass * near, mass * wide, place - seen.x, v - dt * a, a};
  }

  PointMotion of_surface(const CrackPoint& point, Side side, Vec2 x) const {
    const Lattice& l = grid.lattice;
    const Vec2 X = in_cells(x);
    const int i = Shape::cell(X.x), j = Shape::cell(X.y);
    if (i < 0 || j < 0 || i >= l.nx || j >= l.ny)
      return {};
    const SurfacePoint s = surface_point(view, point, side, x, j * l.nx + i);
    Seen<1> seen{x, 0, {}};
    each_node(x, [&](int node, Vec2 place, double near, double wide) {
      const int field = field_of_surface(view, s, node, place);
      if (field >= 0)
        add(seen, node, place, field, near, wide);
    });
    return fit_motion(seen.node, seen.count, grid.lattice.h);
  }

  PointMotion of_all_fields(Vec2 x) const {
    Seen<4> seen{x, 0, {}};
    each_node(x, [&](int node, Vec2 place, double near, double wide) {
      add(seen, node, place, 0, near, wide);
      const int f = fields.node_index[node];
      if (f < 0)
        return;
      const int held = fields.nodes[f].crack[1] >= 0 ? 3 : fields.nodes[f].crack[0] >= 0 ? 1 : 0;
      for (int field = 1; field <= held; ++field)
        add(seen, node, place, field, near, wide);
    });
    return fit_motion(seen.node, seen.count, grid.lattice.h);
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
    most = std::max({most, f->up.mass, f->low.mass});
  for (auto f = first; f != last; ++f)
    for (PointMotion* m : {&f->up, &f->low, &f->all})
      if (m->mass < 0.2 * most)
        *m = {};
}

/// The moves of point k by what was found for it.
Moves moves_of(const Found& found, CrackRules rules, double dt, long k, Cracks& cracks) {
  const auto& [up, low, all] = found;
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
  exec::parallel_tasks(space, "move cracks", cracks.points(), [&](long k) {
    const CrackPoint point = crack_point(from.view, static_cast<int>(k));
    Found& f = found[static_cast<size_t>(k)];
    f.up = from.of_surface(point, Side::above, cracks.upper[k]);
    f.low = from.of_surface(point, Side::below, cracks.lower[k]);
    if (rules.motion == CrackMotion::center_of_mass)
      f.all = from.of_all_fields(cracks.plane[k]);
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
