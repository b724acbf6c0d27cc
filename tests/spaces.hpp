// The execution spaces that one test source is run on, with both ways to scatter.
#pragma once
#include <string>
#include <vector>

#include "core/exec/space.hpp"
#include "core/scene/names.hpp"

namespace riven::test {

struct SpaceCase {
  exec::Kind kind;
  int threads;
  ScatterKind scatter;
  std::string name() const {
    return std::string(exec::name(kind)) + " on " + std::to_string(threads) + ", " + std::string(name_of(scatter));
  }
};

/// Every space that was built, on one thread and on several, whether or not the machine has as many cores.
inline std::vector<SpaceCase> space_cases() {
  std::vector<SpaceCase> list;
  for (const ScatterKind scatter : {ScatterKind::ordered, ScatterKind::atomic}) {
    list.push_back({exec::Kind::serial, 1, scatter});
    for (const int threads : {1, 2, 4})
      list.push_back({exec::Kind::openmp, threads, scatter});
    for (const int threads : {2, 4})
      list.push_back({exec::Kind::stdpar, threads, scatter});
  }
  return list;
}

}  // namespace riven::test
