// Gaps between a crack and the solids beside it, as they lie at first: a platen that starts above a block, a round
// punch that touches it at one point. Where contact is found by displacement, faces are as far apart as they were at
// first and have moved since, so that they meet where the solids do and not where the crack is drawn.
#pragma once
#include <vector>

#include "core/scene/scene.hpp"
#include "core/state/cracks.hpp"

namespace riven {

/// From each point of a crack whose faces may meet to the solids above (x) and below (y) it, m, along the normal of the
/// crack; infinite where there is none. Empty in a scene of one body if no crack has a gap.
exec::Array<Vec2> first_gaps(const Scene& scene, const Cracks& cracks);

/// Has any crack a gap between solids, and contact is found by displacement?
bool starts_apart(const Scene& scene);

/// Where particles would lie if their solids touched the cracks, Cracks::gap between them closed.
class ClosedGaps {
 public:
  ClosedGaps(const Cracks& cracks, double cell);

  /// Of a particle that lies at x at first. It is moved where it is near the face of a crack with a gap, by that along
  /// the normal; in a corner of two faces by both gaps, and by none where a face without a gap is nearer.
  Vec2 place(Vec2 x) const;

 private:
  struct Face;
  /// Gives points of a crack without solids on both sides, as beyond the edge of a body, the gap of the nearest with.
  void carry_gaps(int first, int last);
  Face face(int crack, Vec2 x) const;

  const Cracks& cracks_;
  double cell_;
  exec::Array<Vec2> gap_;         ///< [points]
  std::vector<Rectangle> boxes_;  ///< [cracks] around what a crack concerns
  std::vector<int> open_, shut_;  ///< cracks with gaps, and without
};

}  // namespace riven
