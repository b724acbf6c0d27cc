#include "perf/device_copy.hpp"

#include <algorithm>
#include <cstddef>

#include "core/error.hpp"
#include "core/exec/device.hpp"
#include "core/exec/space.hpp"

namespace riven::perf {

#if defined(RIVEN_DEVICE)

namespace {

/// Memory on the device.
class Piece {
 public:
  explicit Piece(size_t bytes) : there_(exec::device::allocate(bytes)) { exec::device::zero(there_, bytes); }
  ~Piece() { exec::device::release(there_); }
  Piece(const Piece&) = delete;
  Piece& operator=(const Piece&) = delete;
  void* data() const { return there_; }

 private:
  void* there_;
};

}  // namespace

double device_copy_bandwidth() {
  const exec::Space space(exec::Kind::cuda);
  constexpr size_t bytes = size_t{1} << 30;
  constexpr int repetitions = 10;
  const Piece from(bytes), to(bytes);
  double best = 0;
  for (int r = 0; r < repetitions; ++r) {
    void* const start = exec::device::mark();
    exec::device::copy(to.data(), from.data(), bytes);
    best =
        std::max(best, 2.0 * static_cast<double>(bytes) / exec::device::seconds_between(start, exec::device::mark()));
  }
  return best;
}

#else

double device_copy_bandwidth() {
  std::string why_not;
  exec::available(exec::Kind::cuda, &why_not);
  fail({Exit::bad_input, why_not, "a copy on the device", {}, {}, {}});
}

#endif

}  // namespace riven::perf
