// What the arrays of a scene will take, before any of them is there.
#pragma once
#include "core/plan/plan.hpp"

namespace riven {

struct MemoryNeed {
  double particles = 0, nodes = 0;  ///< about so many
  double bytes = 0;                 ///< of arrays whose size goes with these
  double working = 0;               ///< bytes, besides, while particles are sorted and results written
  double peak() const { return bytes + working; }
};

/// At the first step; extra fields of nodes and what is known of crossings come on top where cracks are.
MemoryNeed predict_memory(const Scene& scene, const Plan& plan);

}  // namespace riven
