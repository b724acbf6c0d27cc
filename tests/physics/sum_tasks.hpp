// Sums around tips on contours that a test has chosen.
#pragma once
#include <vector>

#include "kernels/j_integral.hpp"
#include "kernels/simulation.hpp"

namespace riven::test {

template <class Real>
void sum_tasks(const exec::Space& space, const SimulationOf<Real>& m, std::vector<TipTask>& tasks) {
  std::vector<Vec2> tips;
  for (const TipTask& task : tasks)
    tips.push_back(task.domain.tip);
  sum_around_tips(space, m.plan, m.state, tips,
                  {[&](size_t k) { return tasks[k]; },
                   [&](size_t k, TipTask& summed) {
                     tasks[k] = summed;
                     return false;
                   }});
}

}  // namespace riven::test
