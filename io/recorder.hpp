// Rows of the history of a run: the quantities of every run, then the grips, the tips of cracks, and the scene's
// probes.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "io/history.hpp"
#include "io/probes.hpp"
#include "io/summary.hpp"
#include "kernels/simulation.hpp"

namespace riven {

template <class Real>
class Recorder {
 public:
  /// Begins history.csv in the folder. `probes`: those of the simulation's first state. `rows`: what a run that is
  /// taken up again has written before. Throws Error (file).
  Recorder(const std::filesystem::path& folder, const SimulationOf<Real>& simulation, const Probes& probes,
           const std::string& rows);

  void row();
  /// All rows so far.
  std::string rows() const { return history_.rows(); }
  std::vector<Summary::Value> probes() const;

 private:
  std::vector<HistoryColumn> columns() const;

  const SimulationOf<Real>& m_;
  const Probes& probes_;
  History history_;
};

}  // namespace riven
