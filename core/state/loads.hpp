// Forces on chosen particles.
#pragma once
#include <vector>

#include "core/exec/array.hpp"
#include "core/math/vec.hpp"
#include "core/scene/scene.hpp"

namespace riven {

/// One [[load]]: the particles it acts on, by stable id, and the share of the force (or area, or mass) that each
/// carries.
struct LoadGroup {
  Field value[2];
  std::vector<int> id;
  std::vector<double> share;  ///< force: fraction; traction: area, m^2; acceleration: mass, kg
  Places first;               ///< where they start; empty where the load is the same everywhere
};

struct Loads {
  std::vector<LoadGroup> groups;
  exec::Array<int> loaded;       ///< ids of the loaded particles, group after group
  exec::Array<int> position;     ///< [particles] index of each id, remade when the particles are sorted
  exec::Array<Vec2> force;       ///< [loaded] N, in this step
  exec::Array<Vec2> applied_at;  ///< [loaded] where each of them was when it was applied
};

}  // namespace riven
