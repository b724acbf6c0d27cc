// Sums of crossings of one tile before they are added to the grid's: neighbouring particles cross the same cracks to
// the same nodes, so that few additions are left which other threads can meet.
#pragma once
#include <cstdint>

#include "core/exec/atomic.hpp"

namespace riven {

/// Where the sums go; entries as in CrackFields::tally.
struct TallyTarget {
  int* count;
  std::int64_t* normal;  ///< [4 entries]
  bool shared;           ///< other threads add too
};

class LocalTally {
 public:
  explicit LocalTally(TallyTarget target) : target_(target) {
    for (int& k : key_)
      k = -1;
  }

  /// One crossing of `entry`, with its normals in fixed point.
  void add(int entry, const std::int64_t normal[4]) {
    int at = entry & (size - 1);
    while (key_[at] != entry) {
      if (key_[at] < 0) {
        if (used_ == size / 2)
          return flush(), add(entry, normal);
        key_[at] = entry;
        count_[at] = 0;
        for (std::int64_t& n : normal_[at])
          n = 0;
        slot_[used_++] = at;
        break;
      }
      at = (at + 1) & (size - 1);
    }
    ++count_[at];
    for (int c = 0; c < 4; ++c)
      normal_[at][c] += normal[c];
  }

  void flush() {
    for (int u = 0; u < used_; ++u) {
      const int at = slot_[u], entry = key_[at];
      into(target_.count[entry], count_[at]);
      for (int c = 0; c < 4; ++c)
        into(target_.normal[4L * entry + c], normal_[at][c]);
      key_[at] = -1;
    }
    used_ = 0;
  }

 private:
  static constexpr int size = 512;  ///< power of two

  template <class T>
  void into(T& target, T value) const {
    if (target_.shared)
      exec::atomic_add(target, value);
    else
      target += value;
  }

  TallyTarget target_;
  int used_ = 0;
  int key_[size];
  int slot_[size / 2];
  int count_[size];
  std::int64_t normal_[size][4];
};

}  // namespace riven
