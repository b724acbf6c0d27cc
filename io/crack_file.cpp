#include "io/crack_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>

#include "core/error.hpp"
#include "io/at_place.hpp"
#include "io/suggest.hpp"
#include "io/units.hpp"

namespace riven {

namespace {

constexpr size_t most_rows = 100000;

std::string_view trimmed(std::string_view s) {
  const auto space = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  while (!s.empty() && space(s.front()))
    s.remove_prefix(1);
  while (!s.empty() && space(s.back()))
    s.remove_suffix(1);
  return s;
}

std::vector<std::string> cells(std::string_view line) {
  std::vector<std::string> out;
  for (;;) {
    const size_t comma = line.find(',');
    out.emplace_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos)
      return out;
    line.remove_prefix(comma + 1);
  }
}

struct Column {
  int target = -1;   ///< 0..3: x and y of the start, x and y of the end; 4: the label
  double scale = 0;  ///< to m
};

/// "x0_mm", "x0 (mm)", "x_start [mm]", "crack".
Column column(const std::string& head, const std::string& where) {
  std::string name = head, unit;
  const size_t bracket = head.find_first_of("([");
  if (bracket != std::string::npos && (head.back() == ')' || head.back() == ']')) {
    name = trimmed(std::string_view(head).substr(0, bracket));
    unit = head.substr(bracket + 1, head.size() - bracket - 2);
  } else if (const size_t bar = head.rfind('_');
             bar != std::string::npos && head.find("_start", bar) != bar && head.find("_end", bar) != bar) {
    name = head.substr(0, bar);
    unit = head.substr(bar + 1);
  }
  if (name == "crack")
    return {4, 1};
  static const std::vector<std::string> names{"x0", "y0", "x1", "y1", "x_start", "y_start", "x_end", "y_end"};
  const auto found = std::find(names.begin(), names.end(), name);
  const std::string allowed = "crack, x0_mm, y0_mm, x1_mm, y1_mm (or x_start, y_start, x_end, y_end), with their unit";
  if (found == names.end()) {
    const std::string near = nearest(name, names);
    fail({Exit::bad_input, "unknown column '" + shown(head) + "'", where, "", allowed,
          near.empty() ? "" : "did you mean '" + near + "'?"});
  }
  if (unit.empty())
    fail({Exit::bad_input, "column '" + shown(head) + "' has no unit", where, "", allowed, "'" + name + "_mm'"});
  const double scale = at_place(where, [&] { return parse_quantity("1 " + unit, dimension::length); });
  return {static_cast<int>((found - names.begin()) % 4), scale};
}

double number(const std::string& text, const std::string& where) {
  const std::optional<double> x = plain_number(text);
  if (!x || !std::isfinite(*x))
    fail({Exit::bad_input, "this is not a finite number", where, "\"" + shown(text) + "\"", "", ""});
  return *x;
}

std::vector<Column> header(const std::string& line, const std::string& where) {
  std::vector<Column> columns;
  std::array<int, 5> count{};
  for (const std::string& head : cells(line)) {
    columns.push_back(column(head, where));
    ++count[static_cast<size_t>(columns.back().target)];
  }
  if (count[4] > 1 || std::any_of(count.begin(), count.begin() + 4, [](int n) { return n != 1; }))
    fail({Exit::bad_input, "the header must name x and y of both ends once", where, shown(line), "",
          "x0_mm,y0_mm,x1_mm,y1_mm"});
  return columns;
}

}  // namespace

std::vector<CrackRow> parse_crack_file(std::string_view text, const std::string& path, const std::string& where) {
  std::vector<Column> columns;
  std::vector<CrackRow> rows;
  std::string_view rest = text;
  if (constexpr std::string_view mark = "\xEF\xBB\xBF"; rest.starts_with(mark))  // as spreadsheets begin a file
    rest.remove_prefix(mark.size());
  for (int line_number = 1; !rest.empty(); ++line_number) {
    const size_t newline = rest.find('\n');
    const std::string line(trimmed(rest.substr(0, newline)));
    rest.remove_prefix(newline == std::string_view::npos ? rest.size() : newline + 1);
    if (line.empty() || line[0] == '#')
      continue;
    const std::string place = fmt::format("{}:{}", path, line_number);
    if (columns.empty()) {
      columns = header(line, place);
      continue;
    }
    const std::vector<std::string> values = cells(line);
    if (values.size() != columns.size())
      fail({Exit::bad_input, fmt::format("the row has {} values", values.size()), place, shown(line),
            fmt::format("{} values, as in the header", columns.size()), ""});
    if (rows.size() == most_rows)
      fail({Exit::bad_input, "the file has too many cracks", place, "", fmt::format("at most {}", most_rows), ""});
    CrackRow row{std::to_string(rows.size() + 1), {}, {}, place};
    double* const targets[] = {&row.from.x, &row.from.y, &row.to.x, &row.to.y};
    for (size_t i = 0; i < values.size(); ++i)
      if (columns[i].target == 4)
        row.label = values[i];
      else
        *targets[columns[i].target] = columns[i].scale * number(values[i], place);
    rows.push_back(std::move(row));
  }
  if (rows.empty())
    fail({Exit::bad_input, "the crack file has no cracks", where, path, "a header and one row per crack", ""});
  return rows;
}

}  // namespace riven
