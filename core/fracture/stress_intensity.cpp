#include "core/fracture/stress_intensity.hpp"

#include <cmath>

namespace riven {

PlaneElasticity::PlaneElasticity(const Material& m, Plane plane) {
  const bool strain = plane == Plane::strain;
  mu = m.E / (2 * (1 + m.nu));
  kappa = strain ? 3 - 4 * m.nu : (3 - m.nu) / (1 + m.nu);
  E = strain ? m.E / (1 - m.nu * m.nu) : m.E;
  shear_speed = std::sqrt(mu / m.density);
  dilatational_speed = shear_speed * std::sqrt((kappa + 1) / (kappa - 1));
}

RunningTip::RunningTip(const PlaneElasticity& solid, double v) {
  const double s = v / solid.shear_speed, d = v / solid.dilatational_speed;
  // D is a difference of nearly equal numbers, of the size of s^2: below this the limit is closer
  if (s < 1e-3) {
    A_I = A_II = (solid.kappa + 1) / 4;
    return;
  }
  beta1 = std::sqrt(1 - d * d);
  beta2 = std::sqrt(1 - s * s);
  const double sum = 1 + beta2 * beta2;
  D = 4 * beta1 * beta2 - sum * sum;
  A_I = beta1 * s * s / D;
  A_II = beta2 * s * s / D;
  speed = v;
}

StressIntensity share_out(const PlaneElasticity& solid, double J, double speed, Vec2 opening) {
  if (!(J > 0))
    return {};
  const RunningTip tip(solid, speed);
  const double I = opening.x, II = opening.y, whole = I * I * tip.beta2 + II * II * tip.beta1;
  if (!(whole > 0))
    return {std::sqrt(2 * solid.mu * J / tip.A_I), 0};
  return {I * std::sqrt(2 * solid.mu * J * tip.beta2 / (tip.A_I * whole)),
          II * std::sqrt(2 * solid.mu * J * tip.beta1 / (tip.A_II * whole))};
}

StressIntensity share_in_proportion(const PlaneElasticity& solid, double J, double speed, StressIntensity proportion) {
  const RunningTip tip(solid, speed);
  return share_out(solid, J, speed, Vec2{tip.A_I * proportion.I, tip.A_II * proportion.II});
}

}  // namespace riven
