// How long something may take, as people write it.
#pragma once
#include <string>

namespace riven {

/// "30 min", or hours, minutes and seconds as "1:30:00": seconds, more than 0. `where` is the place that it stands in.
/// Throws Error (bad_input).
double parse_duration(const std::string& text, const std::string& where);

}  // namespace riven
