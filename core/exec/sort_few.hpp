// Sorting where the items are few, or mostly in order.
#pragma once
#include "core/exec/config.hpp"

namespace riven::exec {

/// [first, last) in ascending order, by insertion.
RIVEN_FN inline void sort_few(int* first, int* last) {
  for (int* a = first; a < last; ++a) {
    const int number = *a;
    int* b = a;
    for (; b > first && b[-1] > number; --b)
      *b = b[-1];
    *b = number;
  }
}

}  // namespace riven::exec
