// Stress intensity factors from the energy release rate and the opening of the crack behind its tip.
//
// At a tip that runs with speed c, with beta_1^2 = 1 - (c/c_d)^2, beta_2^2 = 1 - (c/c_s)^2 and
// D = 4 beta_1 beta_2 - (1 + beta_2^2)^2,
//   2 mu J = A_I K_I^2 + A_II K_II^2,   A_I = beta_1 (1 - beta_2^2) / D,   A_II = beta_2 (1 - beta_2^2) / D,
//   delta_I : delta_II = A_I K_I : A_II K_II
// (Freund, Dynamic Fracture Mechanics, 1990, sections 4.3 and 5.3; Guo and Nairn, eqs. 14-18, whose eq. 16 has the two
// wave speeds exchanged and lacks the squares), hence
//   K_I^2 = 2 mu J beta_2 delta_I^2 / (A_I (delta_I^2 beta_2 + delta_II^2 beta_1)),  K_II^2 likewise.
// A_I, A_II tend to (kappa + 1) / 4 for c = 0.
#pragma once
#include "core/math/vec.hpp"
#include "core/scene/scene.hpp"

namespace riven {

struct StressIntensity {
  double I = 0, II = 0;  ///< Pa m^0.5; I > 0 opens, II > 0 moves the upper face (left of the tip's heading) forwards
};

/// Elastic constants of a solid in plane strain or stress as fracture mechanics uses them.
struct PlaneElasticity {
  double mu;                               ///< Pa
  double kappa;                            ///< 3 - 4 nu in plane strain, (3 - nu)/(1 + nu) in plane stress
  double E;                                ///< effective modulus E / (1 - nu^2) or E: K^2 = E J in either mode, Pa
  double shear_speed, dilatational_speed;  ///< m/s

  PlaneElasticity(const Material& m, Plane plane);
};

/// A_I and A_II of a tip that runs with `speed` (m/s, below the Rayleigh speed).
struct RunningTip {
  double beta1 = 1, beta2 = 1, A_I = 0, A_II = 0;
  double speed = 0, D = 0;  ///< m/s; 0 and no D where the tip is as good as at rest
  RunningTip() = default;
  RunningTip(const PlaneElasticity& solid, double speed);
};

/// Shares J (J/m^2) out to the modes by the opening (m) behind the tip, its normal part in x, its part along the
/// heading in y. Without an opening all is mode I; J < 0 gives no intensity.
StressIntensity share_out(const PlaneElasticity& solid, double J, double speed, Vec2 opening);

/// The same by intensities that are in the right proportion, such as those of the interaction integral.
StressIntensity share_in_proportion(const PlaneElasticity& solid, double J, double speed, StressIntensity proportion);

}  // namespace riven
