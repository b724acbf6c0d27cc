// Relaxed atomic additions for scatters and counters, and marks that several may set.
#pragma once
#include <atomic>
#include <type_traits>

#include "core/exec/config.hpp"

namespace riven::exec {

/// target += value, indivisibly; returns the value before.
template <class T>
RIVEN_INLINE T atomic_add(T& target, T value) {
#if defined(__CUDA_ARCH__)
  if constexpr (std::is_integral_v<T> && sizeof(T) == 8) {  // CUDA adds eight-byte integers unsigned: same bits
    using Word = unsigned long long;
    return static_cast<T>(atomicAdd(reinterpret_cast<Word*>(&target), static_cast<Word>(value)));
  } else {
    return atomicAdd(&target, value);
  }
#else
  return std::atomic_ref<T>(target).fetch_add(value, std::memory_order_relaxed);
#endif
}

/// target = value, where others may set it to the same.
template <class T>
RIVEN_INLINE void atomic_set(T& target, T value) {
#if defined(__CUDA_ARCH__)
  *const_cast<volatile T*>(&target) = value;
#else
  std::atomic_ref<T>(target).store(value, std::memory_order_relaxed);
#endif
}

}  // namespace riven::exec
