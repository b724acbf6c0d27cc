// When rows of the history are due.
#pragma once
#include <cmath>

#include "core/scene/scene.hpp"

namespace riven {

/// Time between two rows, s.
inline double row_interval(const Scene& scene) {
  return scene.output.history_every > 0 ? scene.output.history_every : scene.end_time / 250;
}

/// Is a row due at the end of a step that goes from one time to the other?
inline bool report_due(const Scene& scene, double from, double to) {
  constexpr double rounding = 1 + 1e-12;
  const double every = row_interval(scene);
  return to * rounding >= scene.end_time || std::floor(to * rounding / every) > std::floor(from * rounding / every);
}

}  // namespace riven
