// Parts of arrays that are newer on the device, for a host that reads no more of them: what is around the tips of
// cracks of millions of particles.
#pragma once
#include <vector>

#include "core/exec/array.hpp"

namespace riven::exec {

/// Until it ends, the host may read those parts of arrays that were brought, and must not write to them nor read
/// others. It brings only what is newer on the device.
class PartsOnHost {
 public:
  PartsOnHost() = default;
  PartsOnHost(const PartsOnHost&) = delete;
  PartsOnHost& operator=(const PartsOnHost&) = delete;
  ~PartsOnHost() {
    for (Mirror* m : lent_)
      m->end_parts();
  }

  /// Items in the ranges, none of which may be in two of them.
  template <class... Arrays>
  void bring(const std::vector<Range>& ranges, const Arrays&... arrays) {
    const RangeList list(ranges);
    const auto one = [&](const auto& array) {
      if (array.bring_parts(list))
        lent_.push_back(&array.mirror());
    };
    (one(arrays), ...);
  }

 private:
  std::vector<Mirror*> lent_;
};

}  // namespace riven::exec
