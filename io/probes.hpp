// Named results: what a scene's probes read from the state.
#pragma once
#include <vector>

#include "io/history.hpp"
#include "kernels/simulation.hpp"

namespace riven {

class Probes {
 public:
  /// Finds each probe's particle, crack or grip in the first state.
  template <class Real>
  explicit Probes(const SimulationOf<Real>& simulation);

  std::vector<HistoryColumn> columns() const;
  /// One value per probe, in the scene's order.
  template <class Real>
  std::vector<double> read(const SimulationOf<Real>& simulation) const;

 private:
  const Scene& scene_;
  std::vector<int> target_;  ///< particle id, crack number or owner of a constraint
};

}  // namespace riven
