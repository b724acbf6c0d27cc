#include "io/keys.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "io/toml_text.hpp"

namespace riven {

namespace {

const toml::table& empty_table() {
  static const toml::table none;
  return none;
}

/// "scene.toml:12", or the --set argument that the node came from; empty for a node without a source.
std::string place_of(const toml::node& node) {
  const toml::source_region& s = node.source();
  if (!s.path)
    return {};
  if (s.path->starts_with("--set "))
    return *s.path;
  return s.begin.line == 0 ? *s.path : fmt::format("{}:{}", *s.path, s.begin.line);
}

const char* type_text(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table: return "a table";
    case toml::node_type::array: return "an array";
    case toml::node_type::string: return "a text";
    case toml::node_type::integer: return "a whole number";
    case toml::node_type::floating_point: return "a number";
    case toml::node_type::boolean: return "true or false";
    default: return "a date or time";
  }
}

}  // namespace

bool Range::has(double x) const {
  return std::isfinite(x) && (low_open ? x > low : x >= low) && (high_open ? x < high : x <= high);
}

std::string Range::text(const std::string& unit) const {
  const std::string u = unit.empty() ? "" : " " + unit;
  const std::string above = fmt::format("{} {}{}", low_open ? "greater than" : "at least", low, u);
  const std::string below = fmt::format("{} {}{}", high_open ? "less than" : "at most", high, u);
  if (std::isfinite(low) && std::isfinite(high))
    return above + " and " + below;
  return std::isfinite(low) ? above : std::isfinite(high) ? below : "a finite number";
}

Table::Table(const toml::table& root, Scene& scene, std::initializer_list<const char*> known)
    : table_(&root), scene_(&scene), known_(known.begin(), known.end()) {
  place_ = scene.source_path;
  check_known();
}

Table::Table(const toml::table* table, std::string path, const Table& parent, std::initializer_list<const char*> known)
    : table_(table), path_(std::move(path)), scene_(parent.scene_), known_(known.begin(), known.end()) {
  const std::string place = place_of(*table);
  place_ = place.empty() ? parent.place_ : place;
  scene_->places[path_] = where();
  check_known();
}

void Table::check_known() const {
  for (const auto& [key, node] : *table_) {
    const std::string name(key.str());
    if (std::find(known_.begin(), known_.end(), name) == known_.end()) {
      const std::string place = place_of(node), near = nearest(name, known_);
      fail({Exit::bad_input, fmt::format("unknown {} '{}'", node.is_table() ? "table" : "key", shown(name)),
            (place.empty() ? place_ : place) + ": " + shown(path(name.c_str())), "", listed(known_),
            near.empty() ? "" : "did you mean '" + near + "'?"});
    }
  }
}

std::string Table::where(const char* key) const {
  if (!key)
    return path_.empty() ? place_ : place_ + ": " + path_;
  const toml::node* node = find(key);
  const std::string place = node ? place_of(*node) : "";
  return (place.empty() ? place_ : place) + ": " + path(key);
}

void Table::refuse(const char* key, std::string what, std::string limit, std::string hint) const {
  const toml::node* node = key ? find(key) : nullptr;
  fail({Exit::bad_input, std::move(what), where(key), node ? shown(toml_value(*node)) : "", std::move(limit),
        std::move(hint)});
}

void Table::wrong_type(const toml::node& node, const char* key, const char* expected) const {
  refuse(key, fmt::format("expected {}, found {}", expected, type_text(node)), expected);
}

const toml::node& Table::need(const char* key) const {
  const toml::node* node = find(key);
  if (!node)
    refuse(key, fmt::format("missing key '{}'", key), "", fmt::format("add {} = ...", key));
  scene_->places[path(key)] = where(key);
  return *node;
}

bool Table::absent(const char* key, std::string_view fallback) const {
  if (find(key))
    return false;
  scene_->defaults.push_back(fmt::format("{} = {}", path(key), fallback));
  return true;
}

Table Table::table(const char* key, std::initializer_list<const char*> known) const {
  const toml::node* node = find(key);
  if (node && !node->is_table())
    wrong_type(*node, key, "a table");
  return {node ? node->as_table() : &empty_table(), path(key), *this, known};
}

