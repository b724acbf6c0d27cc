// The bound that rates on a device are read against.
#pragma once

namespace riven::perf {

/// B/s between the device and its memory while it copies 1 GiB from one place to another: what is read and what is
/// written, the best of several repetitions. Throws Error (bad input) where there is no device.
double device_copy_bandwidth();

}  // namespace riven::perf
