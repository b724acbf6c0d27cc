// Runs a scene from its first step, or a checkpoint, to its last: frames, history, summary, progress.
#pragma once
#include <filesystem>
#include <limits>

#include "io/checkpoint.hpp"
#include "io/summary.hpp"
#include "kernels/simulation.hpp"

namespace riven {

struct RunOptions {
  std::filesystem::path folder;
  bool quiet = false;
  double wall_limit = std::numeric_limits<double>::infinity();  ///< s after which the run is interrupted
  const CheckpointFile* restart = nullptr;                      ///< go on from here
};

/// Writes the results of `simulation`, as made from its scene, into the folder. A run that goes wrong goes
/// back to its last checkpoint as often as Limits::retries allows, and after that ends with status "unstable" and what
/// was computed so far on disk, its last state as the last frame; the Error is then thrown on. On SIGINT, SIGTERM or
/// the wall limit it ends after the step with a checkpoint, a last frame, status "interrupted" and Error (interrupted).
/// Throws Error (file) when results cannot be written, or another run writes into the folder.
template <class Real>
Summary run_scene(SimulationOf<Real>& simulation, const RunOptions& options);

}  // namespace riven
