#include "core/fracture/growth.hpp"

#include <algorithm>
#include <cmath>

#include "core/fracture/stress_intensity.hpp"

namespace riven {

HoopStress greatest_hoop_stress(double K_I, double K_II) {
  const double root = std::sqrt(K_I * K_I + 8 * K_II * K_II);
  // the same half angle twice, each where nothing cancels
  const double half = K_I >= 0 || K_II == 0 ? std::atan2(-2 * K_II, std::fabs(K_I) + root)
                                            : std::atan2((K_I - root) * (K_II > 0 ? 1 : -1), 4 * std::fabs(K_II));
  const double c = std::cos(half), s = std::sin(half);
  return {2 * half, c * c * (K_I * c - 3 * K_II * s)};
}

double rayleigh_speed(const Material& m, Plane plane) {
  const PlaneElasticity solid(m, plane);
  const double ratio = solid.shear_speed / solid.dilatational_speed, ratio2 = ratio * ratio;
  // the equation squared, over c^2/c_s^2 =: x, has one root in (0, 1)
  const auto f = [&](double x) { return ((x - 8) * x + 24 - 16 * ratio2) * x - 16 * (1 - ratio2); };
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (f(middle) < 0 ? low : high) = middle;
  }
  return solid.shear_speed * std::sqrt(high);
}

long check_interval(double particle, double speed_limit, double dt) {
  // the allowance keeps a whole number of steps but for rounding
  return std::max(1L, static_cast<long>(particle / (speed_limit * dt) * (1 + 1e-9)));
}

double growth_load(const GrowthRule& rule, const Tip& tip) {
  if (rule.criterion == GrowthCriterion::k_max)
    return std::max(0., greatest_hoop_stress(tip.drive_I, tip.drive_II).K / rule.toughness);
  const double K2 = tip.drive_I * tip.drive_I + tip.drive_II * tip.drive_II;
  const double J = tip.drive_I < 0 && K2 > 0 ? tip.release * tip.drive_II * tip.drive_II / K2 : tip.release;
  return std::sqrt(std::max(0., J / rule.toughness));
}

long steps_at_rest(double load, double rise, long most) {
  constexpr double near = 0.1;  // to growth: less than this, and noise may take a tip there that rises no more
  if (!(load < 1) || most < 2)
    return 1;
  const double least = 0.5 * near / static_cast<double>(most);
  return std::clamp(static_cast<long>(0.5 * (1 - load) / std::max(rise, least)), 1L, most);
}

Vec2 growth_direction(const GrowthRule& rule, const Tip& tip, Vec2 ahead) {
  switch (rule.direction) {
    case GrowthDirection::self_similar: return ahead;
    case GrowthDirection::fixed: {
      const Vec2 heading = rule.heading * (1 / norm(rule.heading));
      return dot(heading, ahead) < 0 ? -heading : heading;
    }
    case GrowthDirection::hoop: break;
  }
  const double angle = greatest_hoop_stress(tip.drive_I, tip.drive_II).angle;
  return std::cos(angle) * ahead + std::sin(angle) * turned(ahead);
}

}  // namespace riven
