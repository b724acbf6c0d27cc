// Whatever lies where a checkpoint should be is refused with an Error (file), before HDF5 sees any of it; and whatever
// is given a header is then what it was sealed as.
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <string>

#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/checkpoint_header.hpp"

namespace {

/// False when it is refused.
bool accepted(const std::string& path) {
  try {
    riven::verify_checkpoint(path);
    return true;
  } catch (const riven::Error& e) {
    if (e.code() != riven::Exit::file)
      std::abort();
    return false;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const int descriptor = memfd_create("checkpoint", 0);
  const std::string path = "/proc/self/fd/" + std::to_string(descriptor);
  if (!riven::write_all(descriptor, data, size))
    std::abort();
  const bool taken = accepted(path);
  if (size < riven::checkpoint_header_bytes && ftruncate(descriptor, riven::checkpoint_header_bytes) != 0)
    std::abort();
  riven::seal_checkpoint(descriptor, path);
  if (!accepted(path))
    std::abort();
  // a digest cannot be hit by chance: what was taken was sealed as it is now
  std::string now(size, '\0');
  if (taken && (pread(descriptor, now.data(), size, 0) != static_cast<ssize_t>(size) ||
                now != std::string(reinterpret_cast<const char*>(data), size)))
    std::abort();
  close(descriptor);
  return 0;
}
