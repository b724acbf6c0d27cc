#include "kernels/move_cracks.hpp"

#include <cmath>
#include <type_traits>
#include <vector>

#include "core/exec/parallel.hpp"
#include "core/math/shape.hpp"
#include "kernels/surface_field.hpp"

namespace riven {

namespace {

/// Grid velocity and acceleration at a point; mass 0 where none was found.
struct Motion {
  double mass = 0;
  Vec2 velocity, acceleration;
};

/// How far a crack point moves in this step.
struct Moves {
  Vec2 upper, lower, plane;
  bool known = false;
};

template <class Shape, class Real>
struct Extrapolation {
  using Ordinary = std::conditional_t<std::is_same_v<Shape, BSpline>, BSpline, Linear>;

  const Grid<Real>& grid;
  const CrackFields& fields;
  SurfaceView view;
  double inv_h;

  /// add(node, weight) for the nodes that a point sees; X is its position in cells.
  template <class Add>
  void each_node(Vec2 X, const Add& add) const {
    const Lattice& l = grid.lattice;
    const AxisSetting<double> along_x{0, 0, l.wall_lower[0], l.wall_upper[0]};
    const AxisSetting<double> along_y{0, 0, l.wall_lower[1], l.wall_upper[1]};
    const auto ax = Ordinary::axis(X.x, along_x);
    const auto ay = Ordinary::axis(X.y, along_y);
    for (int j = 0; j < Ordinary::width; ++j)
      for (int i = 0; i < Ordinary::width; ++i) {
        const int nx = ax.base + i, ny = ay.base + j;
        if (nx < 0 || ny < 0 || nx >= l.nx || ny >= l.ny)
          continue;
        const double weight = ax.s[i] * ay.s[j];
        if (weight > 0)
          add(ny * l.nx + nx, weight);
      }
  }
  Vec2 in_cells(Vec2 x) const { return (x - grid.lattice.origin) * inv_h; }

  /// Adds the slot, weighted with its mass.
  void add(Motion& m, int slot, double weight) const {
    const double mass = weight * grid.mass[slot];
    const Real* q = grid.q.data() + 4L * slot;
    if (!(mass > 0))
      return;
    m.mass += mass;
    m.velocity += mass * Vec2{double(q[0]), double(q[1])};
    m.acceleration += mass * Vec2{double(q[2]), double(q[3])};
  }
  int slot(int node, int field) const {
    return field == 0 ? node : grid.lattice.nodes() + fields.extra[node] + field - 1;
  }
  static Motion renormalised(Motion m) {
    if (m.mass > 0) {
      m.velocity *= 1 / m.mass;
      m.acceleration *= 1 / m.mass;
    }
    return m;
  }

  Motion of_surface(Vec2 x, int point, Side side) const {
    const Lattice& l = grid.lattice;
    const Vec2 X = in_cells(x);
    const int i = Shape::cell(X.x), j = Shape::cell(X.y);
    Motion m;
    if (i < 0 || j < 0 || i >= l.nx || j >= l.ny)
      return m;
    const SurfacePoint s = surface_point(view, point, side, x, j * l.nx + i);
    each_node(X, [&](int node, double weight) {
      const int field = field_of_surface(view, s, node);
      if (field >= 0)
        add(m, slot(node, field), weight);
    });
    return renormalised(m);
  }

  Motion of_all_fields(Vec2 x) const {
    Motion m;
    each_node(in_cells(x), [&](int node, double weight) {
      add(m, node, weight);
      const int f = fields.node_index[node];
      if (f < 0)
        return;
      const int held = fields.nodes[f].crack[1] >= 0 ? 3 : fields.nodes[f].crack[0] >= 0 ? 1 : 0;
      for (int field = 1; field <= held; ++field)
        add(m, slot(node, field), weight);
    });
    return renormalised(m);
  }
};

/// The move of one surface; `velocity` is that kept by XPIC(1).
Vec2 surface_move(const Motion& m, SurfaceUpdate update, double dt, bool velocity_known, Vec2* velocity) {
  switch (update) {
    case SurfaceUpdate::pic: return m.velocity * dt;
    case SurfaceUpdate::flip: return (m.velocity - m.acceleration * (dt / 2)) * dt;
    case SurfaceUpdate::xpic: break;
  }
  const Vec2 before = velocity_known ? *velocity : m.velocity - m.acceleration * dt;
  *velocity = m.velocity;
  return ((3 * m.velocity - before) * 0.5 - m.acceleration * dt) * dt;
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

}  // namespace

template <class Shape, class Real>
void move_cracks(const exec::Space& space, const Grid<Real>& grid, const CrackFields& fields, CrackRules rules,
                 double dt, Cracks& cracks) {
  const Extrapolation<Shape, Real> from{grid, fields, surface_view(grid.lattice, cracks, fields), 1 / grid.lattice.h};
  const bool xpic = rules.update == SurfaceUpdate::xpic;
  std::vector<Moves> moves(static_cast<size_t>(cracks.points()));
  exec::parallel_tasks(space, "move cracks", cracks.points(), [&](long k) {
    const int point = static_cast<int>(k);
    const Motion up = from.of_surface(cracks.upper[k], point, Side::above);
    const Motion low = from.of_surface(cracks.lower[k], point, Side::below);
    const bool has_up = up.mass > 0, has_low = low.mass > 0;
    Vec2* const up_velocity = xpic ? &cracks.upper_velocity[k] : nullptr;
    Vec2* const low_velocity = xpic ? &cracks.lower_velocity[k] : nullptr;
    Moves& m = moves[static_cast<size_t>(k)];
    if (has_up)
      m.upper = surface_move(up, rules.update, dt, cracks.velocities_known, up_velocity);
    if (has_low)
      m.lower = surface_move(low, rules.update, dt, cracks.velocities_known, low_velocity);
    m.plane = has_up && has_low ? 0.5 * (m.upper + m.lower) : has_up ? m.upper : m.lower;
    m.known = has_up || has_low;
    if (rules.motion == CrackMotion::center_of_mass) {
      const Motion all = from.of_all_fields(cracks.plane[k]);
      if (all.mass > 0)
        m.plane = surface_move(all, SurfaceUpdate::flip, dt, true, nullptr);
      m.known = m.known || all.mass > 0;
    }
    if (!has_up)
      m.upper = m.plane;
    if (!has_low)
      m.lower = m.plane;
    if (xpic && has_up != has_low)
      (has_up ? *low_velocity : *up_velocity) = (has_up ? up : low).velocity;
  });
  exec::parallel_for(space, "move cracks", cracks.points(), [&](long k) {
    const long as = nearest_known(moves, cracks, k);
    const Moves& m = moves[static_cast<size_t>(as)];
    const bool own = as == k;
    cracks.upper[k] += own ? m.upper : m.plane;
    cracks.lower[k] += own ? m.lower : m.plane;
    cracks.plane[k] += m.plane;
    if (xpic && !own) {
      cracks.upper_velocity[k] = cracks.upper_velocity[as];
      cracks.lower_velocity[k] = cracks.lower_velocity[as];
    }
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
