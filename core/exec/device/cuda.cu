#include <new>
#include <string>

#include "core/exec/device.hpp"
#include "core/exec/device/check_cuda.hpp"

namespace riven::exec::device {

Found find() {
  int count = 0;
  if (const cudaError_t result = cudaGetDeviceCount(&count); result != cudaSuccess || count == 0)
    return {false,
            std::string("no CUDA device: ") + (result == cudaSuccess ? "none is there" : cudaGetErrorString(result))};
  // what is given back stays at hand: kernels ask for small memory in every step
  cudaMemPool_t pool;
  check(cudaDeviceGetDefaultMemPool(&pool, 0), "look for its memory");
  unsigned long long all = ~0ull;
  check(cudaMemPoolSetAttribute(pool, cudaMemPoolAttrReleaseThreshold, &all), "keep memory");
  cudaDeviceProp properties;
  check(cudaGetDeviceProperties(&properties, 0), "look for a device");
  return {true, properties.name};
}

void* allocate(size_t bytes) {
  void* there = nullptr;
  check(cudaMallocAsync(&there, bytes, nullptr), "allocate");
  return there;
}

void release(void* there) noexcept {
  if (there)
    cudaFreeAsync(there, nullptr);  // once what was launched before is done; if that fails, the next launch says so
}

void to_device(void* there, const void* here, size_t bytes) {
  check(cudaMemcpy(there, here, bytes, cudaMemcpyHostToDevice), "copy to the device");
}

void to_host(void* here, const void* there, size_t bytes) {
  check(cudaMemcpy(here, there, bytes, cudaMemcpyDeviceToHost), "copy from the device");
}

void zero(void* there, size_t bytes) {
  if (bytes)
    check(cudaMemsetAsync(there, 0, bytes), "zero");
}

void wait() {
  check(cudaDeviceSynchronize(), "wait");
}

}  // namespace riven::exec::device
