#include "io/toml_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>

namespace riven {

namespace {

std::string in_quotes(std::string_view text) {
  std::string s = "\"";
  for (const char c : text)
    if (c == '"' || c == '\\')
      s += {'\\', c};
    else if (const auto code = static_cast<unsigned char>(c); code < 0x20 || code == 0x7f)
      s += fmt::format("\\u{:04x}", code);
    else
      s += c;
  return s + '"';
}

std::string key_text(std::string_view key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](unsigned char c) {
    return c < 0x80 && (std::isalnum(c) != 0 || c == '_' || c == '-');
  });
  return bare ? std::string(key) : in_quotes(key);
}

std::string number_text(double x) {
  const std::string s = fmt::format("{}", x);
  return std::isfinite(x) && s.find_first_of(".e") == std::string::npos ? s + ".0" : s;
}

std::string entry(std::string_view key, const toml::node& node) {
  return key_text(key) + " = " + toml_value(node);
}

bool all_tables(const toml::node& node) {
  const toml::array* array = node.as_array();
  return array && !array->empty() &&
         std::all_of(array->begin(), array->end(), [](const toml::node& n) { return n.is_table(); });
}

std::string section(const std::string& head, const toml::table& table) {
  std::string s = "\n" + head + "\n";
  for (const auto& [key, node] : table)
    s += entry(key.str(), node) + "\n";
  return s;
}

}  // namespace

std::string toml_value(const toml::node& node) {
  std::string s;
  if (const toml::table* table = node.as_table()) {
    for (const auto& [key, value] : *table)
      s += (s.empty() ? "" : ", ") + entry(key.str(), value);
    return "{ " + s + " }";
  }
  if (const toml::array* array = node.as_array()) {
    for (const toml::node& item : *array)
      s += (s.empty() ? "" : ", ") + toml_value(item);
    return "[" + s + "]";
  }
  if (node.is_string())
    return in_quotes(node.as_string()->get());
  if (node.is_floating_point())
    return number_text(node.as_floating_point()->get());
  if (node.is_integer())
    return std::to_string(node.as_integer()->get());
  if (node.is_boolean())
    return node.as_boolean()->get() ? "true" : "false";
  std::ostringstream moment;
  if (node.is_date())
    moment << node.as_date()->get();
  else if (node.is_time())
    moment << node.as_time()->get();
  else if (node.is_date_time())
    moment << node.as_date_time()->get();
  return moment.str();
}

std::string toml_text(const toml::table& document) {
  std::string s;
  for (const auto& [key, node] : document)
    if (!node.is_table() && !all_tables(node))
      s += entry(key.str(), node) + "\n";
  for (const auto& [key, node] : document) {
    const std::string name = key_text(key.str());
    if (const toml::table* table = node.as_table()) {
      s += section("[" + name + "]", *table);
    } else if (all_tables(node)) {
      for (const toml::node& item : *node.as_array())
        s += section("[[" + name + "]]", *item.as_table());
    }
  }
  return s;
}

}  // namespace riven
