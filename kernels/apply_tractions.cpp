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

/// S* of both surfaces; false where one of them finds no mass.
template <class Shape, class Real>
bool weigh(const Extrapolation<Shape, Real>& from, const Cracks& cracks, int k, double least, PointForces& to) {
  const Vec2 x[2] = {cracks.upper[k], cracks.lower[k]};
  double mass[2] = {0, 0};
  from.each_surface(crack_point(from.view, k), x, [&](int side, const auto& around, const auto& slot) {
    constexpr int width = AxisWeights::width;
    PointForces::Surface& s = to.surface[side];
    for (int n = 0; n < PointForces::nodes; ++n) {
      const int at = slot[n][side];
      const double m = at < 0 ? 0 : double(from.grid.mass[at]);
      s.slot[n] = std::max(at, 0);
      s.weight[n] = m > least ? m * around.x.near[n % width] * around.y.near[n / width] : 0;
      mass[side] += s.weight[n];
    }
  });
  for (int side = 0; side < 2; ++side)
    for (double& w : to.surface[side].weight)
      w /= mass[side];
  return mass[0] > 0 && mass[1] > 0;
}

}  // namespace

template <class Shape, class Real>
void apply_tractions(const exec::Space& space, State<Real, 2>& s, std::vector<PointForces>& forces) {
  const Cracks& cracks = s.cracks;
  for (CrackTraction& t : s.cracks.traction)
    t.law.pressure.value = t.pressure(s.clock.time);
  const Extrapolation<Shape, Real> from{.grid = s.grid,
                                        .fields = s.fields,
                                        .view = surface_view(s.grid.lattice, cracks, s.fields),
                                        .inv_h = 1 / s.grid.lattice.h,
                                        .dt = s.clock.dt};
  const long points = cracks.points();
  const double least = mass_cutoff(s);
  forces.resize(static_cast<size_t>(points));
  exec::parallel_tasks(space, "tractions", (points + points_of_task - 1) / points_of_task, [&](long task) {
    const long end = std::min(points, (task + 1) * points_of_task);
    for (long k = task * points_of_task; k < end; ++k) {
      PointForces& f = forces[static_cast<size_t>(k)];
      f.force = face_area(cracks, static_cast<int>(k)) * traction_on(cracks, static_cast<int>(k));
      f.applied = (f.force.x != 0 || f.force.y != 0) && weigh(from, cracks, static_cast<int>(k), least, f);
    }
  });
  for (const PointForces& f : forces)
    for (int side = 0; f.applied && side < 2; ++side)
      for (int n = 0; n < PointForces::nodes; ++n) {
        const double w = side == 0 ? f.surface[side].weight[n] : -f.surface[side].weight[n];
        Real* q = s.grid.q.data() + 4L * f.surface[side].slot[n];
        q[2] += Real(w * f.force.x);
        q[3] += Real(w * f.force.y);
      }
}

template <class Real>
void settle_tractions(const std::vector<PointForces>& forces, State<Real, 2>& s) {
  const double dt = s.clock.dt;
  Cracks& cracks = s.cracks;
  Energy& energy = s.ledger.energy;
  const auto velocity = [&](const PointForces::Surface& at) {
    Vec2 mean;
    for (int n = 0; n < PointForces::nodes; ++n) {
      const Real* q = s.grid.q.data() + 4L * at.slot[n];
      mean += at.weight[n] * Vec2{q[0] - 0.5 * dt * q[2], q[1] - 0.5 * dt * q[3]};
    }
    return mean;
  };
  cracks.lead = cracks.upper_velocity.empty() ? 0 : 0.5 * dt;
  for (int k = 0; k < cracks.points(); ++k) {
    const TractionLaw& law = cracks.traction[static_cast<size_t>(cracks.crack[k])].law;
    const PointForces& f = forces[static_cast<size_t>(k)];
    if (law.kind == TractionLaw::Kind::pressure && f.applied)
      energy.external_work += dt * dot(f.force, velocity(f.surface[0]) - velocity(f.surface[1]));
    else if (const double area = face_area(cracks, k); law.kind == TractionLaw::Kind::cohesive && area > 0)
      energy.debonding += area * law.cohesive.damage(law_opening(cracks, k), cracks.cohesive[k]);
  }
}

#define RIVEN_TRACTIONS(Shape, Real) \
  template void apply_tractions<Shape, Real>(const exec::Space&, State<Real, 2>&, std::vector<PointForces>&);
RIVEN_TRACTIONS(Linear, double)
RIVEN_TRACTIONS(UGimp, double)
RIVEN_TRACTIONS(BSpline, double)
#undef RIVEN_TRACTIONS
template void settle_tractions(const std::vector<PointForces>&, State<double, 2>&);

}  // namespace riven
