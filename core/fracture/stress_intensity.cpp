#include "core/fracture/stress_intensity.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace riven {

PlaneElasticity::PlaneElasticity(const Material& m, Plane plane) {
  const bool strain = plane == Plane::strain;
  mu = m.E / (2 * (1 + m.nu));
  kappa = strain ? 3 - 4 * m.nu : (3 - m.nu) / (1 + m.nu);
  E = strain ? m.E / (1 - m.nu * m.nu) : m.E;
  shear_speed = std::sqrt(mu / m.density);
  dilatational_speed = shear_speed * std::sqrt((kappa + 1) / (kappa - 1));
}

RunningTip::RunningTip(const PlaneElasticity& solid, double speed) {
  const double d = speed / solid.dilatational_speed, s = speed / solid.shear_speed;
  beta1 = std::sqrt(1 - d * d);
  beta2 = std::sqrt(1 - s * s);
  // D is a difference of nearly equal numbers, of the size of s^2: below this the limit is closer
  if (s < 1e-3) {
    A_I = A_II = (solid.kappa + 1) / 4;
    return;
  }
  const double sum = 1 + beta2 * beta2, D = 4 * beta1 * beta2 - sum * sum;
  A_I = beta1 * s * s / D;
  A_II = beta2 * s * s / D;
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

AuxiliaryFields auxiliary_fields(const PlaneElasticity& solid, Vec2 r) {
  const double R = norm(r), c = std::sqrt(std::max(0.0, 0.5 * (1 + r.x / R))),
               s = std::copysign(std::sqrt(std::max(0.0, 0.5 * (1 - r.x / R))), r.y);  // of half the angle
  const double c3 = c * (4 * c * c - 3), s3 = s * (3 - 4 * s * s);                     // of one and a half times it
  const double scale = 1 / std::sqrt(2 * std::numbers::pi * R), k = solid.kappa;
  const double cos = 2 * c * c - 1, sin = 2 * s * c, inv_2mu = 1 / (2 * solid.mu);
  const double lateral = (3 - k) / 4;  // nu in plane strain, nu / (1 + nu) in plane stress
  // u = sqrt(R / 2 pi) / (2 mu) U(theta);  du/dx = cos du/dR - sin / R du/dtheta
  const auto field = [&](double sxx, double syy, double sxy, double Ux, double dUx, double Uy, double dUy) {
    const double sx = scale * sxx, sy = scale * syy, st = scale * sxy, trace = lateral * (sx + sy);
    const double to_u = scale * inv_2mu;
    return AuxiliaryField{sx,
                          sy,
                          st,
                          inv_2mu * (sx - trace),
                          inv_2mu * (sy - trace),
                          inv_2mu * st,
                          to_u * (0.5 * cos * Ux - sin * dUx),
                          to_u * (0.5 * cos * Uy - sin * dUy)};
  };
  const double a = k - cos, b = k + 2 + cos, d = k - 2 + cos;
  return {
      field(c * (1 - s * s3), c * (1 + s * s3), c * s * c3, c * a, c * sin - 0.5 * s * a, s * a, 0.5 * c * a + s * sin),
      field(-s * (2 + c * c3), s * c * c3, c * (1 - s * s3), s * b, 0.5 * c * b - s * sin, -c * d,
            0.5 * s * d + c * sin)};
}

}  // namespace riven
