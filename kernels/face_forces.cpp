#include "kernels/face_forces.hpp"

#include "core/exec/parallel.hpp"
#include "core/state/tractions.hpp"

namespace riven {

exec::Array<Vec2> face_forces(const exec::Space& space, double time, Cracks& cracks) {
  for (CrackTraction& t : cracks.traction)
    t.law.pressure.value = t.pressure(time);
  exec::Array<Vec2> force(cracks.points());
  exec::parallel_for(space, "tractions", cracks.points(), [&cracks = std::as_const(cracks), f = force.data()](long k) {
    const int point = static_cast<int>(k);
    f[k] = face_area(cracks, point) * traction_on(cracks, point);
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
