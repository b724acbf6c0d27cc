// Checkpoints: a run, frozen between two steps, in one file that needs no other. HDF5 behind a header (see
// checkpoint_header.hpp):
//   /scene      text of the scene and what stands in the files that it names
//   /run        rows of history.csv, times of the frames, wall time, retries
//   /state      the members of the simulation (kernels/each_member.hpp); structs as rows of numbers, whose names are in
//               the attribute `columns`
// A run that is taken up again goes on to the last bit as it would have without.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/hdf_file.hpp"
#include "io/retry.hpp"
#include "kernels/simulation.hpp"

namespace riven {

/// What a run has done so far, beside its state.
struct RunSoFar {
  double wall_seconds = 0;
  std::vector<double> frames;  ///< s, times of the frames that are written
  double frame_interval = 0;   ///< s
  long frames_due = 1;         ///< the next frame is due at so many intervals
  std::string history;         ///< rows of history.csv
  std::vector<Retry> retries{};
};

/// Writes a file that appears whole or not at all; `before` is called just before it does. Does not change the
/// simulation. Throws Error (file).
template <class Real>
void write_checkpoint(const std::filesystem::path& path, const SimulationOf<Real>& simulation, const RunSoFar& so_far,
                      const std::function<void()>& before = {});

class CheckpointFile {
 public:
  /// Throws Error (file) when it cannot be read, is damaged or of another format.
  explicit CheckpointFile(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return file_.path(); }
  /// The scene that runs, before checks; `overrides` come on top of those that it ran with.
  Scene scene(const std::vector<std::string>& overrides = {}) const;
  /// Gives a simulation, as made from its scene, the state in the file. Throws Error (file) when they do not fit.
  template <class Real>
  RunSoFar restore(SimulationOf<Real>& simulation) const;

 private:
  std::string text(const std::string& dataset) const;

  HdfFile file_;
};

}  // namespace riven
