#include "io/study/numeric_table.hpp"

#include <csv.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/error.hpp"
#include "io/suggest.hpp"
#include "io/text_file.hpp"
#include "io/units.hpp"

namespace riven::study {

namespace {

using Rows = std::vector<std::vector<std::string>>;

struct Reader {
  Rows rows;
  std::vector<std::string> row;
};

void on_field(void* text, size_t size, void* reader) {
  static_cast<Reader*>(reader)->row.emplace_back(static_cast<const char*>(text), size);
}

void on_row(int, void* reader) {
  auto* r = static_cast<Reader*>(reader);
  if (!r->row.empty() && !r->row.front().starts_with('#'))
    r->rows.push_back(r->row);
  r->row.clear();
}

Rows parse(const std::string& text, const std::string& path) {
  csv_parser parser;
  if (csv_init(&parser, 0) != 0)
    throw std::bad_alloc();
  Reader reader;
  const size_t read = csv_parse(&parser, text.data(), text.size(), on_field, on_row, &reader);
  const int error = csv_error(&parser);
  if (read == text.size())
    csv_fini(&parser, on_field, on_row, &reader);
  csv_free(&parser);
  if (read != text.size())
    fail({Exit::bad_input, std::string("the table cannot be read: ") + csv_strerror(error), path, "", "", ""});
  return std::move(reader.rows);
}

void read_head(const std::string& head, NumericTable& t) {
  const size_t bracket = head.find_last_of("([");
  const bool has_unit = bracket != std::string::npos && bracket > 0 && (head.back() == ')' || head.back() == ']');
  t.units.push_back(has_unit ? head.substr(bracket + 1, head.size() - bracket - 2) : "1");
  const std::string name = has_unit ? head.substr(0, bracket) : head;
  t.names.push_back(name.substr(0, name.find_last_not_of(' ') + 1));
}

double number(const std::string& text, const std::string& place) {
  if (text == "nan" || text == "-nan")  // a quantity that cannot be told at that time
    return std::numeric_limits<double>::quiet_NaN();
  const std::optional<double> x = plain_number(text);
  if (!x)
    fail({Exit::bad_input, "this is not a number", place, "\"" + shown(text) + "\"", "", ""});
  return *x;
}

}  // namespace

size_t NumericTable::find(const std::string& name, const std::string& where) const {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end())
    return static_cast<size_t>(found - names.begin());
  const std::string near = nearest(name, names);
  fail({Exit::bad_input, "there is no column '" + shown(name) + "' in " + path, where, "", listed(names),
        near.empty() ? "" : "did you mean '" + near + "'?"});
}

NumericTable read_numeric_table(const std::string& path, const std::string& what, const std::string& where) {
  Rows rows = parse(read_text_file(path, what, where), path);
  if (rows.empty())
    fail({Exit::bad_input, what + " has no header", where, path, "names and units of the columns, then rows", ""});
  NumericTable t;
  t.path = path;
  for (const std::string& head : rows.front())
    read_head(head, t);
  t.columns.resize(t.names.size());
  if (rows.size() > 1 && rows.back().size() < t.names.size())
    rows.pop_back();
  for (size_t r = 1; r < rows.size(); ++r) {
    const std::string place = fmt::format("{}, row {}", path, r);
    if (rows[r].size() != t.names.size())
      fail({Exit::bad_input, fmt::format("the row has {} values", rows[r].size()), place, "",
            fmt::format("{} values, as in the header", t.names.size()), ""});
    for (size_t c = 0; c < t.names.size(); ++c)
      t.columns[c].push_back(number(rows[r][c], place));
  }
  return t;
}

}  // namespace riven::study
