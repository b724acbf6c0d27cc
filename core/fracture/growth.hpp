// When a crack grows, and in which direction: fracture criteria at one tip (Nairn and Aimene, section 3.5).
//
// The hoop stress around a tip varies as K_I cos^3(t/2) - 3 K_II cos^2(t/2) sin(t/2) over the angle t from the
// direction of the tip, counter-clockwise (Erdogan and Sih, J. Basic Eng. 85 (1963) 519-527). Its greatest value, as
// the stress intensity factor of a mode I crack in that direction, is K^max; it is found where
//   K_I sin t + K_II (3 cos t - 1) = 0,   tan(t/2) = -2 K_II / (K_I + sqrt(K_I^2 + 8 K_II^2)),
// which is the angle of the paper for K_I >= 0, 70.53 degrees where K_I = 0. For K_I < 0 it is the
// greatest value still, and the paper's formula, which has |K_I|, is not.
#pragma once
#include "core/math/vec.hpp"
#include "core/scene/scene.hpp"
#include "core/state/tips.hpp"

namespace riven {

struct HoopStress {
  double angle = 0;  ///< rad, counter-clockwise from the direction of the tip
  double K = 0;      ///< Pa m^0.5
};

HoopStress greatest_hoop_stress(double K_I, double K_II);

/// Speed of surface waves, the limit of a tip in mode I: the root of
///   (2 - c^2/c_s^2)^2 = 4 sqrt(1 - c^2/c_d^2) sqrt(1 - c^2/c_s^2),
/// with the c_d of waves in plane strain or in a plate in plane stress.
double rayleigh_speed(const Material& material, Plane plane);

/// Steps from one check of a tip to the next: as many as a tip takes at the speed limit to grow by one particle, less
/// the fraction, so that the limit can be reached; J from a field that has not yet answered the last segment means
/// nothing.
long check_interval(double particle, double speed_limit, double dt);

/// How near a tip is to growth: its K^max, or the square root of its J, over that at which it grows; at least 1 where
/// it does, 0 where nothing drives it. Faces that are shut in mode I (K_I < 0) release nothing by it.
double growth_load(const GrowthRule& rule, const Tip& tip);

/// Steps for which a tip at rest may be left alone: half of those in which its load, which rises by `rise` a step,
/// comes to 1, but no more than `most`, in case it rises faster from now on, and fewer from a load of 0.9 on; at
/// least 1.
long steps_at_rest(double load, double rise, long most);

/// Whether the tip is to be checked in this step, so that J and K are needed.
inline bool growth_due(const Tip& tip, long step) {
  return tip.open && tip.grows && step >= tip.due;
}

/// The direction in which a crack grows by the K of its tip, of unit length. `ahead`: direction of the crack at the
/// tip, of unit length. Of a fixed heading and its opposite, the one that lies ahead is taken.
Vec2 growth_direction(const GrowthRule& rule, const Tip& tip, Vec2 ahead);

}  // namespace riven
