// Counting and finding the bits of a word.
#pragma once
#include <bit>

#include "core/exec/config.hpp"

namespace riven::exec {

inline namespace RIVEN_SIDE {

/// Bits that are set.
RIVEN_INLINE int bits_of(unsigned word) {
#if defined(__CUDA_ARCH__)
  return __popc(word);
#else
  return std::popcount(word);
#endif
}

/// Number of the lowest bit that is set; there must be one.
RIVEN_INLINE int lowest_bit(unsigned word) {
#if defined(__CUDA_ARCH__)
  return __ffs(static_cast<int>(word)) - 1;
#else
  return std::countr_zero(word);
#endif
}

}  // namespace RIVEN_SIDE

}  // namespace riven::exec
