#include "kernels/apply_tractions.hpp"

#include <algorithm>

#include "core/exec/parallel.hpp"
#include "core/math/shape.hpp"
#include "kernels/advance_grid.hpp"
#include "kernels/crack_view.hpp"
#include "kernels/face_forces.hpp"
#include "kernels/point_motion.hpp"
#include "kernels/scatter.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

namespace {

/// Points that one task takes.
constexpr long points_of_task = 32;
/// A place on a crack with its surfaces.
struct FacePlace {
  CrackPoint at;
  Vec2 x[2];  ///< of the upper and the lower surface
};

RIVEN_FN FacePlace at_point(const SurfaceView& view, const CrackView& cracks, int k) {
  return {crack_point(view, k), {cracks.upper[k], cracks.lower[k]}};
}

/// A quarter of the way to the next point, where what a point bears has its middle; its faces are parted as they are
/// there.
RIVEN_FN FacePlace between(const SurfaceView& view, const CrackView& cracks, int k, int next) {
  FacePlace p{crack_point(view, k), {}};
  p.at.x = cracks.plane[k] + 0.25 * (cracks.plane[next] - cracks.plane[k]);
  p.x[0] = p.at.x + (cracks.upper[next] - cracks.plane[next]);
  p.x[1] = p.at.x + (cracks.lower[next] - cracks.plane[next]);
  return p;
}

/// Are other cracks than its own in sight of a point?
template <class Shape, class Real>
RIVEN_FN bool others_near(const Extrapolation<Shape, Real>& from, const CrackView& cracks, long k) {
  const SurfaceView& view = from.view;
  if (from.corner(cracks.plane[k]) == from.off_grid)
    return false;
  const int crack = cracks.crack[k];
  const int seen = view.cell_index[cell_at<Shape>(view.lattice, (cracks.plane[k] - view.lattice.origin) * from.inv_h)];
  for (int at = seen < 0 ? 0 : view.cell_start[seen]; seen >= 0 && at < view.cell_start[seen + 1]; ++at)
    if (view.crack[view.cell_segment[at]] != crack)
      return true;
  return false;
}

/// Spreads the force on the upper surface, and its opposite on the lower one; false where one of them finds no mass.
template <class Shape, class Real>
RIVEN_FN bool spread(const Extrapolation<Shape, Real>& from, const FacePlace& place, Vec2 force, double least,
                     double seen, PointForces& to) {
  bool found[2] = {false, false};
  from.each_surface(place.at, place.x, [&](int side, const auto& around, const auto& slot) {
    constexpr int width = AxisWeights::width;
    PointForces::Surface& s = to.surface[side];
    double mass[PointForces::nodes];
    SurfaceSums sums;
    for (int j = 0; j < width; ++j)
      for (int i = 0; i < width; ++i) {
        const int n = j * width + i, at = slot[side][n];
        s.slot[n] = std::max(at, 0);
        const double m = double(from.mass[s.slot[n]]);
        mass[n] = at >= 0 && m > least ? m : 0;
        from.add(sums, around, i, j, from.q + 4L * s.slot[n], mass[n]);
      }
    found[side] = sums.near > seen;
    if (!found[side])
      return;
    const MassAround around_point(sums);
    Vec2 rest = side == 0 ? force : -force;
    const TurningForce turning(around_point, rest, from.view.lattice.h);
    // what rounding leaves of the second part, near a lone node many times its usual size, is taken from the first
    for (int n = 0; n < PointForces::nodes; ++n) {
      const int i = n % width, j = n / width;
      s.force[n] = turning.on(mass[n], around.x.wide[i] * around.y.wide[j], {around.x.r[i], around.y.r[j]});
      rest -= s.force[n];
    }
    for (int n = 0; n < PointForces::nodes; ++n)
      s.force[n] += (mass[n] * around_point.near * around.x.near[n % width] * around.y.near[n / width]) * rest;
  });
  return found[0] && found[1];
}

}  // namespace

