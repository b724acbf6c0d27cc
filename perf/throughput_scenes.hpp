// The scenes that riven-perf throughput runs: a block without cracks, and plates with cracks beside the same plates
// without them. All of them move from the first step on, so that nothing is measured at rest.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace riven::perf {

/// One scene of a group, and what it is read against.
struct Entrant {
  std::string name;
  Scene scene;
  std::function<Vec2(Vec2)> velocity;  ///< first velocity (m/s) at a place (m), written over the scene's
  std::string without_cracks;          ///< entrant of the group that is the same scene without its cracks; empty: none
};

/// Entrants that take turns, and how long a turn is.
struct Group {
  std::string name, title;
  int warm_up;  ///< steps before the first turn
  int steps;    ///< of a turn
  int turns;
  std::function<std::vector<Entrant>()> entrants;  ///< makes the scenes; throws Error
};

/// block, large, methods, sent, many.
std::vector<Group> throughput_groups();

}  // namespace riven::perf
