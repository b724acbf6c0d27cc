// Why an effect is in the plan, or why it is not.
#pragma once
#include <string>
#include <vector>

#include "core/plan/plan.hpp"

namespace riven {

struct EffectNote {
  std::string name;  ///< as tasks and settings call it
  bool on = false;
  std::string why;
};

/// Every effect there is, those that are on first.
std::vector<EffectNote> explain(const Scene& scene, const Plan& plan);

}  // namespace riven
