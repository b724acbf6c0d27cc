// Keeps the crossings of every particle, and what they add to the sums of its nodes.
#pragma once
#include <algorithm>

#include "core/exec/atomic.hpp"
#include "core/state/crack_fields.hpp"

namespace riven {

class CrossingRecords {
 public:
  /// `shared`: other threads change the sums too.
  CrossingRecords(CrackFields& fields, bool shared) : fields_(fields), shared_(shared) {}

  void begin_particle() { count_ = 0; }
  int count() const { return count_; }
  void add(const CrossingRecord& record) {
    if (count_ == fresh_.size())
      fresh_.resize(2 * fresh_.size() + 32);
    fresh_[count_++] = record;
  }

  /// Makes what was added since begin_particle() the records of the particle. Returns whether that changes anything.
  /// Past the end of the common array nothing is written, but `used` counts the demand, so that the caller can make
  /// room and trace again.
  bool replace(CrossingMemory& m) {
    CrossingRecord* at = fields_.records.data() + m.first;
    if (count_ == m.count && std::equal(at, at + count_, fresh_.begin()))
      return false;
    for (int r = 0; r < m.count; ++r)
      count(at[r], -1);
    m.count = 0;
    if (count_ > m.room) {
      const long first = shared_ ? exec::atomic_add(fields_.used, long{count_}) : (fields_.used += count_) - count_;
      if (first + count_ > fields_.records.size())
        return true;
      m.first = static_cast<int>(first);
      m.room = count_;
      at = fields_.records.data() + first;
    }
    m.count = count_;
    std::copy(fresh_.begin(), fresh_.begin() + count_, at);
    for (int r = 0; r < count_; ++r)
      count(at[r], 1);
    return true;
  }

  /// Counts those records of the particle whose nodes it has a weight on by now, and no others. Returns whether there
  /// was anything to change.
  bool weigh(const CrossingMemory& m) {
    bool changed = false;
    for (int i = m.first; i < m.first + m.count; ++i) {
      CrossingRecord& r = fields_.records[i];
      const std::uint8_t now = m.weighed >> r.neighbour & 1u;
      if (now == r.weighs)
        continue;
      changed = true;
      count(r, -1);
      r.weighs = now;
      count(r, 1);
    }
    return changed;
  }

 private:
  void count(const CrossingRecord& r, int times) {
    if (!r.weighs)
      return;
    if (shared_)
      exec::atomic_add(fields_.tally[r.entry], times);
    else
      fields_.tally[r.entry] += times;
    std::atomic_ref<std::uint8_t>(fields_.recount[r.node]).store(1, std::memory_order_relaxed);
  }

  CrackFields& fields_;
  bool shared_;
  int count_ = 0;
  exec::Array<CrossingRecord> fresh_;
};

}  // namespace riven
