// J and K at the tips of cracks, when they are due (Nairn and Aimene, section 2.2.2; Guo and Nairn).
#pragma once
#include "kernels/bridge_tips.hpp"
#include "kernels/j_integral.hpp"

namespace riven {

template <class Real>
class SimulationOf;

/// What went otherwise than hoped so far, and where first.
struct FractureReport {
  long in_cell = 0;   ///< another tip was too near for a contour between the two
  long drawn_in = 0;  ///< the contour left the solid and was drawn in
  long unsound = 0;   ///< it leaves the solid however small
  long evaluations = 0;
  long crossed = 0;  ///< evaluations with another crack in the domain
  long bent = 0;     ///< a bend that is sharp, or has pressed faces next to it, was too near for what a contour that
                     ///< leaves it out finds to be right
  long mixed = 0;    ///< a tip grew to where its contour takes in another material or thickness
  long cut = 0;      ///< another crack crossed the tip's too near to it
  Vec2 place[6];
};

/// Evaluates J, K_I and K_II at the tips that are due: all of them when a row of the history is, and those whose growth
/// is about to be checked. Runs between the momentum update and the move, when Grid::q holds [vx vy ax ay].
template <class Real>
void find_j_and_k(SimulationOf<Real>&);

}  // namespace riven
