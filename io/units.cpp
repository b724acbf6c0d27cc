#include "io/units.hpp"

#include <udunits2.h>

#include <cctype>
#include <charconv>
#include <cmath>
#include <memory>
#include <optional>

#include "core/error.hpp"
#include "io/suggest.hpp"

namespace riven {

namespace {

using Unit = std::unique_ptr<ut_unit, decltype(&ut_free)>;
using Converter = std::unique_ptr<cv_converter, decltype(&cv_free)>;

constexpr size_t longest_unit = 64;

bool letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0;
}
bool digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

ut_system* unit_system() {
  static const std::unique_ptr<ut_system, decltype(&ut_free_system)> system = [] {
    ut_set_error_message_handler(ut_ignore);  // every failure is reported through Error instead
    return std::unique_ptr<ut_system, decltype(&ut_free_system)>(ut_read_xml(nullptr), &ut_free_system);
  }();
  if (!system)
    fail({Exit::file, "the unit database of UDUNITS-2 cannot be read", "", "", "",
          "install the package libudunits2-data or set UDUNITS2_XML_PATH"});
  return system.get();
}

[[noreturn]] void refuse(std::string what, std::string_view text, const Dimension& d, std::string hint = {}) {
  if (hint.empty())
    hint = "for example \"1 " + d.usual.front() + "\"";
  fail({Exit::bad_input, std::move(what), "", "\"" + shown(text) + "\"",
        std::string("a number and a unit of ") + d.name + " (" + listed(d.usual) + ", ...)", std::move(hint)});
}

struct Split {
  double number = 0;
  std::string unit;
};

/// The number in front and the unit behind it, in ASCII: micro sign, raised 2 and 3 and the middle dot replaced.
Split split(std::string_view text, const Dimension& d) {
  std::string_view rest = text;
  const auto trim = [&] {
    while (!rest.empty() && rest.front() == ' ')
      rest.remove_prefix(1);
    while (!rest.empty() && rest.back() == ' ')
      rest.remove_suffix(1);
  };
  trim();
  if (rest.size() > 1 && rest[0] == '+' && rest[1] != '-')
    rest.remove_prefix(1);
  Split s;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), s.number);
  if (error == std::errc::result_out_of_range)
    refuse("the number is out of range", text, d);
  if (error != std::errc{})
    refuse(std::string("this is not a quantity of ") + d.name, text, d);
  if (!std::isfinite(s.number))
    refuse("the number is not finite", text, d);
  rest.remove_prefix(static_cast<size_t>(end - rest.data()));
  trim();
  constexpr std::pair<std::string_view, std::string_view> plain[] = {
      {"\u00b5", "u"}, {"\u03bc", "u"}, {"\u00b2", "^2"}, {"\u00b3", "^3"}, {"\u00b7", "*"}};
  while (!rest.empty()) {
    bool replaced = false;
    for (const auto& [special, ascii] : plain)
      if (rest.starts_with(special)) {
        s.unit += ascii;
        rest.remove_prefix(special.size());
        replaced = true;
        break;
      }
    if (replaced)
      continue;
    if (!letter(rest[0]) && !digit(rest[0]) && std::string_view(" ^*/.()+-%'").find(rest[0]) == std::string_view::npos)
      refuse("the unit holds a character that no unit has", text, d);
    s.unit += rest[0];
    rest.remove_prefix(1);
  }
  if (s.unit.empty())
    refuse("the unit is missing", text, d);
  if (s.unit.size() > longest_unit)
    refuse("the unit is too long", text, d);
  if (s.unit[0] == '/')
    s.unit = "1" + s.unit;  // "80 /ms"
  return s;
}

/// UDUNITS-2 knows whole powers only and reads `m^0.5` as `m^0 . 5` and `m1/2` as `m / 2`. So digits may stand in a
/// unit only as a whole power or as the 1 of "1/s".
void check_digits(const std::string& u, std::string_view text, const Dimension& d) {
  for (size_t i = 0; i < u.size(); ++i) {
    const bool power = u[i] == '^' || (u[i] == '*' && i + 1 < u.size() && u[i + 1] == '*');
    if (!power && !digit(u[i]))
      continue;
    const size_t sign = power ? i + (u[i] == '^' ? 1 : 2) : i;
    size_t first = sign;
    if (power && first < u.size() && (u[first] == '-' || u[first] == '+'))
      ++first;
    size_t end = first;
    while (end < u.size() && digit(u[end]))
      ++end;
    const bool fraction = end == first || (end + 1 < u.size() && u[end] == '.' && digit(u[end + 1]));
    const bool attached = power || (i > 0 && (letter(u[i - 1]) || ((u[i - 1] == '-' || u[i - 1] == '+') && i > 1)));
    if (fraction && attached)
      refuse("the unit has a power that is not a whole number", text, d, "whole powers, such as m^2 or s^-1");
    if (end - first > 2)
      refuse("the unit has a number in it that is too large", text, d);
    size_t next = end;
    while (next < u.size() && u[next] == ' ')
      ++next;
    const bool one = u.substr(first, end - first) == "1" && next < u.size() && u[next] == '/';
    if (!attached && !one)
      refuse("the unit has a number in it that is not a power", text, d, "one number in front, then the unit");
    i = end - 1;
  }
}

