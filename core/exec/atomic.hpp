// Relaxed atomic additions for scatters and counters.
#pragma once
#include <atomic>

#include "core/exec/config.hpp"

namespace riven::exec {

/// target += value, indivisibly; returns the value before.
template <class T>
RIVEN_INLINE T atomic_add(T& target, T value) {
#if defined(__CUDA_ARCH__)
  return atomicAdd(&target, value);
#else
  return std::atomic_ref<T>(target).fetch_add(value, std::memory_order_relaxed);
#endif
}

}  // namespace riven::exec
