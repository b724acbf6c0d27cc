#include "io/duration.hpp"

#include <array>
#include <charconv>
#include <optional>
#include <string_view>

#include "core/error.hpp"
#include "io/at_place.hpp"
#include "io/suggest.hpp"
#include "io/units.hpp"

namespace riven {

namespace {

/// h:mm:ss
std::optional<double> clock_time(std::string_view text) {
  std::array<int, 3> part{};
  for (size_t i = 0; i < part.size(); ++i) {
    const size_t end = i < 2 ? text.find(':') : text.size();
    if (end == std::string_view::npos || end == 0 || text[0] == '-')
      return std::nullopt;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + end, part[i]);
    if (error != std::errc{} || stop != text.data() + end || (i > 0 && (end != 2 || part[i] > 59)))
      return std::nullopt;
    text.remove_prefix(i < 2 ? end + 1 : end);
  }
  return 3600. * part[0] + 60. * part[1] + part[2];
}

}  // namespace

double parse_duration(const std::string& text, const std::string& where) {
  const std::optional<double> clock = clock_time(text);
  const double seconds = clock || text.find(':') != std::string::npos
                             ? clock.value_or(0)
                             : at_place(where, [&] { return parse_quantity(text, dimension::time); });
  if (!(seconds > 0))
    fail({Exit::bad_input, "this is no time to run for", where, shown(text), "more than 0, as \"30 min\" or 1:30:00",
          ""});
  return seconds;
}

}  // namespace riven
