#include "kernels/move_cracks.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "core/exec/parallel.hpp"
#include "kernels/point_motion.hpp"

namespace riven {

namespace {

/// Points that one task looks up.
constexpr long points_of_task = 32;

/// Points whose surfaces are fitted together.
constexpr long points_of_fit = MotionLanes::lanes / 2;
static_assert(points_of_task % points_of_fit == 0);

/// What the grid says of crack points; mass 0 where that is nothing.
struct Found {
  std::unique_ptr<MotionLanes[]> surfaces;
  std::vector<PointMotion> all;  ///< [points] of all fields (motion with the centre of mass), or empty

  Found(long points, CrackMotion motion)
      : surfaces(std::make_unique_for_overwrite<MotionLanes[]>(
            static_cast<size_t>((points + points_of_fit - 1) / points_of_fit))),
        all(motion == CrackMotion::center_of_mass ? static_cast<size_t>(points) : 0) {}

  /// Of the upper (0) or the lower surface of point k.
  PointMotion surface(long k, int side) const {
    return surfaces[static_cast<size_t>(k / points_of_fit)].motion(static_cast<int>(2 * (k % points_of_fit)) + side);
  }
  PointMotion of_all(long k) const { return all.empty() ? PointMotion{} : all[static_cast<size_t>(k)]; }
};

/// How far a crack point moves in this step.
struct Moves {
  Vec2 upper, lower, plane;
  double angle = 0;  ///< by which the body turns there
  bool known = false;
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

/// A motion of less mass comes from nodes that the body barely reaches, as those around a crack's points that lie
/// outside of it: their accelerations f/m have no bound. Of a crack beside a body all are: `least` says so.
double sound_mass(const Found& found, long first, long last, double least) {
  double most = 5 * least;
  for (long k = first; k < last; ++k)
    most = std::max({most, found.surface(k, 0).mass, found.surface(k, 1).mass});
  return 0.2 * most;
}

/// The moves of point k by what was found for it with no less mass than is sound.
Moves moves_of(const Found& found, double sound, CrackRules rules, double dt, long k, Cracks& cracks) {
  const auto kept = [sound](const PointMotion& m) { return m.mass < sound ? PointMotion{} : m; };
  const PointMotion up = kept(found.surface(k, 0)), low = kept(found.surface(k, 1)), all = kept(found.of_all(k));
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

/// The nearest point along a crack whose moves are known; k itself if there is none.
long nearest_known(const std::vector<Moves>& moves, long k) {
  const long count = static_cast<long>(moves.size());
  for (long d = 0; d <= k || k + d < count; ++d)
    for (const long at : {k - d, k + d})
      if (at >= 0 && at < count && moves[static_cast<size_t>(at)].known)
        return at;
  return k;
}

/// Lets a point without moves of its own move as if it were fixed to another one.
void follow(const Moves& m, long other, long k, Moves& own, Cracks& cracks) {
  const Vec2 arm = cracks.plane[k] - cracks.plane[other];
  own.plane = m.plane + (std::cos(m.angle) - 1) * arm + std::sin(m.angle) * turned(arm);
  own.upper = own.lower = own.plane;
  if (!cracks.upper_velocity.empty()) {
    cracks.upper_velocity[k] = cracks.upper_velocity[other];
    cracks.lower_velocity[k] = cracks.lower_velocity[other];
  }
}

/// The faces are one at an open tip.
void close_tip(Moves& m, long k, Cracks& cracks) {
  m.upper = m.lower = m.plane;
  if (!cracks.upper_velocity.empty())
    cracks.upper_velocity[k] = cracks.lower_velocity[k] = 0.5 * (cracks.upper_velocity[k] + cracks.lower_velocity[k]);
}

/// Looks up the surfaces of points [first, end), as many as are fitted together. In stages, so that what one point
/// waits for is not what the next one does.
template <class Shape, class Real>
void find_surfaces(const Extrapolation<Shape, Real>& from, const Cracks& cracks, long first, long end,
                   MotionLanes& found) {
  SurfacePair pair[points_of_fit];
  bool on_grid[points_of_fit] = {};
  const long last = cracks.points() - 1;
  for (long k = first; k < end; ++k) {
    from.prefetch_nodes(cracks.plane[std::min(k + 2 * points_of_fit, last)]);
    from.prefetch_fields(cracks.plane[std::min(k + points_of_fit, last)]);
    const Vec2 surface[2] = {cracks.upper[k], cracks.lower[k]};
    on_grid[k - first] = from.look_around(crack_point(from.view, static_cast<int>(k)), surface, pair[k - first]);
  }
  SurfaceLanes<Real> lanes;
  for (long p = 0; p < points_of_fit; ++p) {
    alignas(64) SurfaceSlots slot;
    if (on_grid[p])
      slots_of_surfaces(from.view, pair[p], slot);
    else
      std::fill(slot[0], slot[0] + 2 * surface_lanes, -1);
    for (int side = 0; side < 2; ++side)
      from.put(lanes, static_cast<int>(2 * p + side), on_grid[p] ? pair[p].x[side] : Vec2{}, slot[side]);
  }
  from.fit(lanes, found);
}

/// Moves the points of one crack by what was found for them.
void move_crack(const CrackRules& rules, double dt, int crack, const Found& found, Cracks& cracks) {
  const long first = cracks.end_point(crack, false), last = cracks.end_point(crack, true) + 1;
  const double sound = sound_mass(found, first, last, rules.least_mass);
  std::vector<Moves> moves(static_cast<size_t>(last - first));
  for (long k = first; k < last; ++k)
    moves[static_cast<size_t>(k - first)] = moves_of(found, sound, rules, dt, k, cracks);
  for (long k = first; k < last; ++k) {
    Moves& own = moves[static_cast<size_t>(k - first)];
    if (own.known)
      continue;
    const long other = nearest_known(moves, k - first);
    follow(moves[static_cast<size_t>(other)], first + other, k, own, cracks);
  }
  if (cracks.is_open(crack, false))
    close_tip(moves.front(), first, cracks);
  if (cracks.is_open(crack, true))
    close_tip(moves.back(), last - 1, cracks);
  for (long k = first; k < last; ++k) {
    const Moves& m = moves[static_cast<size_t>(k - first)];
    cracks.upper[k] += m.upper;
    cracks.lower[k] += m.lower;
    cracks.plane[k] += m.plane;
  }
}

}  // namespace

template <class Shape, class Real>
void move_cracks(const exec::Space& space, const Grid<Real>& grid, const CrackFields& fields, CrackRules rules,
                 double dt, Cracks& cracks) {
  const Extrapolation<Shape, Real> from(grid, cracks, fields, dt);
  const long points = cracks.points();
  Found found(points, rules.motion);
  exec::parallel_tasks(space, "move cracks", (points + points_of_task - 1) / points_of_task, [&](long task) {
    const long end = std::min(points, (task + 1) * points_of_task);
    for (long first = task * points_of_task; first < end; first += points_of_fit)
      find_surfaces(from, cracks, first, std::min(end, first + points_of_fit),
                    found.surfaces[static_cast<size_t>(first / points_of_fit)]);
    for (long k = task * points_of_task; !found.all.empty() && k < end; ++k)
      found.all[static_cast<size_t>(k)] = from.of_all_fields(cracks.plane[k]);
  });
  exec::parallel_tasks(space, "move cracks", cracks.count(),
                       [&](long c) { move_crack(rules, dt, static_cast<int>(c), found, cracks); });
  cracks.velocities_known = true;
}

#define RIVEN_MOVE(Shape, Real)                                                                                 \
  template void move_cracks<Shape, Real>(const exec::Space&, const Grid<Real>&, const CrackFields&, CrackRules, \
                                         double, Cracks&);
#define RIVEN_MOVE_EACH(Real) RIVEN_EACH_SHAPE(RIVEN_MOVE, Real)
RIVEN_EACH_REAL(RIVEN_MOVE_EACH)
#undef RIVEN_MOVE_EACH
#undef RIVEN_MOVE

}  // namespace riven
