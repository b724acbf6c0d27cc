// The gate: what steps cost now beside what they cost when the baseline was made.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "perf/cost.hpp"

namespace riven::perf {

/// A scene fails when it takes so much more than in the baseline, as a fraction. Instructions repeat to some parts in
/// ten thousand; calibrated times to a few per cent.
constexpr double instruction_limit = 0.03, time_limit = 0.15;
/// What riven-perf exits with when a scene fails.
constexpr int lost = 6;

/// What later runs are held against. Instructions depend on the compiler, calibrated times on the processor too, which
/// is why each processor has its own.
struct Baseline {
  std::string compiler;
  Costs instructions;
  std::map<std::string, Costs> times;  ///< by machine_name()
};

/// Throws Error (file) if it cannot be read, (bad input) if it is no baseline.
Baseline read_baseline(const std::filesystem::path& file);
/// Throws Error (file).
void write_baseline(const Baseline& baseline, const std::filesystem::path& file);

struct TaskChange {
  std::string label;
  double before = 0, now = 0;  ///< 0 where there is no such task
};

struct SceneChange {
  std::string scene;
  double before = 0, now = 0;
  std::vector<TaskChange> tasks;  ///< the one that lost most first
  double change() const { return now / before - 1; }
};

/// Scene by scene. Throws Error (bad input) if the two do not hold the same scenes: then the baseline is out of date.
std::vector<SceneChange> compare(const Costs& before, const Costs& now);

/// One line for each scene, and below it, where it fails, the tasks that lost. `unit`: of the costs.
std::string report(const std::vector<SceneChange>& changes, double limit, const std::string& unit);
bool passes(const std::vector<SceneChange>& changes, double limit);

}  // namespace riven::perf
