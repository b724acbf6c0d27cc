#include "core/fracture/stress_intensity.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
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

namespace {

AuxiliaryFields at_rest(const PlaneElasticity& solid, Vec2 r) {
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

/// u = sqrt(2 / pi) B / mu [Re or Im of combinations of sqrt(z_1) and sqrt(z_2)], z_j = x + i beta_j y.
AuxiliaryFields running(const PlaneElasticity& solid, const RunningTip& tip, Vec2 r) {
  using Complex = std::complex<double>;
  const double a = tip.beta1, b = tip.beta2, sum = 1 + b * b;
  // d sqrt(z) / dx; d/dy is i beta times that
  const Complex z1 = 0.5 / std::sqrt(Complex(r.x, a * r.y)), z2 = 0.5 / std::sqrt(Complex(r.x, b * r.y));
  const Complex w1 = Complex(0, a) * z1, w2 = Complex(0, b) * z2;
  const double scale = std::sqrt(2 / std::numbers::pi) / (solid.mu * tip.D);
  const double lambda = solid.mu * (3 - solid.kappa) / (solid.kappa - 1);
  const auto field = [&](double uxx, double uxy, double uyx, double uyy) {
    const double trace = lambda * (uxx + uyy), shear = 0.5 * (uxy + uyx);
    return AuxiliaryField{
        trace + 2 * solid.mu * uxx, trace + 2 * solid.mu * uyy, 2 * solid.mu * shear, uxx, uyy, shear, uxx, uyx};
  };
  const double I = scale * sum, II = scale * 2 * b, p = 2 * a * b / sum, q = 2 * a / sum, t = sum / 2,
               u = sum / (2 * b);
  return {field(I * (z1.real() - p * z2.real()), I * (w1.real() - p * w2.real()), I * (q * z2.imag() - a * z1.imag()),
                I * (q * w2.imag() - a * w1.imag())),
          field(II * (z1.imag() - t * z2.imag()), II * (w1.imag() - t * w2.imag()),
                II * (a * z1.real() - u * z2.real()), II * (a * w1.real() - u * w2.real()))};
}

}  // namespace

AuxiliaryFields auxiliary_fields(const PlaneElasticity& solid, const RunningTip& tip, Vec2 r) {
  // the fields of a running tip tend to those at rest as the square of the speed, but by differences
  return tip.speed > 0.05 * solid.shear_speed ? running(solid, tip, r) : at_rest(solid, r);
}

}  // namespace riven
