// The slots of all fields of a node.
#pragma once
#include "core/state/crack_fields.hpp"

namespace riven {

struct FieldSlots {
  FieldSlots(const CrackFields& f, int nodes)
      : nodes_(nodes),
        extra_(f.extra.empty() ? nullptr : f.extra.data()),
        index_(f.node_index.data()),
        start_(f.candidate_start.data()) {}

  /// 1 without cracks, 2 where one crack may be seen, 4 where several may.
  RIVEN_INLINE int count(int node) const {
    if (!extra_ || extra_[node] < 0)
      return 1;
    const int i = index_[node];
    return start_[i + 1] - start_[i] > 1 ? 4 : 2;
  }
  RIVEN_INLINE long of(int node, int field) const {
    return field == 0 || !extra_ ? node : long{nodes_} + extra_[node] + field - 1;
  }

 private:
  int nodes_;
  const int *extra_, *index_, *start_;
};

}  // namespace riven
