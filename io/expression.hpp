// The dimensionless shape of a function of time, read from text (muParser).
#pragma once
#include <functional>
#include <map>
#include <string>

namespace riven {

/// The function of t (in s) that `text` describes, with pi and the named times (in s) as constants, for example
/// "t < tr ? sin(pi*t/tr) : 0". Known functions: sin cos tan asin acos atan sinh cosh tanh exp ln log10 sqrt abs sign
/// floor ceil step (0 below 0, else 1), and min, max, atan2 of two values. It is evaluated from 0 to `end`
/// once: an expression that is not finite there is refused. The result keeps state: call it from one thread at a time.
/// Throws Error (bad_input, `where` left empty).
std::function<double(double)> parse_shape(const std::string& text, const std::map<std::string, double>& times,
                                          double end);

}  // namespace riven
