#include "io/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "core/exec/timers.hpp"
#include "io/atomic_file.hpp"

namespace riven {
namespace {

constexpr double on_terminal = 1;  // s between two lines

/// 1234567 -> "1,234,567"
std::string grouped(long n) {
  std::string digits = std::to_string(n);
  for (auto at = static_cast<long>(digits.size()) - 3; at > 0; at -= 3)
    digits.insert(static_cast<std::size_t>(at), ",");
  return digits;
}

std::size_t columns_of(int descriptor) {
  winsize size{};
  return ::ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

double now() {
  return exec::Stopwatch::now();
}

}  // namespace

std::string format_time(double seconds) {
  static constexpr const char* prefixes[] = {"", "m", "u", "n", "p", "f", "a"};
  if (seconds == 0 || !std::isfinite(seconds))
    return fmt::format("{:g} s", seconds);
  int power = 0;
  double value = seconds;
  // 0.9995 would be rounded to 1.00 of the smaller prefix's 1000
  while (std::abs(value) < 0.9995 && power < 6) {
    value *= 1000;
    ++power;
  }
  const double size = std::abs(value);
  const int decimals = size < 9.995 ? 2 : size < 99.95 ? 1 : 0;
  return fmt::format("{:.{}f} {}s", value, decimals, prefixes[power]);
}

std::string format_duration(double seconds) {
  if (!std::isfinite(seconds))
    return "unknown";
  const long s = std::lround(std::max(seconds, 0.0));
  if (s >= 3600)
    return fmt::format("{} h {} min", s / 3600, s % 3600 / 60);
  if (s >= 60)
    return fmt::format("{} min {} s", s / 60, s % 60);
  return fmt::format("{} s", s);
}

std::string format_bytes(long bytes) {
  static constexpr const char* prefixes[] = {"", "k", "M", "G", "T"};
  int power = 0;
  double value = static_cast<double>(bytes);
  for (; value >= 999.5 && power < 4; ++power)
    value /= 1000;
  const int decimals = power == 0 || value >= 99.95 ? 0 : value < 9.995 ? 2 : 1;
  return fmt::format("{:.{}f} {}B", value, decimals, prefixes[power]);
}

std::string progress_line(const ProgressState& p) {
  const double part = p.end_time > 0 ? std::clamp(p.time / p.end_time, 0.0, 1.0) : 1;
  return fmt::format("{:3.0f} %  step {}  {} of {}  dt {} ({})  {:.1f} M particle-steps/s  {} left",
                     std::floor(100 * part), grouped(p.step), format_time(p.time), format_time(p.end_time),
                     format_time(p.dt), p.limiter, 1e-6 * p.particle_steps_per_second, format_duration(p.seconds_left));
}

Progress::Progress(double start_time, double end_time, long particles, bool quiet, int descriptor, double between)
    : start_time_(start_time),
      end_time_(end_time),
      particles_(particles),
      active_(!quiet),
      descriptor_(descriptor),
      terminal_(::isatty(descriptor) == 1),
      interval_(terminal_ ? on_terminal : between),
      began_(now()),
      last_written_(began_) {}

Progress::~Progress() {
  finish();
}

void Progress::update(long step, double time, double dt, std::string_view limiter) {
  if (!active_)
    return;
  const double clock = now();
  if (last_step_ < 0)
    last_step_ = first_step_ = step - 1;
  const bool at_end = terminal_ && time >= end_time_;
  if (clock - last_written_ < interval_ && !at_end)
    return;
  // at the end the mean of the run is worth more than that of its last moment
  const long steps = step - (at_end ? first_step_ : last_step_);
  const double spent = clock - (at_end ? began_ : last_written_);
  const double done = (time - start_time_) / (end_time_ - start_time_);
  const double left = at_end ? 0 : (clock - began_) * (1 - done) / done;
  const double rate = spent > 0 ? static_cast<double>(steps) * static_cast<double>(particles_) / spent : 0;
  write(progress_line({step, time, end_time_, dt, limiter, rate, left}));
  line_open_ = terminal_;
  last_step_ = step;
  last_written_ = clock;
}

void Progress::finish() {
  if (line_open_)
    write_all(descriptor_, "\n", 1);
  line_open_ = false;
}

/// On a terminal over the line before; cut to the width of the terminal, since a line that wraps cannot be written
/// over.
void Progress::write(const std::string& text) const {
  const std::string line = terminal_ ? "\r" + text.substr(0, columns_of(descriptor_) - 1) + "\x1b[K" : text + "\n";
  write_all(descriptor_, line.data(), line.size());
}

}  // namespace riven
