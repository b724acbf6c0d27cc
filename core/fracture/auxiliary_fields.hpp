// The known fields that the interaction integral goes by: stresses and displacement gradients around a tip in its frame
// (x along its heading) under K_I = 1 and under K_II = 1, the first terms of Williams' series at rest, those of a tip
// that runs steadily (Freund, Dynamic Fracture Mechanics, 1990, sections 4.3 and 4.4) else. Written without branches
// and functions of angles, so that loops over particles vectorise.
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/exec/config.hpp"
#include "core/fracture/stress_intensity.hpp"
#include "core/math/vec.hpp"

namespace riven {

struct AuxiliaryField {
  double sxx, syy, sxy;   ///< Pa
  double exx, eyy, exy;   ///< strains
  double dux_dx, duy_dx;  ///< of the displacement along the heading; times minus the speed, its velocity
};
/// Under K_I = 1 and under K_II = 1 Pa m^0.5.
struct AuxiliaryFields {
  AuxiliaryField mode[2];
};

namespace detail {

/// Cosine and sine of half the angle of (x, y), which is R from the origin, R^2 = x^2 + y^2. y = -0 is below y = 0.
struct HalfAngle {
  double c, s;
  RIVEN_INLINE HalfAngle(double x, double y, double inv_R)
      : c(std::sqrt(std::max(0.0, 0.5 * (1 + x * inv_R)))),
        s(std::copysign(std::sqrt(std::max(0.0, 0.5 * (1 - x * inv_R))), y)) {}
};

}  // namespace detail

/// At rest:  u = sqrt(R / 2 pi) / (2 mu) U(theta),  du/dx = cos du/dR - sin / R du/dtheta.
class FieldsAtRest {
 public:
  explicit FieldsAtRest(const PlaneElasticity& solid)
      : k_(solid.kappa), inv_2mu_(1 / (2 * solid.mu)), lateral_((3 - solid.kappa) / 4) {}

  /// At an offset r from the tip, m.
  RIVEN_INLINE AuxiliaryFields operator()(Vec2 r) const {
    const double inv_R = 1 / norm(r);
    const auto [c, s] = detail::HalfAngle(r.x, r.y, inv_R);
    const double c3 = c * (4 * c * c - 3), s3 = s * (3 - 4 * s * s);  // of one and a half times the angle
    const double scale = std::sqrt(inv_R * (0.5 / std::numbers::pi));
    const double cos = 2 * c * c - 1, sin = 2 * s * c, a = k_ - cos, b = k_ + 2 + cos, d = k_ - 2 + cos;
    return {
        field(scale, c * (1 - s * s3), c * (1 + s * s3), c * s * c3,  //
              0.5 * cos * (c * a) - sin * (c * sin - 0.5 * s * a), 0.5 * cos * (s * a) - sin * (0.5 * c * a + s * sin)),
        field(scale, -s * (2 + c * c3), s * c * c3, c * (1 - s * s3),
              0.5 * cos * (s * b) - sin * (0.5 * c * b - s * sin),
              0.5 * cos * (-c * d) - sin * (0.5 * s * d + c * sin))};
  }

 private:
  RIVEN_INLINE AuxiliaryField field(double scale, double sxx, double syy, double sxy, double dux, double duy) const {
    const double sx = scale * sxx, sy = scale * syy, st = scale * sxy, trace = lateral_ * (sx + sy);
    const double to_u = scale * inv_2mu_;
    return {sx, sy, st, inv_2mu_ * (sx - trace), inv_2mu_ * (sy - trace), inv_2mu_ * st, to_u * dux, to_u * duy};
  }

