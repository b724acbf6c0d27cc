// Does the runs of a study that are not done yet.
#pragma once
#include <functional>
#include <vector>

#include "io/study/store.hpp"

namespace riven::study {

/// How far the study has come, after each run.
struct Advance {
  const Run* run = nullptr;        ///< that has ended now
  const Record* record = nullptr;  ///< of it
  size_t done = 0, all = 0;        ///< runs, repeats included
  double seconds_left = 0;         ///< about
};

/// Runs `scene` with the settings of each run, as processes of their own, the small ones first; what the store has is
/// not done again. With times taken, one at a time, and those that are shorter than Study::repeat_under again in later
/// rounds, so that a disturbance meets all of them; else as many side by side as there are free cores. A run that fails
/// is recorded as that. `report` is called after each. Throws Error (file) when results cannot be written, and
/// Error (interrupted) when the program is asked to stop, once its runs have; what was recorded stays.
std::vector<Record> run_members(const Study& study, const std::string& scene, const std::vector<Run>& runs,
                                const Store& store, const std::function<void(const Advance&)>& report);

}  // namespace riven::study
