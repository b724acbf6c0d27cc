// Forces on chosen particles.
#pragma once
#include <vector>

#include "core/exec/array.hpp"
#include "core/math/vec.hpp"
#include "core/scene/scene.hpp"

namespace riven {

/// The edge of a particle that a traction acts on: its outward normal along each axis, or none of a load that acts on
/// the particle as a whole.
struct Outward {
  signed char along[2] = {0, 0};  ///< -1, 0 or 1
  RIVEN_INLINE bool any() const { return along[0] != 0 || along[1] != 0; }
};

/// One [[load]]: the particles it acts on, by stable id, and the share of the force (or area, or mass) that each
/// carries.
struct LoadGroup {
  Field value[2];
  Outward out;
  std::vector<int> id;
  std::vector<double> share;  ///< force: fraction; traction: area, m^2; acceleration: mass, kg
  Places first;               ///< where they start; empty where the load is the same everywhere
};

struct Loads {
  std::vector<LoadGroup> groups;
  exec::Array<int> loaded;       ///< ids of the loaded particles, group after group
  exec::Array<Outward> out;      ///< [loaded] where on them it acts
  exec::Array<int> position;     ///< [particles] index of each id, remade when the particles are sorted
  exec::Array<Vec2> force;       ///< [loaded] N, in this step
  exec::Array<Vec2> from;        ///< [loaded] where the particle was when it was applied
  exec::Array<Vec2> applied_at;  ///< [loaded] where it was applied
};

}  // namespace riven
