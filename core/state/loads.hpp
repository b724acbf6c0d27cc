// Forces on chosen particles.
#pragma once
#include <vector>

#include "core/exec/array.hpp"
#include "core/math/vec.hpp"
#include "core/scene/scene.hpp"

namespace riven {

/// One [[load]]: the particles it acts on, by stable id, and the share of the force (or area) that each carries.
struct LoadGroup {
  TimeFunction value[2];
  std::vector<int> id;
  std::vector<double> share;  ///< force: fraction; traction: area, m^2
};

struct Loads {
  std::vector<LoadGroup> groups;
  std::vector<int> position;     ///< [particles] index of each id, remade when the particles are sorted
  std::vector<Vec2> applied_at;  ///< where each loaded particle was when its force was applied, group after group
};

}  // namespace riven
