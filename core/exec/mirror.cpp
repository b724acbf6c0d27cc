#include "core/exec/mirror.hpp"

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
  if (newer_ != Newer::device)
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
