#include "kernels/apply_tractions.hpp"

#include <algorithm>

#include "core/exec/parallel.hpp"
#include "core/math/shape.hpp"
#include "core/state/tractions.hpp"
#include "kernels/advance_grid.hpp"
#include "kernels/point_motion.hpp"

namespace riven {

namespace {

constexpr long points_of_task = 32;

/// Spreads the force on the upper surface of a point, and its opposite on the lower one; false where one of them finds
/// no mass.
template <class Shape, class Real>
bool spread(const Extrapolation<Shape, Real>& from, const Cracks& cracks, int k, Vec2 force, double least,
            PointForces& to) {
  const Vec2 x[2] = {cracks.upper[k], cracks.lower[k]};
  bool found[2] = {false, false};
  from.each_surface(crack_point(from.view, k), x, [&](int side, const auto& around, const auto& slot) {
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
    found[side] = sums.near > 0;
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
void apply_tractions(const exec::Space& space, State<Real, 2>& s, std::vector<PointForces>& forces) {
  const Cracks& cracks = s.cracks;
  for (CrackTraction& t : s.cracks.traction)
    t.law.pressure.value = t.pressure(s.clock.time);
  const Extrapolation<Shape, Real> from(s.grid, cracks, s.fields, s.clock.dt);
  const long points = cracks.points();
  const double least = mass_cutoff(s);
  forces.resize(static_cast<size_t>(points));
  exec::parallel_tasks(space, "tractions", (points + points_of_task - 1) / points_of_task, [&](long task) {
    const long end = std::min(points, (task + 1) * points_of_task);
    for (long k = task * points_of_task; k < end; ++k) {
      PointForces& f = forces[static_cast<size_t>(k)];
      const Vec2 force = face_area(cracks, static_cast<int>(k)) * traction_on(cracks, static_cast<int>(k));
      f.applied = (force.x != 0 || force.y != 0) && spread(from, cracks, static_cast<int>(k), force, least, f);
    }
  });
  for (const PointForces& f : forces)
    for (int side = 0; f.applied && side < 2; ++side)
      for (int n = 0; n < PointForces::nodes; ++n) {
        Real* q = s.grid.q.data() + 4L * f.surface[side].slot[n];
        q[2] += Real(f.surface[side].force[n].x);
        q[3] += Real(f.surface[side].force[n].y);
      }
}

template <class Real>
void settle_tractions(const std::vector<PointForces>& forces, State<Real, 2>& s) {
  const double dt = s.clock.dt;
  Cracks& cracks = s.cracks;
  Energy& energy = s.ledger.energy;
  const auto power = [&](const PointForces::Surface& at) {
    double sum = 0;
    for (int n = 0; n < PointForces::nodes; ++n) {
      const Real* q = s.grid.q.data() + 4L * at.slot[n];
      sum += dot(at.force[n], Vec2{q[0] - 0.5 * dt * q[2], q[1] - 0.5 * dt * q[3]});
    }
    return sum;
  };
  cracks.lead = cracks.upper_velocity.empty() ? 0 : 0.5 * dt;
  for (int k = 0; k < cracks.points(); ++k) {
    const TractionLaw& law = cracks.traction[static_cast<size_t>(cracks.crack[k])].law;
    const PointForces& f = forces[static_cast<size_t>(k)];
    if (law.kind == TractionLaw::Kind::pressure && f.applied)
      energy.external_work += dt * (power(f.surface[0]) + power(f.surface[1]));
    else if (const double area = face_area(cracks, k); law.kind == TractionLaw::Kind::cohesive && area > 0)
      energy.debonding += area * law.cohesive.damage(law_opening(cracks, k), cracks.cohesive[k]);
  }
}

#define RIVEN_TRACTIONS(Real)                                                                                   \
  template void apply_tractions<Linear, Real>(const exec::Space&, State<Real, 2>&, std::vector<PointForces>&);  \
  template void apply_tractions<UGimp, Real>(const exec::Space&, State<Real, 2>&, std::vector<PointForces>&);   \
  template void apply_tractions<BSpline, Real>(const exec::Space&, State<Real, 2>&, std::vector<PointForces>&); \
  template void settle_tractions(const std::vector<PointForces>&, State<Real, 2>&);
RIVEN_EACH_REAL(RIVEN_TRACTIONS)
#undef RIVEN_TRACTIONS

}  // namespace riven
