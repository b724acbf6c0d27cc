#include "kernels/face_forces.hpp"

#include "core/exec/parallel.hpp"
#include "core/state/tractions.hpp"

namespace riven {

namespace {

/// Share of a point's force that acts on the segment before it.
double share_before(const Cracks& cracks, int point) {
  const int crack = cracks.crack[point];
  if (cracks.traction[static_cast<size_t>(crack)].law.kind != TractionLaw::Kind::pressure ||
      point == cracks.end_point(crack, false) || point == cracks.end_point(crack, true))
    return FaceForce::whole;
  const Vec2 bearing = cracks.bearing[point];
  const double before = bearing.x * norm(cracks.plane[point] - cracks.plane[point - 1]),
               after = bearing.y * norm(cracks.plane[point + 1] - cracks.plane[point]);
  return before + after > 0 ? before / (before + after) : FaceForce::whole;
}

}  // namespace

exec::Array<FaceForce> face_forces(const exec::Space& space, double time, Cracks& cracks) {
  for (CrackTraction& t : cracks.traction)
    t.law.pressure.value = t.pressure(time);
  exec::Array<FaceForce> force(cracks.points());
  exec::parallel_for(space, "tractions", cracks.points(), [&cracks = std::as_const(cracks), f = force.data()](long k) {
    const int point = static_cast<int>(k);
    const double area = face_area(cracks, point);
    f[k] = {area * traction_on(cracks, point), area > 0 ? share_before(cracks, point) : FaceForce::whole};
  });
  return force;
}

void book_tractions(const exec::Array<double>& power, double dt, Cracks& cracks, Energy& energy) {
  cracks.lead = cracks.upper_velocity.empty() ? 0 : 0.5 * dt;
  for (int k = 0; k < cracks.points(); ++k) {
    const TractionLaw& law = cracks.traction[static_cast<size_t>(cracks.crack[k])].law;
    if (law.kind == TractionLaw::Kind::pressure)
      energy.external_work += dt * power[k];
    else if (const double area = face_area(cracks, k); law.kind == TractionLaw::Kind::cohesive && area > 0)
      energy.debonding += area * law.cohesive.damage(law_opening(cracks, k), cracks.cohesive[k]);
  }
}

}  // namespace riven
