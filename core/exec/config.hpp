// What the compilers need to be told, in one place.
#pragma once
#include <cstdint>

// The side that a translation unit is compiled for. Where there is a device, kernels are compiled twice: as they are,
// and for the device, with what differs there (RIVEN_ON_DEVICE). What the two do not share lies in the inline namespace
// of its side: RIVEN_SIDE. Data and laws are the same on both.
#if defined(RIVEN_ON_DEVICE)
#define RIVEN_SIDE on_device
#else
#define RIVEN_SIDE on_host
#endif

#if defined(__CUDACC__)
#define RIVEN_FN __host__ __device__
#define RIVEN_INLINE __host__ __device__ __forceinline__
#define RIVEN_LANE
#define RIVEN_KERNEL __device__
#define RIVEN_OUTLINE __host__ __device__ inline
#else
#define RIVEN_FN
#define RIVEN_INLINE __attribute__((always_inline)) inline
#define RIVEN_LANE __attribute__((always_inline))       // bodies of for_lanes: without it they are called lane by lane
#define RIVEN_KERNEL                                    // what is launched, and what works with a team
#define RIVEN_OUTLINE __attribute__((noinline)) inline  // rare paths, kept out of the loops that matter
#endif

// Compiled once, however many callers there are.
#if defined(__GNUC__) && !defined(__clang__)
#define RIVEN_ONCE __attribute__((noinline, noclone))
#else
#define RIVEN_ONCE __attribute__((noinline))
#endif

// INSTANTIATE(Real) for each precision that is compiled. Float is half of what there is to compile: a build that is
// only counted leaves it out.
#if RIVEN_FLOAT
#define RIVEN_EACH_REAL(INSTANTIATE) INSTANTIATE(double) INSTANTIATE(float)
#else
#define RIVEN_EACH_REAL(INSTANTIATE) INSTANTIATE(double)
#endif

#define RIVEN_PRAGMA(x) _Pragma(#x)

namespace riven::exec {

/// Particles that are taken together on the CPU, and of whom lists say together what they have in common.
inline constexpr int block = 16;

inline namespace RIVEN_SIDE {

/// Asks for data at p, needed soon. Functions that only ask are to be RIVEN_INLINE, or GCC drops the calls to them.
RIVEN_INLINE void prefetch([[maybe_unused]] const void* p) {
#if !defined(__CUDA_ARCH__)
  __builtin_prefetch(p);
#endif
}

/// The same for data that is needed later, after the nearest cache may have had to make room for others.
RIVEN_INLINE void prefetch_far([[maybe_unused]] const void* p) {
#if !defined(__CUDA_ARCH__)
  __builtin_prefetch(p, 0, 2);
#endif
}

/// Particles taken together by one trip through a kernel's body. On the CPU the compiler turns the
/// trips into vector instructions; a GPU thread takes one particle.
#if defined(RIVEN_ON_DEVICE)
inline constexpr int lanes = 1;
#else
inline constexpr int lanes = block;
#endif

/// Alignment of what holds one number for each lane.
inline constexpr int line = lanes > 1 ? 64 : alignof(double);

/// body(k) for k in [0, count), vectorised; a full block as a loop whose length the compiler knows.
/// The body must be free of branches that the compiler cannot turn into blends.
template <class Body>
RIVEN_INLINE void for_lanes(int count, Body&& body) {
  if (count == lanes) {  // NOLINT(bugprone-branch-clone): the loops differ in what is known of their length
#if !defined(__CUDACC__)
#pragma omp simd
#endif
    for (int k = 0; k < lanes; ++k)
      body(k);
  } else {
#if !defined(__CUDACC__)
#pragma omp simd
#endif
    for (int k = 0; k < count; ++k)
      body(k);
  }
}

}  // namespace RIVEN_SIDE

}  // namespace riven::exec
