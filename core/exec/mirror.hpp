// The copy of an array's memory that a device works on, and which of the two copies is the newer one. Whoever reads or
// writes says so first; what is old there is then copied over. So a kernel that runs on the host between kernels on the
// device is right without knowing of them, and what nobody asks for on the other side is never copied.
#pragma once
#include <atomic>
#include <cstddef>
#include <utility>
#include <vector>

namespace riven::exec {

/// Items [first, last) of an array.
struct Range {
  long first, last;
};

/// Bytes that mirrors have copied so far.
struct Traffic {
  long to_device = 0, to_host = 0;
};
Traffic traffic();

#if defined(RIVEN_DEVICE)

/// The same of several arrays, known to the device.
class RangeList {
 public:
  explicit RangeList(const std::vector<Range>& ranges);
  ~RangeList();
  RangeList(const RangeList&) = delete;
  RangeList& operator=(const RangeList&) = delete;
  /// Copies what is in them of an array with items of so many bytes.
  void to_host(void* here, const void* there, size_t item) const;

 private:
  const std::vector<Range>& ranges_;
  std::vector<long> begin_;  ///< [ranges + 1] where each begins among all of their items
  void* there_ = nullptr;    ///< both on the device
};

class Mirror {
 public:
  Mirror() = default;
  Mirror(const Mirror&) = delete;
  Mirror& operator=(const Mirror&) = delete;
  ~Mirror() { forget(); }

  void swap(Mirror& o) noexcept {
    std::swap(there_, o.there_);
    std::swap(room_, o.room_);
    newer_.store(o.newer_.exchange(newer_.load()));
  }

  /// The host is about to read `bytes` from `here`.
  void host_reads(void* here, size_t bytes) {
    if (newer_.load(std::memory_order_acquire) == Newer::device)
      fetch(here, bytes);
  }
  /// And to write there.
  void host_writes(void* here, size_t bytes) {
    if (newer_.load(std::memory_order_acquire) == Newer::host)
      return;
    end_parts();
    host_reads(here, bytes);
    newer_.store(Newer::host, std::memory_order_release);
  }
  /// Where the device is to read, or to write too. `room`: bytes that it needs there.
  void* device_reads(const void* here, size_t bytes, size_t room);
  void* device_writes(void* here, size_t bytes, size_t room);
  /// The same where the device is about to write all that there is.
  void* device_overwrites(void* here, size_t bytes, size_t room);

  /// Whether only the device has the newest items.
  bool device_holds() const { return newer_ == Newer::device || newer_ == Newer::device_but_parts; }
  /// Then: keeps the first of `before` bytes there, of which there are to be `after`; new ones are zero.
  void device_resizes(size_t before, size_t after, size_t room);

  /// What is in the ranges is the same on the host until end_parts(). False if all of it is, anyway.
  bool host_reads_parts(void* here, size_t item, const RangeList& ranges);
  void end_parts() {
    if (newer_ == Newer::device_but_parts)
      newer_ = Newer::device;
  }

  /// Nobody reads what is there now on either side.
  void drop() { newer_ = Newer::host; }

  /// The host's copy is the only one from now on, and there are other numbers in it.
  void forget() noexcept;

 private:
  enum class Newer { host, neither, device, device_but_parts };

  void fetch(void* here, size_t bytes);
  void make_room(size_t room);

  void* there_ = nullptr;
  size_t room_ = 0;
  std::atomic<Newer> newer_{Newer::host};
};

#else

/// Where there is no device there is nothing to keep track of.
class RangeList {
 public:
  explicit RangeList(const std::vector<Range>&) {}
};
class Mirror {
 public:
  void swap(Mirror&) noexcept {}
  bool device_holds() const { return false; }
  void device_resizes(size_t, size_t, size_t) {}
  bool host_reads_parts(void*, size_t, const RangeList&) { return false; }
  void end_parts() {}
  void drop() {}
  void host_reads(void*, size_t) {}
  void host_writes(void*, size_t) {}
  void* device_reads(const void*, size_t, size_t);
  void* device_writes(void*, size_t, size_t);
  void* device_overwrites(void*, size_t, size_t);
};

#endif

}  // namespace riven::exec
