// The execution spaces that one test source is run on, with both ways to scatter.
#pragma once
#include <cstdlib>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/exec/space.hpp"
#include "core/scene/names.hpp"

namespace riven::test {

struct SpaceCase {
  exec::Kind kind;
  int threads;
  ScatterKind scatter;
  /// Sums are made in the same order as in every other such case, and rounded alike. A device sums tile by tile, and
  /// its compiler fuses other products.
  bool same_bits() const { return scatter == ScatterKind::ordered && kind != exec::Kind::cuda; }
  std::string name() const {
    return std::string(exec::name(kind)) + " on " + std::to_string(threads) + ", " + std::string(name_of(scatter));
  }
};

/// Every space that was built. Sums are made in a fixed order with the ordered scatter: those come first, on more
/// threads, whether or not the machine has as many cores.
inline std::vector<SpaceCase> space_cases() {
  using enum exec::Kind;
  std::vector<SpaceCase> cases{
      {serial, 1, ScatterKind::ordered}, {openmp, 1, ScatterKind::ordered}, {openmp, 2, ScatterKind::ordered},
      {openmp, 4, ScatterKind::ordered}, {stdpar, 2, ScatterKind::ordered}, {stdpar, 4, ScatterKind::ordered},
      {serial, 1, ScatterKind::atomic},  {openmp, 2, ScatterKind::atomic},  {stdpar, 2, ScatterKind::atomic}};
  if (exec::available(cuda))
    cases.insert(cases.end(), {{cuda, 2, ScatterKind::ordered}, {cuda, 2, ScatterKind::atomic}});
  return cases;
}

/// Where tests run that are about no space in particular: on one thread of the host, or in the space that
/// RIVEN_TEST_EXEC names, as for a GPU.
class ChosenSpace : public exec::Space {
 public:
  ChosenSpace() : Space(chosen(), 1) {}

 private:
  static exec::Kind chosen() {
    exec::Kind kind = exec::Kind::serial;
    if (const char* text = std::getenv("RIVEN_TEST_EXEC"); text && !exec::parse(text, kind))
      fail({Exit::bad_input, "no such space", "RIVEN_TEST_EXEC", text, {}, {}});
    return kind;
  }
};

}  // namespace riven::test
