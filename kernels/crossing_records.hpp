// Keeps the crossings of every particle, and what they add to the sums of its nodes.
//
// A particle's crossings are listed anew, held against those that it had, and take their place only if they are others.
// What is listed waits in room of a fixed size, so that every thread of a device can have its own; a particle with more
// crossings is gone through again for the rest.
#pragma once
#include <algorithm>

#include "core/exec/atomic.hpp"
#include "core/state/crack_fields.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// Where records and sums stand: CrackFields.
struct CrossingStore {
  CrossingRecord* records;
  long room;  ///< records that there are
  long* used;
  int* tally;
  std::uint8_t* recount;
  bool shared;  ///< several threads change the sums at once
};

inline CrossingStore crossing_store(CrackFields& f, bool shared) {
  return {exec::data(f.records), f.records.size(),      exec::data(f.used),
          exec::data(f.tally),   exec::data(f.recount), shared};
}

class CrossingRecords {
 public:
  explicit RIVEN_FN CrossingRecords(const CrossingStore& store) : in_(store) {}

  /// A particle's crossings are added from the first to the last, then taken; again, while there are more of them.
  RIVEN_FN void begin_particle() {
    first_ = count_ = 0;
    changed_ = false;
  }
  RIVEN_FN void begin_again() { count_ = 0; }
  RIVEN_FN void add(const CrossingRecord& record) {
    const int at = count_++ - first_;
    if (at >= 0 && at < most)
      fresh_[at] = record;
  }
  RIVEN_FN bool more() const { return first_ < count_; }

  /// Makes what was added last the records of the particle. Returns whether that changes anything. Past the end of the
  /// common array nothing is written, but CrackFields::used counts the demand, so that the caller can make room and
  /// trace again.
  RIVEN_FN bool take(CrossingMemory& m) {
    const int first = first_, end = count_ - first < most ? count_ : first + most;
    const auto same = [&] {
      return (end == count_ ? m.count == count_ : end <= m.count) &&
             std::equal(fresh_, fresh_ + (end - first), in_.records + (m.first + first));
    };
    first_ = end;
    if (!changed_) {
      if (same())
        return false;
      changed_ = true;
      if (!replace_from(first, m)) {
        first_ = count_;
        return true;
      }
    }
    CrossingRecord* const at = in_.records + m.first;
    for (int r = first; r < end; ++r) {
      at[r] = fresh_[r - first];
      count(at[r], 1);
    }
    return true;
  }

  /// Counts those records of the particle whose nodes it has a weight on by now, and no others. Returns whether there
  /// was anything to change.
  RIVEN_FN bool weigh(const CrossingMemory& m) const {
    bool changed = false;
    for (int i = m.first; i < m.first + m.count; ++i) {
      CrossingRecord& r = in_.records[i];
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
  static constexpr int most = 32;  ///< taken at once

  /// Forgets all records but the first few, and makes room for as many as were added; false if there is none.
  RIVEN_FN bool replace_from(int kept, CrossingMemory& m) const {
    for (int r = kept; r < m.count; ++r)
      count(in_.records[m.first + r], -1);
    m.count = 0;
    if (count_ > m.room) {
      const long first = in_.shared ? exec::atomic_add(*in_.used, long{count_}) : (*in_.used += count_) - count_;
      if (first + count_ > in_.room)
        return false;
      std::copy(in_.records + m.first, in_.records + m.first + kept, in_.records + first);
      m.first = static_cast<int>(first);
      m.room = count_;
    }
    m.count = count_;
    return true;
  }

  RIVEN_FN void count(const CrossingRecord& r, int times) const {
    if (!r.weighs)
      return;
    if (in_.shared)
      exec::atomic_add(in_.tally[r.entry], times);
    else
      in_.tally[r.entry] += times;
    exec::atomic_set(in_.recount[r.node], std::uint8_t{1});
  }

  const CrossingStore in_;
  CrossingRecord fresh_[most];
  int first_ = 0, count_ = 0;  ///< of the fresh ones, and how many there are in all
  bool changed_ = false;
};

}  // namespace RIVEN_SIDE

}  // namespace riven