/// Factor from one unit to another; nothing when they measure different things. UDUNITS-2 also converts between
/// reciprocals, offsets and logarithms: only proportional units pass.
std::optional<double> factor(const std::string& from, const std::string& to) {
  const Unit a(ut_parse(unit_system(), from.c_str(), UT_ASCII), &ut_free);
  const Unit b(ut_parse(unit_system(), to.c_str(), UT_ASCII), &ut_free);
  if (!a || !b)
    return std::nullopt;
  const Converter c(ut_get_converter(a.get(), b.get()), &cv_free);
  if (!c)
    return std::nullopt;
  const double one = cv_convert_double(c.get(), 1.0), two = cv_convert_double(c.get(), 2.0);
  if (cv_convert_double(c.get(), 0.0) != 0 || !(std::abs(two - 2 * one) <= 1e-12 * std::abs(two)))
    return std::nullopt;
  if (!std::isfinite(one) || one <= 0)
    return std::nullopt;
  return one;
}

bool known_unit(const std::string& unit) {
  return Unit(ut_parse(unit_system(), unit.c_str(), UT_ASCII), &ut_free) != nullptr;
}

double scaled(double number, double by, std::string_view text, const Dimension& d) {
  const double value = number * by;
  if (!std::isfinite(value))
    refuse("the quantity is too large", text, d);
  return value;
}

/// The square of a unit with whole and half powers, without parentheses other than sqrt( ) and ^(p/2), in the form
/// "MPa^2 m^1"; nothing when it is not of that form.
std::optional<std::string> squared(std::string_view u) {
  std::string result;
  int side = 1;  // -1 behind a slash
  const auto take = [&](std::string_view token) {
    const bool there = u.starts_with(token);
    if (there)
      u.remove_prefix(token.size());
    return there;
  };
  const auto name = [&] {
    size_t n = 0;
    while (n < u.size() && letter(u[n]))
      ++n;
    std::string s(u.substr(0, n));
    u.remove_prefix(n);
    return s;
  };
  while (!u.empty()) {
    if (take(" ") || take("*") || take("."))
      continue;
    if (take("1/") || take("/")) {
      side = -1;
      continue;
    }
    int twice = 2;
    std::string unit;
    if (take("sqrt(")) {
      unit = name();
      twice = 1;
      if (!take(")"))
        return std::nullopt;
    } else {
      unit = name();
      if (take("^") || take("**")) {
        const bool bracket = take("(");
        const int sign = take("-") ? -1 : 1;
        if (u.empty() || !digit(u[0]))
          return std::nullopt;
        const int whole = u[0] - '0';
        u.remove_prefix(1);
        twice = take(".5") ? 2 * whole + 1 : bracket && take("/2") ? whole : 2 * whole;
        twice *= sign;
        if ((!u.empty() && digit(u[0])) || (bracket && !take(")")))
          return std::nullopt;
      }
    }
    if (unit.empty())
      return std::nullopt;
    result += (result.empty() ? "" : " ") + unit + "^" + std::to_string(side * twice);
    side = 1;
  }
  return result.empty() ? std::nullopt : std::optional(result);
}

}  // namespace

std::optional<double> plain_number(std::string_view text) {
  double x = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
  return error == std::errc{} && end == text.data() + text.size() ? std::optional(x) : std::nullopt;
}

double parse_quantity(std::string_view text, const Dimension& d) {
  const Split s = split(text, d);
  check_digits(s.unit, text, d);
  if (&d == &dimension::angular_velocity && (s.unit.ends_with("Hz") || s.unit.ends_with("hertz")))
    refuse("'" + s.unit + "' counts turns, and would be taken for rad/s", text, d, "60 rpm is one turn in a second");
  if (const auto by = factor(s.unit, d.si))
    return scaled(s.number, *by, text, d);
  const std::string near = nearest(s.unit, d.usual);
  const std::string hint = near.empty() ? "" : "did you mean '" + near + "'?";
  if (!known_unit(s.unit))
    refuse("unknown unit '" + s.unit + "'", text, d, hint);
  refuse("'" + s.unit + "' is not a unit of " + d.name, text, d, hint);
}

double parse_any_quantity(std::string_view text) {
  using namespace dimension;
  static const Dimension any{"some dimension", "", {"mm", "ms", "m/s", "GPa", "kg/m^3"}};
  const Split s = split(text, any);
  check_digits(s.unit, text, any);
  for (const Dimension* d : {&time, &length, &area, &speed, &acceleration, &stress, &density, &force, &rate,
                             &interface_stiffness, &energy_release, &stress_optic})
    if (const auto by = factor(s.unit, d->si))
      return scaled(s.number, *by, text, any);
  refuse(known_unit(s.unit) ? "no quantity has the unit '" + s.unit + "'" : "unknown unit '" + s.unit + "'", text, any);
}

double parse_toughness(std::string_view text) {
  static const Dimension toughness{"toughness", "Pa m^0.5", {"MPa m^0.5", "MPa sqrt(m)", "N/mm^1.5"}};
  const Split s = split(text, toughness);
  const auto square = squared(s.unit);
  if (!square)
    refuse("'" + s.unit + "' is not a unit of toughness", text, toughness);
  const auto by = factor(*square, "Pa^2 m");
  if (!by)
    refuse("'" + s.unit + "' is not a unit of toughness", text, toughness);
  return scaled(s.number, std::sqrt(*by), text, toughness);
}

}  // namespace riven
