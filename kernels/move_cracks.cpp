#include "kernels/move_cracks.hpp"

#include <algorithm>

#include "core/exec/parallel.hpp"
#include "kernels/crack_view.hpp"
#include "kernels/move_points.hpp"
#include "kernels/point_motion.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

namespace {

/// Points whose surfaces are fitted together, and those that one task moves.
constexpr long points_of_fit = MotionLanes::lanes / 2, points_of_move = exec::lanes > 1 ? 32 : 1;

/// Takes the change of a fitted velocity over the step in place of the acceleration around each surface.
template <class Shape, class Real>
RIVEN_FN void fit_changes(const Extrapolation<Shape, Real>& from, SurfaceLanes<Real>& lanes, MotionLanes& motions) {
  for (auto& node : lanes.q)
    for (auto& motion : node)
      motion[2] = motion[3] = 0;
  MotionLanes after;
  from.fit(lanes, after);
  for (int k = 0; k < MotionLanes::lanes; ++k) {
    PointMotion m = motions.motion(k);
    m.acceleration = (after.motion(k).before - m.before) * (1 / from.dt);
    motions.put(k, m);
  }
}

/// Looks up the surfaces of points [first, end), as many as are fitted together. In stages, so that what one point
/// waits for is not what the next one does.
template <class Shape, class Real>
RIVEN_FN void find_surfaces(const Extrapolation<Shape, Real>& from, const CrackView& cracks, bool cohesive, long first,
                            long end, PointMotion* found) {
  SurfacePair pair[points_of_fit];
  bool on_grid[points_of_fit] = {};
  const long last = cracks.points - 1;
  for (long k = first; k < end; ++k) {
    from.prefetch_nodes(cracks.plane[std::min(k + 2 * points_of_fit, last)]);
    from.prefetch_fields(cracks.plane[std::min(k + points_of_fit, last)]);
    const CrackPoint point = crack_point(from.view, static_cast<int>(k));
    const Vec2 gap = cracks.to_faces(k);
    const Vec2 surface[2] = {cracks.upper[k] + gap.x * point.left, cracks.lower[k] - gap.y * point.left};
    on_grid[k - first] = from.look_around(point, surface, pair[k - first]);
  }
  SurfaceLanes<Real> lanes;
  for (long p = 0; p < points_of_fit; ++p) {
    alignas(64) SurfaceSlots slot;
    if (on_grid[p])
      slots_of_surfaces(from.view, pair[p], slot);
    else
      for (auto& of_side : slot)
        std::fill(of_side, of_side + surface_lanes, -1);
    for (int side = 0; side < 2; ++side)
      from.put(lanes, static_cast<int>(2 * p + side), on_grid[p] ? pair[p].x[side] : Vec2{}, slot[side]);
  }
  MotionLanes motions;
  from.fit(lanes, motions);
  if (cohesive)
    fit_changes(from, lanes, motions);
  for (long n = 2 * first; n < 2 * end; ++n)
    found[n] = motions.motion(static_cast<int>(n - 2 * first));
}

}  // namespace

template <class Shape, class Real>
void move_cracks(const exec::Space& space, const Grid<Real>& grid, const CrackFields& fields, CrackRules rules,
                 double dt, Cracks& cracks) {
  const Extrapolation<Shape, Real> from(grid, rules.again, std::as_const(cracks), fields, dt);
  const CrackView at = crack_view(cracks);
  const long points = at.points;
  FoundMotions found;
  found.surfaces.resize(2 * points);
  const bool of_all = rules.motion == CrackMotion::center_of_mass;
  found.all.resize(of_all ? points : 0);
  exec::parallel_tasks(space, "move cracks", (points + points_of_move - 1) / points_of_move,
                       [=, cohesive = rules.cohesive, surfaces = exec::data_to_fill(found.surfaces),
                        all = exec::data_to_fill(found.all)] RIVEN_KERNEL(long task) {
                         const long end = std::min(points, (task + 1) * points_of_move);
                         for (long first = task * points_of_move; first < end; first += points_of_fit)
                           find_surfaces(from, at, cohesive, first, std::min(end, first + points_of_fit), surfaces);
                         for (long k = task * points_of_move; of_all && k < end; ++k)
                           all[k] = from.of_all_fields(at.plane[k]);
                       });
  move_points(space, found, rules, dt, cracks);
}

#define RIVEN_MOVE(Shape, Real)                                                                                 \
  template void move_cracks<Shape, Real>(const exec::Space&, const Grid<Real>&, const CrackFields&, CrackRules, \
                                         double, Cracks&);
#define RIVEN_MOVE_EACH(Real) RIVEN_EACH_SHAPE(RIVEN_MOVE, Real)
RIVEN_EACH_REAL(RIVEN_MOVE_EACH)
#undef RIVEN_MOVE_EACH
#undef RIVEN_MOVE

}  // namespace RIVEN_SIDE

}  // namespace riven
