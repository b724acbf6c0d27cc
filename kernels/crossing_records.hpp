// Collects the crossings that one task finds, and hands them over to the common array.
#pragma once
#include <algorithm>

#include "core/exec/atomic.hpp"
#include "core/state/crack_fields.hpp"

namespace riven {

class Recorder {
 public:
  /// Largest number of records of one particle that are sure to stay together.
  static constexpr int together = 64;

  /// `records` and `chunks` count what all tasks have handed over.
  Recorder(CrackFields& fields, long& records, long& chunks) : fields_(fields), records_(records), chunks_(chunks) {}

  void begin_particle() {
    if (size - used_ < together)
      flush();
  }
  void add(const CrossingRecord& record) {
    if (used_ == size)
      flush();
    record_[used_++] = record;
  }

  /// Past the end of the common array nothing is written, but the demand is counted, so that the caller can make room
  /// and trace again.
  void flush() {
    if (used_ == 0)
      return;
    const long begin = exec::atomic_add(records_, long{used_}), chunk = exec::atomic_add(chunks_, 1L);
    if (begin + used_ <= fields_.records.size() && chunk < fields_.chunks.size()) {
      std::copy(record_, record_ + used_, fields_.records.data() + begin);
      fields_.chunks[chunk] = {begin, used_};
      for (int r = 0; r < used_; ++r)
        if (r == 0 || record_[r].particle != record_[r - 1].particle)
          fields_.memory[record_[r].particle].first = static_cast<int>(begin + r);
    }
    used_ = 0;
  }

 private:
  static constexpr int size = 512;
  CrackFields& fields_;
  long& records_;
  long& chunks_;
  int used_ = 0;
  CrossingRecord record_[size];
};

}  // namespace riven
