// The scenes that the gate watches: together they run every kernel of the step.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "perf/scenes.hpp"

namespace riven::perf {

struct GateScene {
  Entrant counted;  ///< small, for callgrind, which is some fifty times slower
  Entrant timed;    ///< the same at the size of the benchmarks
  int warm_up;      ///< steps before either
  int steps;        ///< of a turn when times are taken; several where they differ
};

/// Deterministic, on one thread. Throws Error (file) if a shipped scene that some are made from cannot be read.
std::vector<GateScene> gate_scenes();

}  // namespace riven::perf
