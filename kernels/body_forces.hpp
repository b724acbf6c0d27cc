// Body forces around tips: what acts on the mass of the solid from outside in this step. In J they count as inertia
// does, with the other sign (j_integral.hpp).
#pragma once
#include <algorithm>
#include <utility>
#include <vector>

#include "core/math/vec.hpp"

namespace riven {

template <class Real>
class SimulationOf;

struct BodyForces {
  Vec2 everywhere;                         ///< m/s^2
  std::vector<std::pair<int, Vec2>> some;  ///< particles that bear loads, ascending, and these, m/s^2
  std::vector<bool> loaded;                ///< [tips] some are near; empty where none bear loads

  bool act_at(size_t tip) const { return everywhere.x != 0 || everywhere.y != 0 || (!loaded.empty() && loaded[tip]); }
  Vec2 on(int particle) const {
    Vec2 sum = everywhere;
    const auto before = [](const std::pair<int, Vec2>& a, int b) { return a.first < b; };
    for (auto at = std::lower_bound(some.begin(), some.end(), particle, before);
         at != some.end() && at->first == particle; ++at)
      sum += at->second;
    return sum;
  }
};

/// Those of particles that are less than `reach` (m) from one of the tips along either axis.
template <class Real>
BodyForces body_forces_near(const SimulationOf<Real>& m, const std::vector<Vec2>& tips, double reach);

}  // namespace riven
