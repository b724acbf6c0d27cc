// The least time that a machine can need for some arithmetic and some traffic with its memory.
#pragma once
#include <algorithm>

#include "perf/machine.hpp"

namespace riven::perf {

struct Bounds {
  double arithmetic = 0, memory = 0;  ///< s
  double least_time() const { return std::max(arithmetic, memory); }
  bool by_memory() const { return memory > arithmetic; }
};

/// `bytes` counted as the triad's are: lines fetched only to be written over are left out.
inline Bounds bounds_of(double flops, double bytes, const MachineRates& rates) {
  return {flops / rates.fma, bytes / rates.triad};
}

}  // namespace riven::perf
