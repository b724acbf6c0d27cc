#include "io/peak_memory.hpp"

#include <sys/resource.h>

namespace riven {

long peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
  return usage.ru_maxrss;
#else
  return 1024 * usage.ru_maxrss;  // Linux and the BSDs count in KiB
#endif
}

}  // namespace riven
