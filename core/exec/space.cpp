#include "core/exec/space.hpp"

#include <omp.h>

#include <algorithm>

namespace riven::exec {

Space::Space(Kind kind, int threads) : kind_(kind), threads_(kind == Kind::serial ? 1 : std::max(1, threads)) {
  if (kind_ == Kind::stdpar)
    arena_ = std::make_unique<tbb::task_arena>(threads_);
}

const char* name(Kind kind) {
  switch (kind) {
    case Kind::serial: return "serial";
    case Kind::openmp: return "openmp";
    case Kind::stdpar: return "stdpar";
  }
  return "?";
}

bool parse(const std::string& text, Kind& kind) {
  for (Kind k : {Kind::serial, Kind::openmp, Kind::stdpar})
    if (text == name(k))
      return kind = k, true;
  return false;
}

int available_threads() {
  return omp_get_num_procs();
}

}  // namespace riven::exec
