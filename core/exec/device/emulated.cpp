// A device for tests where there is none: memory apart from the host's, and threads that are taken in turn. What runs
// here has been through the same kernels, copies and teams as on a GPU; races and alignment are not seen.
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>

#include "core/exec/device.hpp"
#include "core/exec/timers.hpp"

namespace riven::exec::device {

Found find() {
  return {true, "emulated"};
}

void* allocate(size_t bytes) {
  void* there = std::aligned_alloc(256, (bytes + 255) / 256 * 256);
  if (!there)
    throw std::bad_alloc();
  std::memset(there, 0xff, bytes);
  return there;
}

void release(void* there) noexcept {
  std::free(there);
}

void to_device(void* there, const void* here, size_t bytes) {
  std::memcpy(there, here, bytes);
}

void to_host(void* here, const void* there, size_t bytes) {
  std::memcpy(here, there, bytes);
}

void gather(void* here, const void* there, const void* ranges, long count, long, size_t item) {
  const long *range = static_cast<const long*>(ranges), *begin = range + 2 * count;
  for (long r = 0; r < count; ++r)
    std::memcpy(static_cast<char*>(here) + static_cast<size_t>(begin[r]) * item,
                static_cast<const char*>(there) + static_cast<size_t>(range[2 * r]) * item,
                static_cast<size_t>(begin[r + 1] - begin[r]) * item);
}

void zero(void* there, size_t bytes) {
  std::memset(there, 0, bytes);
}

void copy(void* to, const void* from, size_t bytes) {
  std::memcpy(to, from, bytes);
}

void* mark() noexcept {
  return new double(Stopwatch::now());
}

double seconds_between(void* first, void* last) {
  const std::unique_ptr<double> begin(static_cast<double*>(first)), end(static_cast<double*>(last));
  return *end - *begin;
}

}  // namespace riven::exec::device