  double k_, inv_2mu_;
  double lateral_;  ///< nu in plane strain, nu / (1 + nu) in plane stress
};

/// Running:  u = sqrt(2 / pi) B / mu [Re or Im of combinations of sqrt(z_1) and sqrt(z_2)],  z_j = x + i beta_j y.
class FieldsRunning {
 public:
  FieldsRunning(const PlaneElasticity& solid, const RunningTip& tip)
      : a_(tip.beta1), b_(tip.beta2), mu_(solid.mu), lambda_(solid.mu * (3 - solid.kappa) / (solid.kappa - 1)) {
    const double sum = 1 + b_ * b_, scale = std::sqrt(2 / std::numbers::pi) / (solid.mu * tip.D);
    I_ = scale * sum;
    II_ = scale * 2 * b_;
    p_ = 2 * a_ * b_ / sum;
    q_ = 2 * a_ / sum;
    t_ = sum / 2;
    u_ = sum / (2 * b_);
  }

  RIVEN_INLINE AuxiliaryFields operator()(Vec2 r) const {
    // d sqrt(z) / dx = 1 / (2 sqrt(z)); d/dy is i beta times that
    const Vec2 z1 = slope(r.x, a_ * r.y), z2 = slope(r.x, b_ * r.y);
    const Vec2 w1{-a_ * z1.y, a_ * z1.x}, w2{-b_ * z2.y, b_ * z2.x};
    return {field(I_ * (z1.x - p_ * z2.x), I_ * (w1.x - p_ * w2.x), I_ * (q_ * z2.y - a_ * z1.y),
                  I_ * (q_ * w2.y - a_ * w1.y)),
            field(II_ * (z1.y - t_ * z2.y), II_ * (w1.y - t_ * w2.y), II_ * (a_ * z1.x - u_ * z2.x),
                  II_ * (a_ * w1.x - u_ * w2.x))};
  }

 private:
  RIVEN_INLINE static Vec2 slope(double x, double y) {
    const double inv_R = 1 / std::sqrt(x * x + y * y), scale = 0.5 * std::sqrt(inv_R);
    const auto [c, s] = detail::HalfAngle(x, y, inv_R);
    return {scale * c, -scale * s};
  }
  RIVEN_INLINE AuxiliaryField field(double uxx, double uxy, double uyx, double uyy) const {
    const double trace = lambda_ * (uxx + uyy), shear = 0.5 * (uxy + uyx);
    return {trace + 2 * mu_ * uxx, trace + 2 * mu_ * uyy, 2 * mu_ * shear, uxx, uyy, shear, uxx, uyx};
  }

  double a_, b_, mu_, lambda_;
  double I_, II_, p_, q_, t_, u_;
};

/// Calls f with the fields of a tip. Those of a running tip tend to those at rest as the square of the speed, but by
/// differences of nearly equal numbers.
template <class F>
decltype(auto) with_fields(const PlaneElasticity& solid, const RunningTip& tip, F&& f) {
  if (tip.speed > 0.05 * solid.shear_speed)
    return f(FieldsRunning(solid, tip));
  return f(FieldsAtRest(solid));
}

inline AuxiliaryFields auxiliary_fields(const PlaneElasticity& solid, const RunningTip& tip, Vec2 r) {
  return with_fields(solid, tip, [&](const auto& fields) { return fields(r); });
}

/// d(delta)/dx along the heading of the openings under K_I = 1 and K_II = 1, 1 m behind a tip; as vectors of the plane,
/// upper less lower face of the crack. They fall as one over the root of the distance.
struct KnownOpening {
  Vec2 slope[2];

  /// `last`: the tip is the last one of its crack, whose upper face is to the left of its heading.
  KnownOpening(const PlaneElasticity& solid, const RunningTip& tip, Vec2 heading, bool last) {
    const AuxiliaryFields left = auxiliary_fields(solid, tip, {-1.0, 0.0}),
                          right = auxiliary_fields(solid, tip, {-1.0, -0.0});
    for (int m = 0; m < 2; ++m) {
      const double along = left.mode[m].dux_dx - right.mode[m].dux_dx;
      const double across = left.mode[m].duy_dx - right.mode[m].duy_dx;
      slope[m] = (last ? 1.0 : -1.0) * (along * heading + across * turned(heading));
    }
  }
};

}  // namespace riven
