// The velocities on which stress works, by how stress is updated.
#pragma once
#include "core/scene/scene.hpp"

namespace riven {

/// Shares of a step in which the velocities before and after the momentum update strain the solid. Where stress is
/// updated last those after it come from the same momenta as those before.
struct StrainShares {
  double by_first, by_last;
};

inline StrainShares strain_shares(StressUpdate update) {
  switch (update) {
    case StressUpdate::usavg: return {0.5, 0.5};
    case StressUpdate::musl: return {0, 1};
    case StressUpdate::usf:
    case StressUpdate::usl: break;
  }
  return {1, 0};
}

}  // namespace riven