template <class Shape, class Real>
void apply_tractions(const exec::Space& space, ScatterKind kind, State<Real, 2>& s, exec::Array<PointForces>& forces) {
  const exec::Array<FaceForce> on_faces = face_forces(space, s.clock.time, s.cracks);
  const Extrapolation<Shape, Real> from(s.grid, false, s.cracks, s.fields, s.clock.dt);
  const CrackView cracks = crack_view(s.cracks);
  const long points = cracks.points;
  const double least = mass_cutoff(s), seen = least_mass_borne(s);
  forces.resize(2 * points);
  const FaceForce* on_face = exec::data(on_faces);
  PointForces* const to = exec::data_to_fill(forces);
  exec::launch_some(space, points, points_of_task, [=] RIVEN_KERNEL(long k) {
    const FaceForce face = on_face[k];
    const int point = static_cast<int>(k);
    PointForces* const half = to + 2 * k;
    half[0].applied = half[1].applied = false;
    if (face.force.x == 0 && face.force.y == 0)
      return;
    if (face.before == FaceForce::whole || !others_near(from, cracks, k)) {
      half[0].applied = spread(from, at_point(from.view, cracks, point), face.force, least, seen, half[0]);
      return;
    }
    for (int h = 0; h < 2; ++h)
      half[h].applied = spread(from, between(from.view, cracks, point, point + (h == 0 ? -1 : 1)),
                               (h == 0 ? face.before : 1 - face.before) * face.force, least, seen, half[h]);
  });
  exec::scatter_for(space, "tractions", kind == ScatterKind::ordered, 2 * points,
                    [=, q = exec::data(s.grid.q)] RIVEN_KERNEL(long k) {
                      for (int side = 0; to[k].applied && side < 2; ++side) {
                        const PointForces::Surface& at = to[k].surface[side];
                        for (int n = 0; n < PointForces::nodes; ++n) {
                          add(q[4L * at.slot[n] + 2], Real(at.force[n].x), in_team);
                          add(q[4L * at.slot[n] + 3], Real(at.force[n].y), in_team);
                        }
                      }
                    });
}

template <class Real>
void settle_tractions(const exec::Space& space, const exec::Array<PointForces>& forces, bool again, State<Real, 2>& s) {
  const Grid<Real>& grid = s.grid;
  const long points = forces.size() / 2;
  exec::Array<double> powers(points);
  exec::launch_some(
      space, points, points_of_task,
      [force = exec::data(forces), power = exec::data_to_fill(powers), q = exec::data(grid.q),
       last = again ? exec::data(grid.again) : nullptr, dt = s.clock.dt] RIVEN_KERNEL(long k) {
        double sum = 0;
        for (int part = 0; part < 4; ++part) {  // two halves, two sides
          const PointForces& half = force[2 * k + part / 2];
          if (!half.applied)
            continue;
          const PointForces::Surface& at = half.surface[part % 2];
          for (int n = 0; n < PointForces::nodes; ++n) {
            const long slot = 4L * at.slot[n];
            const Vec2 after{double(q[slot]), double(q[slot + 1])}, a{double(q[slot + 2]), double(q[slot + 3])};
            const Vec2 before = after - dt * a, v2 = last ? Vec2{double(last[slot]), double(last[slot + 1])} : after;
            sum += 0.5 * dot(at.force[n], before + v2);
          }
        }
        power[k] = sum;
      });
  book_tractions(powers, s.clock.dt, s.cracks, s.ledger.energy);
}

#define RIVEN_TRACTIONS_OF(Shape, Real)                                                        \
  template void apply_tractions<Shape, Real>(const exec::Space&, ScatterKind, State<Real, 2>&, \
                                             exec::Array<PointForces>&);
#define RIVEN_TRACTIONS(Real)                \
  RIVEN_EACH_SHAPE(RIVEN_TRACTIONS_OF, Real) \
  template void settle_tractions(const exec::Space&, const exec::Array<PointForces>&, bool, State<Real, 2>&);
RIVEN_EACH_REAL(RIVEN_TRACTIONS)
#undef RIVEN_TRACTIONS
#undef RIVEN_TRACTIONS_OF

}  // namespace RIVEN_SIDE

}  // namespace riven
