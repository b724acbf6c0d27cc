// A device with memory of its own, and what is done to that memory as a whole. Two kinds fill it in
// (core/exec/device/): CUDA, and, for tests where there is no GPU, an emulated one, whose memory the host cannot
// mistake for its own.
#pragma once
#include <cstddef>
#include <string>

namespace riven::exec::device {

/// What stands here as a device: its name, or why there is none.
struct Found {
  bool any = false;
  std::string name;  ///< with `any`, else what is missing
};
Found find();

// Each of these throws Error (internal) with what the device says if it fails.

/// Bytes of the device's own, of any value; throws std::bad_alloc where it has no room for them.
void* allocate(size_t bytes);
void release(void* there) noexcept;
void to_device(void* there, const void* here, size_t bytes);
/// Waits for what the device is at.
void to_host(void* here, const void* there, size_t bytes);
/// What is in some ranges of an array with items of so many bytes, one range after the other. `ranges`: on the device,
/// `count` of [first, last) and then, count + 1 of them, where each begins among all of their `items`.
void gather(void* here, const void* there, const void* ranges, long count, long items, size_t item);
void zero(void* there, size_t bytes);
/// From one place on the device to another, which do not overlap.
void copy(void* to, const void* from, size_t bytes);

/// A moment of the device's own clock, when it has done all that it was asked for before. Null if it has failed.
void* mark() noexcept;
/// Seconds from one mark to a later one; waits for that. Ends both.
double seconds_between(void* first, void* last);

}  // namespace riven::exec::device
