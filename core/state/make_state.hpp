// From a scene to its first state: particles laid out, grid and tables made, arrays allocated as the plan asks.
#pragma once
#include "core/state/state.hpp"

namespace riven {

/// Throws Error (bad input) for bodies without particles.
template <class Real>
void make_state(const Scene&, const Plan&, State<Real, 2>&);

/// One array of the state, for `riven plan`.
struct ArrayReport {
  std::string name;
  long items = 0;
  long bytes = 0;
};
template <class Real>
std::vector<ArrayReport> list_arrays(const State<Real, 2>&);

/// Gives every slot array the size that the nodes and the extra slots of cracks need.
template <class Real>
void size_grid(const Plan&, State<Real, 2>&);

}  // namespace riven
