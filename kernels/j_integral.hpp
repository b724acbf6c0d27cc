// The sums over particles around a tip that make up the J integral (j_domain.hpp), in the first configuration K:
//   J_K = - sum a_p E_Kj dq/dx_j + sum a_p q P_K - sum a_p q B_K,
//   a E_Kj = (m/t) [ (w + v^2/2) F_jK - tau_ij (F_iK - delta_iK) ],
//   a P_K  = (m/t) [ a_i (F_iK - delta_iK) - v_i (grad v F)_iK ],          (Nairn and Aimene, eq. 9, times F)
//   a B_K  = (m/t) b_i (F_iK - delta_iK)
// with m/t the mass per thickness, w the strain energy and tau the Kirchhoff stress per mass, and b what body forces
// and loads on particles give to a unit of mass. For small strains this is the integral as printed, but for B_K; at any
// strain and rotation it is that of the crack's length when it was stress-free. P_K counts where inertia is asked for.
// B_K counts everywhere: by the weight of a solid the stress along a crack may change as much within the contour as
// opens the crack.
//
// v_i (grad v F)_iK is the gradient of v^2/2. Around a tip at rest, where v is finite, Green's theorem makes what it
// adds to the area the opposite of what v^2/2 adds to the band and the faces. So there v counts in neither: a body that
// spins at omega would else have J of rho omega^2 x_tip times the area within the contour where inertia is left out.
//
// Around a tip that runs steadily both parts of P_K grow as 1/r^2 and cancel at each place. What the grid makes of them
// a few cells about the tip does not cancel, as it smooths a and grad v unlike, and the tip runs by steps of a
// particle. So of a tip that runs the integral is that of its core, a contour of its own within which P_K is left out:
// sum a_p (q - q_core) P_K. There v is that beyond the mean motion around the tip: where sums are exact J is the same
// but for what the core leaves out, and v^2/2 of a solid that flies or spins makes no errors as large as what opens the
// crack. Beside known fields that run with the tip it would: they move as r^(-1/2), and a spin omega would add rho
// speed omega r^1.5 of the band to K_II.
#pragma once
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "core/exec/space.hpp"
#include "core/fracture/branch_cut.hpp"
#include "core/fracture/j_domain.hpp"
#include "core/fracture/stress_intensity.hpp"
#include "core/math/tensor.hpp"
#include "core/state/state.hpp"

namespace riven {

struct BodyForces;

struct TipSums {
  Vec2 J;                           ///< J/m^2, of the band in which q falls
  Vec2 area;                        ///< J/m^2, of inertia and body forces
  Vec2 faces;                       ///< J/m^2, along the faces of cracks
  double tractions = 0;             ///< J/m^2, of tractions on the crack's own faces, along its heading
  double interaction[2] = {0, 0};   ///< m^0.5, interaction integral over K, with the fields of K_I = 1 and K_II = 1
  double filled[4] = {0, 0, 0, 0};  ///< share of each edge that lies in the solid
  double whole = std::numeric_limits<double>::infinity();  ///< m, length of the crack's faces behind the tip that no
                                                           ///< other crack cuts, if that is known to be short
  bool shut = false;                                       ///< faces next to the tip are pressed together
  bool crossed = false;                                    ///< another crack lies in the domain
  bool steep = false;       ///< energies along faces there are steeper than the grid resolves
  bool blind = false;       ///< faces there bear what the interaction integral does not see, or it cannot follow them
  std::vector<Vec2> bends;  ///< of its points where it is not, those that the contour should leave out
  bool pressed = false;     ///< there, as faces are pressed together next to them
};

/// Of particles around a tip: their mean velocity and how they turn about it.
struct MeanMotion {
  Vec2 at_tip;      ///< m/s
  double spin = 0;  ///< rad/s
  /// At offset r from the tip.
  RIVEN_INLINE Vec2 at(Vec2 r) const { return at_tip + spin * turned(r); }
};

/// A tip to sum around.
struct TipTask {
  JDomain domain;
  std::optional<JDomain> core;   ///< within the domain, where what inertia adds is left out
  std::optional<BranchCut> cut;  ///< of the known fields, where the crack is not in line with its tip
  WayFromTip way;                ///< of the crack out of the domain
  bool passes = false;           ///< the crack passes out of the domain, itself or along the one that it ends on
  int crack = 0;
  bool last = true;         ///< which end of the crack it is
  double grown = 0;         ///< m, length by which the crack has grown there
  Vec2 heading;             ///< unit vector out of the tip along the crack
  Vec2 turn{1, 0};          ///< cosine and sine of the angle by which the heading has turned since the crack was laid
  bool other_faces = true;  ///< asks for the faces of other cracks
  const PlaneElasticity* solid = nullptr;
  double thickness = 1;  ///< m, of the solid
  RunningTip running;
  MeanMotion drift;                       ///< of the particles around it, if v^2/2 counts
  const std::uint8_t* touched = nullptr;  ///< ContactSums::touched; none: faces that are close may press on each other
  bool inertia = false;                   ///< asks for what it adds to TipSums::area
  const BodyForces* forces = nullptr;     ///< none: there are none
  bool interaction = false;               ///< and for TipSums::interaction
  TipSums sums{};

  bool sums_area() const { return inertia || forces != nullptr; }
  /// Share of v^2 / 2 in J.
  double kinetic() const { return running.speed > 0 ? 1 : 0; }
  /// Half the difference of the off-diagonal parts of F R^T: by how much a place has turned more than the tip, by R.
  template <class Real>
  RIVEN_INLINE double rotation(const Mat2<Real>& F) const {
    return 0.5 * ((F.yx - F.xy) * turn.x - (F.xx + F.yy) * turn.y);
  }
  /// Signs of the known fields at offsets r from the tip.
  void find_signs(int count, const double* rx, const double* ry, double* sign) const {
    for (int k = 0; k < count; ++k) {
      const Vec2 r{rx[k], ry[k]};
      sign[k] = cut ? cut->sign({dot(r, heading), cross(heading, r)}) : 1;
    }
  }
  /// A vector of the first configuration that has turned by R with the tip.
  Vec2 turn_with_tip(Vec2 a) const { return {turn.x * a.x - turn.y * a.y, turn.y * a.x + turn.x * a.y}; }
  /// Displacement gradient F - R of what has turned by R with the tip.
  template <class Real>
  Mat2<double> gradient(const Mat2<Real>& F) const {
    return {F.xx - turn.x, F.xy + turn.y, F.yx - turn.y, F.yy - turn.x};
  }
};

/// What is asked about tips, by number, on any thread.
struct TipQuestions {
  std::function<TipTask(size_t tip)> place;        ///< what to sum
  std::function<bool(size_t tip, TipTask&)> take;  ///< takes the sums; true: `place` says what to sum once more
};

/// Sums around tips at these places, until all are done. Grid::q holds [vx vy ax ay].
template <class Real>
void sum_around_tips(const exec::Space&, const Plan&, const State<Real, 2>&, const std::vector<Vec2>& tips,
                     const TipQuestions&);

}  // namespace riven
