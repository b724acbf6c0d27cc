#include "core/exec/space.hpp"

#include <omp.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/exec/device.hpp"

namespace riven::exec {

Space::Space(Kind kind, int threads)
    : kind_(kind), threads_(kind == Kind::serial ? 1 : std::max(1, threads)), timers_(kind == Kind::cuda) {
  if (kind_ == Kind::stdpar)
    arena_ = std::make_unique<tbb::task_arena>(threads_);
  if (std::string why_not; !available(kind, &why_not))
    fail({Exit::bad_input, why_not, "--exec or solver.exec", name(kind), "a space that is there", "openmp"});
}

bool available(Kind kind, std::string* why_not) {
  if (kind != Kind::cuda)
    return true;
#if defined(RIVEN_DEVICE)
  const device::Found found = device::find();
#else
  const device::Found found{false, "this build has no CUDA space (RIVEN_CUDA)"};
#endif
  if (!found.any && why_not)
    *why_not = found.name;
  return found.any;
}

const char* name(Kind kind) {
  switch (kind) {
    case Kind::serial: return "serial";
    case Kind::openmp: return "openmp";
    case Kind::stdpar: return "stdpar";
    case Kind::cuda: return "cuda";
  }
  return "?";
}

bool parse(const std::string& text, Kind& kind) {
  for (Kind k : {Kind::serial, Kind::openmp, Kind::stdpar, Kind::cuda})
    if (text == name(k))
      return kind = k, true;
  return false;
}

int available_threads() {
  return omp_get_num_procs();
}

}  // namespace riven::exec