std::vector<Table> Table::tables(const char* key, std::initializer_list<const char*> known) const {
  std::vector<Table> list;
  const toml::node* node = find(key);
  if (!node)
    return list;
  const toml::array* array = node->as_array();
  if (!array)
    refuse(key, "expected an array of tables", "", fmt::format("[[{}]] instead of [{}]", key, key));
  for (size_t i = 0; i < array->size(); ++i) {
    const toml::table* entry = array->get(i)->as_table();
    if (!entry)
      wrong_type(*array->get(i), key, "an array of tables");
    list.push_back({entry, fmt::format("{}.{}", path(key), i), *this, known});
  }
  return list;
}

double Table::checked(const char* key, double value, Range allowed, const std::string& unit) const {
  if (!std::isfinite(value))
    refuse(key, "the number is not finite", allowed.text(unit));
  if (!allowed.has(value))
    refuse(key, "the value is out of range", allowed.text(unit));
  return value;
}

double Table::number(const char* key, Range allowed) const {
  const toml::node& node = need(key);
  if (!node.is_number())
    wrong_type(node, key, "a number without unit");
  return checked(key, *node.value<double>(), allowed, "");
}

double Table::number(const char* key, Range allowed, double fallback) const {
  return absent(key, fmt::format("{}", fallback)) ? fallback : number(key, allowed);
}

int Table::integer(const char* key, int low, int high, std::optional<int> fallback) const {
  if (fallback && absent(key, std::to_string(*fallback)))
    return *fallback;
  const toml::node& node = need(key);
  if (!node.is_integer())
    wrong_type(node, key, "a whole number");
  const int64_t value = *node.value<int64_t>();
  if (value < low || value > high)
    refuse(key, "the value is out of range", fmt::format("a whole number from {} to {}", low, high));
  return static_cast<int>(value);
}

bool Table::flag(const char* key, bool fallback) const {
  if (absent(key, fallback ? "true" : "false"))
    return fallback;
  const toml::node& node = need(key);
  if (!node.is_boolean())
    wrong_type(node, key, "true or false");
  return *node.value<bool>();
}

std::string Table::text(const char* key) const {
  const toml::node& node = need(key);
  if (!node.is_string())
    wrong_type(node, key, "a text");
  std::string s = *node.value<std::string>();
  if (s.empty())
    refuse(key, "the text is empty");
  return s;
}

std::string Table::text(const char* key, const std::string& fallback) const {
  return absent(key, fallback) ? fallback : text(key);
}

std::vector<std::string> Table::texts(const char* key) const {
  std::vector<std::string> list;
  if (absent(key, "[]"))
    return list;
  const toml::node& node = need(key);
  if (!node.is_array())
    wrong_type(node, key, "an array of texts");
  for (const toml::node& item : *node.as_array()) {
    if (!item.is_string())
      wrong_type(item, key, "an array of texts");
    list.push_back(*item.value<std::string>());
  }
  return list;
}

std::string Table::value(const char* key) const {
  return toml_value(need(key));
}

std::vector<std::string> Table::values(const char* key) const {
  const toml::node& node = need(key);
  if (!node.is_array())
    wrong_type(node, key, "an array");
  std::vector<std::string> list;
  for (const toml::node& item : *node.as_array())
    list.push_back(toml_value(item));
  return list;
}

std::vector<std::string> Table::one_or_more(const char* key) const {
  return need(key).is_array() ? values(key) : std::vector<std::string>{value(key)};
}

size_t Table::one_of(const char* key, const std::vector<std::string>& names, std::optional<size_t> fallback) const {
  if (fallback && absent(key, names[*fallback]))
    return *fallback;
  const std::string word = text(key);
  const auto found = std::find(names.begin(), names.end(), word);
  if (found != names.end())
    return static_cast<size_t>(found - names.begin());
  const std::string near = nearest(word, names);
  refuse(key, fmt::format("unknown name '{}'", shown(word)), names.empty() ? "none is defined" : listed(names),
         near.empty() ? "" : "did you mean '" + near + "'?");
}

}  // namespace riven
