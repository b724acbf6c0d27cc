#include "core/exec/timers.hpp"

#include "core/error.hpp"
#include "core/exec/device.hpp"

namespace riven::exec {

#if defined(RIVEN_DEVICE)

Clock::~Clock() {
  try {
    settle();
  } catch (const Error&) {  // whoever asks the device for something next is told, too
  }
}

Moment Clock::mark() const noexcept {
  return on_device_ ? Moment{0, device::mark()} : Moment{Stopwatch::now(), nullptr};
}

void Clock::add(const Moment& first, const Moment& last, double& seconds) {
  if (on_device_)
    pending_.push_back({first.device, last.device, &seconds});
  else
    seconds += last.host - first.host;
}

void Clock::settle() {
  std::vector<Pending> done;
  done.swap(pending_);
  for (const Pending& p : done)
    *p.seconds += device::seconds_between(p.first, p.last);
  done.clear();
  pending_.swap(done);  // with its room
}

#else

Clock::~Clock() = default;

Moment Clock::mark() const noexcept {
  return {Stopwatch::now(), nullptr};
}

void Clock::add(const Moment& first, const Moment& last, double& seconds) {
  seconds += last.host - first.host;
}

void Clock::settle() {}

#endif

}  // namespace riven::exec
