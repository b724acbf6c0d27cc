#include <new>
#include <string>
#include <vector>

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

namespace {

/// As gather, in words: `per` of them are an item.
template <class Word>
__global__ void pack(Word* to, const Word* from, const long* range, long count, long words, long per) {
  const long* begin = range + 2 * count;
  for (long w = blockIdx.x * static_cast<long>(blockDim.x) + threadIdx.x; w < words;
       w += gridDim.x * static_cast<long>(blockDim.x)) {
    const long item = w / per;
    long first = 0, last = count;  // the range that holds it
    while (last - first > 1) {
      const long middle = (first + last) / 2;
      (begin[middle] <= item ? first : last) = middle;
    }
    to[w] = from[(range[2 * first] + item - begin[first]) * per + w % per];
  }
}

template <class Word>
void launch_pack(void* to, const void* from, const void* ranges, long count, long items, size_t item) {
  const long per = static_cast<long>(item / sizeof(Word)), words = items * per, threads = 256;
  pack<<<static_cast<unsigned>((words + threads - 1) / threads), threads>>>(
      static_cast<Word*>(to), static_cast<const Word*>(from), static_cast<const long*>(ranges), count, words, per);
  check(cudaGetLastError(), "gather");
}

}  // namespace

void gather(void* here, const void* there, const void* ranges, long count, long items, size_t item) {
  const size_t bytes = static_cast<size_t>(items) * item;
  void* packed = allocate(bytes);
  if (item % sizeof(long) == 0)
    launch_pack<long>(packed, there, ranges, count, items, item);
  else if (item % sizeof(int) == 0)
    launch_pack<int>(packed, there, ranges, count, items, item);
  else
    launch_pack<char>(packed, there, ranges, count, items, item);
  to_host(here, packed, bytes);
  release(packed);
}

void zero(void* there, size_t bytes) {
  if (bytes)
    check(cudaMemsetAsync(there, 0, bytes), "zero");
}

void copy(void* to, const void* from, size_t bytes) {
  if (bytes)
    check(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDeviceToDevice), "copy on the device");
}

namespace {

std::vector<cudaEvent_t> spare;  ///< marks that have ended; making one takes longer than setting it

}  // namespace

void* mark() noexcept {
  cudaEvent_t event = nullptr;
  if (!spare.empty()) {
    event = spare.back();
    spare.pop_back();
  } else if (cudaEventCreate(&event) != cudaSuccess) {
    return nullptr;
  }
  return cudaEventRecord(event) == cudaSuccess ? event : nullptr;
}

double seconds_between(void* first, void* last) {
  const cudaEvent_t begin = static_cast<cudaEvent_t>(first), end = static_cast<cudaEvent_t>(last);
  float milliseconds = 0;
  check(cudaEventSynchronize(end), "wait");
  check(cudaEventElapsedTime(&milliseconds, begin, end), "time");
  spare.insert(spare.end(), {begin, end});
  return 1e-3 * static_cast<double>(milliseconds);
}

}  // namespace riven::exec::device
