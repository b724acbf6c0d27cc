// study.csv and study.json: a study for people's tables, for pictures and for programs.
#pragma once
#include <filesystem>

#include "io/study/assess.hpp"

namespace riven::study {

/// Errors for which the cheapest setting is told.
inline constexpr double tolerances[] = {0.10, 0.05, 0.02, 0.01};

/// What leaving an effect out does.
struct LeftOutReport {
  std::string name;
  double cost = 0;              ///< share of the run's wall time that goes with it
  std::vector<double> changes;  ///< [results] relative change of the answer; NaN where the run fails without it
};
std::vector<LeftOutReport> report_left_out(const Study&, const Members&, const std::vector<Record>&, const Assessment&);

/// Throws Error (file) where the folder holds what another study has found: one of another name, or of another scene.
void refuse_to_remove_study(const std::filesystem::path& folder, const Study&);

/// Both files appear whole or not at all. Throws Error (file).
void write_study(const std::filesystem::path& folder, const Study&, const Members&, const std::vector<Record>&,
                 const Assessment&);

}  // namespace riven::study
