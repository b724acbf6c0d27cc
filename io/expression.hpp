// The dimensionless shapes of functions of time and of fields, read from text (muParser).
#pragma once
#include <functional>
#include <map>
#include <string>

#include "core/scene/field.hpp"

namespace riven {

/// Named numbers that a shape may use, in SI.
using Constants = std::map<std::string, double>;

/// The function of t (in s) that `text` describes, with pi and the constants, for example
/// "t < tr ? sin(pi*t/tr) : 0". Known functions: sin cos tan asin acos atan sinh cosh tanh exp ln log10 sqrt abs sign
/// floor ceil step (0 below 0, else 1), and min, max, atan2 of two values. It is evaluated from 0 to `end`
/// once: an expression that is not finite there is refused. The result keeps state: call it from one thread at a time.
/// Throws Error (bad_input, `where` left empty).
std::function<double(double)> parse_shape(const std::string& text, const Constants& constants, double end);

/// The same of t and the place (X, Y), in m; any number of threads may call it. What it is where is not looked at.
PlaceShape parse_field(const std::string& text, const Constants& constants);

/// Does the text name a place? Then it is a field, else a function of time.
bool names_place(const std::string& text);

/// Throws Error (bad_input, `where` left empty) unless the word may name a constant.
void check_constant_name(const std::string& word);

}  // namespace riven
