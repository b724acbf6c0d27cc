// The checkpoints of a folder of results: the newest, checkpoint.h5, and the one before, checkpoint.previous.h5.
#pragma once
#include <filesystem>
#include <string>

#include "io/checkpoint.hpp"

namespace riven {

/// The checkpoint to go on from: the file itself, or of a folder the newest that can be read; when that is not the
/// newest there is, a warning goes to standard error. Throws Error (file).
CheckpointFile find_checkpoint(const std::filesystem::path& file_or_folder);

/// Throws Error (file) if the folder holds an unfinished run that can go on, or results of a scene of another name: a
/// run that begins there removes them.
void refuse_to_remove_results(const std::filesystem::path& folder, const std::string& scene);

class CheckpointStore {
 public:
  /// A run that begins anew removes those of an older run; one that goes on from one of the folder keeps them.
  CheckpointStore(std::filesystem::path folder, const Output& when, const CheckpointFile* from);

  /// Is one due after this step?
  bool due(long step) const;
  /// Is the newest one of this run?
  bool has_newest() const { return newest_is_good_; }
  /// Throws Error (file); what was there before is then still there.
  template <class Real>
  void write(const SimulationOf<Real>& simulation, const RunSoFar& so_far);

 private:
  void keep_newest() const;

  std::filesystem::path folder_;
  double every_;  ///< s
  long steps_;
  bool newest_is_good_;  ///< it may take the place of the one before
  double last_;          ///< s, on the clock of stop watches
};

}  // namespace riven
