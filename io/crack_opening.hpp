// How far a crack is open, point by point.
#pragma once
#include <vector>

#include "core/scene/scene.hpp"
#include "core/state/cracks.hpp"

namespace riven {

/// All in m. The normal part is positive where the faces are apart, by a gap at first or because the upper surface has
/// moved away from the lower one, along the left-hand normal of the crack plane; sliding is along the direction from
/// the crack's first point to its last.
struct CrackOpening {
  Vec2 vector;  ///< by which the upper surface has moved from the lower one
  double normal = 0, sliding = 0;
};

/// One entry per point of all cracks, in their order.
std::vector<CrackOpening> crack_openings(const Cracks& cracks);

/// Normal opening of one crack where its magnitude is largest, m; negative where the faces overlap. Of points with
/// solid beside them: others move with what is nearest.
double extreme_opening(const Scene& scene, const Cracks& cracks, int crack);

}  // namespace riven
