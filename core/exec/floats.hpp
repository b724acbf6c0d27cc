// Several numbers in single precision side by side: written out where compilers do not turn a loop into vectors by
// themselves. On a device one, as every thread has its own.
#pragma once
#include "core/exec/config.hpp"

namespace riven::exec {

inline namespace RIVEN_SIDE {

#if defined(RIVEN_ON_DEVICE)

using Floats = float;
using Masks = int;
inline constexpr int float_lanes = 1;

RIVEN_INLINE void put_lane(Floats& all, int, float value) {
  all = value;
}
RIVEN_INLINE int lane(const Masks& all, int) {
  return all;
}
RIVEN_INLINE float lane(const Floats& all, int) {
  return all;
}
/// `bits` in the lanes where the mask is not set, 0 in the others.
RIVEN_INLINE Masks unless(Masks mask, int bits) {
  return mask ? 0 : bits;
}

#else

typedef float Floats __attribute__((vector_size(32)));
typedef int Masks __attribute__((vector_size(32)));
inline constexpr int float_lanes = 8;

RIVEN_INLINE void put_lane(Floats& all, int k, float value) {
  all[k] = value;
}
RIVEN_INLINE int lane(const Masks& all, int k) {
  return all[k];
}
RIVEN_INLINE float lane(const Floats& all, int k) {
  return all[k];
}
RIVEN_INLINE Masks unless(Masks mask, int bits) {
  return ~mask & bits;
}

#endif

}  // namespace RIVEN_SIDE

}  // namespace riven::exec
