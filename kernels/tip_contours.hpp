// The contours on which J of tips is found: where they go, and how they are drawn in when their sums are known (Nairn
// and Aimene, section 2.2.2, step 6 with notes 1 and 2).
//
// A contour leaves out the tips of other cracks, and bends of its own crack that are sharp or where faces are pressed
// together, and its edges lie in the solid. Of the latter two its sums tell; it is then placed anew.
#pragma once
#include <optional>
#include <vector>

#include "core/fracture/tip_places.hpp"
#include "core/scene/scene.hpp"
#include "core/state/state.hpp"
#include "kernels/j_integral.hpp"

namespace riven {

template <class Real>
class SimulationOf;

/// Cells, the contour that says what drives a tip where the interaction integral of a larger one does not hold: it is
/// crossed or bent, or the tip runs, whose steady fields are about it no farther than waves went while it ran steadily.
inline constexpr double near_contour = 4;

inline Vec2 position_of(const Cracks& cracks, const Tip& tip) {
  return cracks.plane[cracks.end_point(tip.crack, tip.last)];
}

/// One tip on its way to J.
struct DueTip {
  Tip* tip;
  double most[4];                      ///< m, the contour as asked for, or as drawn in
  const BodyForces* forces = nullptr;  ///< none: none act around it
  std::vector<Vec2> bends{};           ///< that the contour is to leave out
  bool adapted = false;                ///< it leaves out another tip, or a bend
  bool in_cell = false;                ///< a tip is too near for that
  bool bend_in_cell = false;           ///< or a bend
  bool pressed_bend = false;           ///< or one with pressed faces, for J and K to be resolved
  double acting = 1;                   ///< tips that it takes for this one: itself, and those too near that run its way
  bool drawn_in[4] = {};               ///< edges that have been, and have not been found in the solid since
  bool settled = false;                ///< all of its edges lie in the solid
  bool to_draw_in = false;             ///< some do not, and have room to be drawn in
  bool to_leave_bends = false;         ///< bends have become known
  bool near = false;                   ///< J is known, and this contour is to say what drives the tip
  bool to_near = false;                ///< the next one is to
};

template <class Real>
class TipContours {
 public:
  /// `tips`: State::tips, or a copy of them.
  TipContours(const SimulationOf<Real>& m, const FractureRules& rules, const std::vector<Tip>& tips);

  /// What to sum for a tip, on the contour that it is at.
  TipTask place(DueTip& d) const;
  /// Is the contour where it may be, now that its sums are known, or what is to be done?
  void review(DueTip& d, const TipTask& task) const;

  /// Of all the tips.
  const TipPlaces& places() const { return places_; }

 private:
  void draw_in(DueTip& d, const TipTask& task) const;
  bool counts_inertia(const DueTip& d, const TipTask& task) const;
  bool speeds_up(const Tip& tip, const TipTask& task) const;
  std::vector<Vec2> other_tips(const Tip& tip) const;
  void leave_out_bends(DueTip& d, Vec2 tip, std::vector<Vec2>& left_out) const;
  double acting_within(const Tip& tip, const JDomain& domain) const;
  std::optional<double> opening_within(const TipTask& task, const Tip& tip, int edge) const;

  const SimulationOf<Real>& m_;
  const State<Real, 2>& s_;
  const FractureRules& rules_;
  const std::vector<Tip>& tips_;
  std::vector<PlaneElasticity> solids_;
  TipPlaces places_;
};

}  // namespace riven
