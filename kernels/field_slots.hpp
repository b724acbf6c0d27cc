// The slots of all fields of a node.
#pragma once
#include "core/state/crack_fields.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

struct FieldSlots {
  FieldSlots(const CrackFields& f, int nodes)
      : nodes_(nodes),
        extra_(f.extra.empty() ? nullptr : exec::data(f.extra)),
        index_(exec::data(f.node_index)),
        start_(exec::data(f.candidate_start)) {}

  /// 1 without cracks, 2 where one crack may be seen, 4 where two and 8 where more may.
  RIVEN_INLINE int count(int node) const {
    if (!extra_ || extra_[node] < 0)
      return 1;
    const int i = index_[node];
    const int seen = start_[i + 1] - start_[i];
    return 1 << (seen < most_held ? seen : most_held);
  }
  RIVEN_INLINE long of(int node, int field) const {
    return field == 0 || !extra_ ? node : long{nodes_} + extra_[node] + field - 1;
  }
  /// The same where there are cracks, without a branch.
  RIVEN_INLINE int among_cracks(int node, int field) const {
    const int apart = nodes_ + extra_[node] + field - 1;
    return field == 0 ? node : apart;
  }

 private:
  int nodes_;
  const int *extra_, *index_, *start_;
};

}  // namespace RIVEN_SIDE

}  // namespace riven
