#include "core/exec/mirror.hpp"

#include <algorithm>
#include <cstring>
#include <mutex>

#include "core/exec/device.hpp"

namespace riven::exec {

namespace {

std::atomic<long> sent = 0, fetched = 0;  ///< bytes, to the device and to the host

}  // namespace

Traffic traffic() {
  return {sent, fetched};
}

#if defined(RIVEN_DEVICE)

namespace {

/// Several threads of the host may find at once that what they are about to read is old.
std::mutex fetching;

/// Makes what the device has written over useless to whoever holds on to it. Costs a pass over it, which only the
/// emulated device, a means of testing, is to bear.
void spoil([[maybe_unused]] void* here, [[maybe_unused]] size_t bytes) {
#if RIVEN_DEVICE_EMULATED
  std::memset(here, 0xff, bytes);
#endif
}

}  // namespace

void Mirror::fetch(void* here, size_t bytes) {
  const std::lock_guard lock(fetching);
  if (newer_.load(std::memory_order_acquire) != Newer::device)
    return;
  if (bytes)
    device::to_host(here, there_, bytes);
  fetched += static_cast<long>(bytes);
  newer_.store(Newer::neither, std::memory_order_release);
}

bool Mirror::host_reads_parts(void* here, size_t item, const RangeList& ranges) {
  if (newer_ != Newer::device)
    return false;
  ranges.to_host(here, there_, item);
  newer_ = Newer::device_but_parts;
  return true;
}

RangeList::RangeList(const std::vector<Range>& ranges) : ranges_(ranges), begin_(1) {
  for (const Range& r : ranges)
    begin_.push_back(begin_.back() + r.last - r.first);
  const size_t bytes = ranges.size() * sizeof(Range);
  there_ = device::allocate(bytes + begin_.size() * sizeof(long));
  device::to_device(there_, ranges.data(), bytes);
  device::to_device(static_cast<char*>(there_) + bytes, begin_.data(), begin_.size() * sizeof(long));
}

RangeList::~RangeList() {
  device::release(there_);
}

void RangeList::to_host(void* here, const void* there, size_t item) const {
  const size_t bytes = static_cast<size_t>(begin_.back()) * item;
  if (bytes == 0)
    return;
  std::vector<char> packed(bytes);
  device::gather(packed.data(), there, there_, static_cast<long>(ranges_.size()), begin_.back(), item);
  for (size_t r = 0; r < ranges_.size(); ++r)
    std::memcpy(static_cast<char*>(here) + static_cast<size_t>(ranges_[r].first) * item,
                packed.data() + static_cast<size_t>(begin_[r]) * item,
                static_cast<size_t>(ranges_[r].last - ranges_[r].first) * item);
  fetched += static_cast<long>(bytes);
}

void Mirror::make_room(size_t room) {
  if (room <= room_)
    return;
  device::release(there_);
  there_ = nullptr;
  room_ = 0;
  there_ = device::allocate(room);
  device::zero(there_, room);  // the padding behind the items
  room_ = room;
}

void Mirror::device_resizes(size_t before, size_t after, size_t room) {
  end_parts();
  if (room > room_) {
    void* const fresh = device::allocate(room);
    const size_t keep = std::min(before, after);
    device::copy(fresh, there_, keep);
    device::zero(static_cast<char*>(fresh) + keep, room - keep);
    device::release(there_);
    there_ = fresh;
    room_ = room;
  } else if (after > before) {
    device::zero(static_cast<char*>(there_) + before, after - before);
  }
}

void* Mirror::device_reads(const void* here, size_t bytes, size_t room) {
  if (newer_ == Newer::host) {
    make_room(room);
    if (bytes)
      device::to_device(there_, here, bytes);
    sent += static_cast<long>(bytes);
    newer_ = Newer::neither;
  }
  return there_;
}

void* Mirror::device_writes(void* here, size_t bytes, size_t room) {
  device_reads(here, bytes, room);
  if (newer_ != Newer::device)  // parts of it have to be brought anew
    spoil(here, bytes);
  newer_ = Newer::device;
  return there_;
}

void* Mirror::device_overwrites(void* here, size_t bytes, size_t room) {
  if (newer_ == Newer::host)
    make_room(room);
  if (newer_ != Newer::device)
    spoil(here, bytes);
  newer_ = Newer::device;
  return there_;
}

void Mirror::forget() noexcept {
  device::release(there_);
  there_ = nullptr;
  room_ = 0;
  newer_ = Newer::host;
}

#endif

}  // namespace riven::exec
