// Every call of CUDA's is checked.
#pragma once
#include <cuda_runtime.h>

#include "core/error.hpp"

namespace riven::exec::device {

/// Throws Error (internal), or std::bad_alloc, with what was being done.
inline void check(cudaError_t result, const char* what) {
  if (result == cudaSuccess)
    return;
  if (result == cudaErrorMemoryAllocation)
    throw std::bad_alloc();
  fail({Exit::internal, std::string("the device failed: ") + cudaGetErrorString(result), what, {}, {}, {}});
}

}  // namespace riven::exec::device
