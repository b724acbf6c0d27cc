#include "io/study/take_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "io/at_place.hpp"
#include "io/suggest.hpp"
#include "io/units.hpp"

namespace riven::study {

namespace {

/// "13.4 kJ/m^2", or a plain number in SI, as a number in `unit`.
double quantity(const std::string& text, const std::string& unit, const std::string& where) {
  if (const std::optional<double> number = plain_number(text))
    return *number;
  return at_place(where, [&] {
    return unit == "Pa m^0.5" ? parse_toughness(text) : parse_quantity(text, {"this column", unit.c_str(), {unit}});
  });
}

/// Rows from..to of the history, a rounding beyond its last time included.
std::pair<size_t, size_t> rows_within(const Target& window, const std::vector<double>& times) {
  const double slack = 1e-9 * (times.empty() ? 0 : times.back());
  const auto first = std::lower_bound(times.begin(), times.end(), window.from - slack);
  const auto last = std::upper_bound(first, times.end(), window.to + slack);
  return {static_cast<size_t>(first - times.begin()), static_cast<size_t>(last - times.begin())};
}

/// Mean over the time between the rows, of what is straight between them.
double mean(const std::vector<double>& t, const std::vector<double>& y, size_t first, size_t last) {
  if (last - first == 1)
    return y[first];
  double area = 0;
  for (size_t k = first + 1; k < last; ++k)
    area += 0.5 * (t[k] - t[k - 1]) * (y[k] + y[k - 1]);
  return area / (t[last - 1] - t[first]);
}

std::vector<double> squares(std::vector<double> y) {
  for (double& v : y)
    v *= v;
  return y;
}

/// The value at `time` of what is straight between the rows, and beyond them that of the nearest.
double at(const std::vector<double>& t, const std::vector<double>& y, double time) {
  const auto after = std::lower_bound(t.begin(), t.end(), time);
  if (after == t.end() || after == t.begin())
    return after == t.end() ? y.back() : y.front();
  const auto k = static_cast<size_t>(after - t.begin());
  return t[k] == time ? y[k] : y[k - 1] + (y[k] - y[k - 1]) * (time - t[k - 1]) / (t[k] - t[k - 1]);
}

/// What errors of the target are divided by: its scale, or else what is measured by.
double scale_of(const Target& target, double otherwise, const std::string& unit) {
  const double scale = target.scale.empty() ? std::abs(otherwise) : quantity(target.scale, unit, target.where);
  if (!(scale > 0 && std::isfinite(scale)))
    fail({Exit::bad_input, fmt::format("errors cannot be told relative to {:.6g}", scale), target.where,
          target.scale.empty() ? "" : shown(target.scale), "a reference other than 0, or a scale greater than 0",
          fmt::format("scale = \"1 {}\"", unit)});
  return scale;
}

/// Root mean square, over the points of the curve in the window, of the distance from it.
Taken against_curve(const Target& target, const std::vector<double>& t, const std::vector<double>& y,
                    const std::string& unit) {
  const std::string &file = target.reference.file, &where = target.where;
  const NumericTable curve = read_numeric_table(file, "the reference curve", where);
  if (curve.columns.size() != 2)
    fail({Exit::bad_input, "a reference curve has two columns", where, file, "time and value", ""});
  const double second = quantity("1 " + curve.units[0], "s", where), end = t.back() * (1 + 1e-9);
  const double scale = curve.units[1] == "1" ? 1 : quantity("1 " + curve.units[1], unit, where);
  double sum = 0, largest = 0;
  long points = 0;
  for (size_t k = 0; k < curve.columns[0].size(); ++k) {
    const double time = second * curve.columns[0][k], wanted = scale * curve.columns[1][k];
    if (time < target.from || time > target.to)
      continue;
    if (time > end)
      fail({Exit::bad_input, fmt::format("the reference curve goes on past the end of the run, {:.6g} s", t.back()),
            where, file, "a window that the run reaches", fmt::format("to = \"{:.6g} s\"", t.back())});
    sum += std::pow(at(t, y, time) - wanted, 2);
    largest = std::max(largest, std::abs(wanted));
    ++points;
  }
  if (points == 0)
    fail({Exit::bad_input, "the reference curve has no point in the window", where, file, "", ""});
  const double rms = std::sqrt(sum / static_cast<double>(points));
  return {rms, rms / scale_of(target, largest, unit), unit};
}

}  // namespace

double relative_error(const Target& target, double value, double reference, const std::string& unit) {
  return std::abs(value - reference) / scale_of(target, reference, unit);
}

Taken take_result(const Result& r, const Target& target, const std::string& column, const NumericTable& history) {
  const size_t c = history.find(column, target.where + ": column");
  const std::vector<double>&t = history.columns[0], &y = history.columns[c];
  const std::string& unit = history.units[c];
  if (r.take == Take::curve)
    return against_curve(target, t, y, unit);
  const double none = std::numeric_limits<double>::quiet_NaN();
  const auto [first, last] = rows_within(target, t);
  if (first == last)
    fail({Exit::bad_input, "no row of the history lies in the window", target.where, "", "times that the run reaches",
          ""});
  const auto begin = y.begin() + static_cast<long>(first), end = y.begin() + static_cast<long>(last);
  Taken taken{none, none, unit};
  switch (r.take) {
    case Take::mean: taken.value = mean(t, y, first, last); break;
    case Take::rms: taken.value = std::sqrt(mean(t, squares(y), first, last)); break;
    case Take::largest: taken.value = *std::max_element(begin, end); break;
    case Take::smallest: taken.value = *std::min_element(begin, end); break;
    default: taken.value = *(end - 1);
  }
  if (target.reference.kind == Reference::Kind::value)
    taken.error = relative_error(target, taken.value, quantity(target.reference.value, unit, target.where), unit);
  return taken;
}

}  // namespace riven::study
