// Launches on a CUDA device.
#pragma once
#include <cstddef>

#include "core/exec/config.hpp"
#include "core/exec/device/check_cuda.hpp"

namespace riven::exec {

inline namespace RIVEN_SIDE {

/// The threads of one team (a block of CUDA's) as one of them sees it.
class Team {
 public:
  explicit __device__ Team(void* shared) : shared_(shared) {}

  /// f(i) for i in [0, n), shared out to the threads; then all wait for each other.
  template <class F>
  __device__ void each(long n, const F& f) const {
    for (long i = threadIdx.x; i < n; i += blockDim.x)
      f(i);
    __syncthreads();
  }
  /// f(t) by each thread, with its number; then all wait for each other.
  template <class F>
  __device__ void each_thread(const F& f) const {
    f(static_cast<int>(threadIdx.x));
    __syncthreads();
  }
  __device__ int threads() const { return static_cast<int>(blockDim.x); }
  /// The memory that they share, of any value at first.
  template <class T>
  __device__ T* shared() const {
    return static_cast<T*>(shared_);
  }

 private:
  void* shared_;
};

namespace detail {

template <class F>
__global__ void run_each(long n, const F f) {
  for (long i = blockIdx.x * static_cast<long>(blockDim.x) + threadIdx.x; i < n;
       i += gridDim.x * static_cast<long>(blockDim.x))
    f(i);
}

template <class F>
__global__ void run_teams(long n, const F f) {
  extern __shared__ double memory[];
  for (long t = blockIdx.x; t < n; t += gridDim.x)
    f(Team(memory), t);
}

/// Blocks that a launch has at most; each goes on to more of the work.
inline constexpr long most_blocks = 1L << 30;

template <class F>
void launch_each(long n, const F& f) {
  constexpr long threads = 256;
  const long blocks = (n + threads - 1) / threads;
  run_each<<<static_cast<unsigned>(blocks < most_blocks ? blocks : most_blocks), threads>>>(n, f);
  device::check(cudaGetLastError(), "launch");
}

template <class F>
void launch_teams(long n, int threads, size_t shared, const F& f) {
  if (shared > 48u << 10)  // what every device gives unasked
    device::check(
        cudaFuncSetAttribute(run_teams<F>, cudaFuncAttributeMaxDynamicSharedMemorySize, static_cast<int>(shared)),
        "shared memory");
  run_teams<<<static_cast<unsigned>(n < most_blocks ? n : most_blocks), threads, shared>>>(n, f);
  device::check(cudaGetLastError(), "launch of teams");
}

}  // namespace detail

}  // namespace RIVEN_SIDE

}  // namespace riven::exec
