// Runs a scene from its first step to its last: frames, history, summary, progress.
#pragma once
#include <filesystem>

#include "io/summary.hpp"
#include "kernels/simulation.hpp"

namespace riven {

struct RunOptions {
  std::filesystem::path folder;
  bool quiet = false;
};

/// Writes the results of `simulation` into the folder. A run that goes wrong ends with status "unstable" and what was
/// computed so far on disk, its last state as the last frame; the Error is then thrown on. Throws Error (file) when
/// results cannot be written.
template <class Real>
Summary run_scene(SimulationOf<Real>& simulation, const RunOptions& options);

/// The summary of a simulation as it stands.
template <class Real>
Summary summarize(const SimulationOf<Real>& simulation, double wall_seconds);

}  // namespace riven
