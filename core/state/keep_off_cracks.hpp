// Particles that lie on a crack at which their body, or their grip, ends.
#pragma once
#include <functional>
#include <unordered_map>
#include <vector>

#include "core/state/cracks.hpp"
#include "core/state/grid.hpp"

namespace riven {

/// Puts particles that lie on a crack, or nearer to it than a twentieth of a cell, that far to the side of their own
/// body, where that is on one side alone. Points of a lattice may lie on a sloping crack one by one: those of the body
/// below would belong to what is above, and where that is no body stand in the way of one that slides along.
class KeepOffCracks {
 public:
  /// Off the cracks as they lie at first.
  KeepOffCracks(const Cracks& cracks, const Lattice& lattice);

  /// Where to put a particle from x. `holds` tells whether a point lies in what the particle belongs to.
  Vec2 from(Vec2 x, const std::function<bool(Vec2)>& holds) const;

 private:
  int column(double x) const;
  int row(double y) const;
  long cell(int i, int j) const;

  const Cracks& cracks_;
  const Lattice& lattice_;
  std::unordered_map<long, std::vector<int>> segments_;  ///< that come near, by cell
};

}  // namespace riven
