// The part of Table that reads physical quantities, vectors of them, and functions of time.
#include <cmath>
#include <map>

#include "core/error.hpp"
#include "io/expression.hpp"
#include "io/keys.hpp"

namespace riven {

namespace {

std::string si_text(double value, const Dimension& d) {
  return fmt::format("{} {}", value, d.si);
}

}  // namespace

template <class F>
auto Table::placed(const char* key, F read) const {
  try {
    return read();
  } catch (const Error& e) {
    Trouble t = e.trouble();
    if (t.where.empty())
      t.where = where(key);
    fail(std::move(t));
  }
}

double Table::quantity_of(const toml::node& node, const char* key, const Dimension& d) const {
  if (!node.is_string())
    refuse(key, fmt::format("expected a quantity of {}: a text with number and unit", d.name),
           fmt::format("a number and a unit of {} ({}, ...)", d.name, listed(d.usual)),
           node.is_number() ? fmt::format("\"{} {}\"", *node.value<double>(), d.usual.front()) : "");
  return placed(key, [&] { return parse_quantity(*node.value<std::string>(), d); });
}

double Table::quantity(const char* key, const Dimension& d, Range allowed) const {
  return checked(key, quantity_of(need(key), key, d), allowed, d.si);
}

double Table::quantity(const char* key, const Dimension& d, Range allowed, double fallback, const char* said) const {
  return absent(key, said ? said : si_text(fallback, d)) ? fallback : quantity(key, d, allowed);
}

double Table::toughness(const char* key) const {
  const toml::node& node = need(key);
  if (!node.is_string())
    wrong_type(node, key, "a toughness as a text, \"0.5 MPa m^0.5\"");
  const double value = placed(key, [&] { return parse_toughness(*node.value<std::string>()); });
  return checked(key, value, range::positive, "Pa m^0.5");
}

Vec2 Table::heading(const char* key) const {
  const toml::array* pair = need(key).as_array();
  const auto number = [&](size_t i) { return pair->get(i)->value<double>(); };
  if (!pair || pair->size() != 2 || !number(0) || !number(1))
    refuse(key, "expected an array of two numbers, a direction", "[1, 0]");
  const Vec2 d{*number(0), *number(1)};
  const double length = norm(d);
  if (!(length > 0 && std::isfinite(length)))
    refuse(key, "the heading points nowhere", "two finite numbers, not both 0", "[1, 0]");
  return d * (1 / length);
}

Vec2 Table::vector_of(const toml::node& node, const char* key, const Dimension& d) const {
  const toml::array* pair = node.as_array();
  if (!pair || pair->size() != 2)
    refuse(key, fmt::format("expected an array of two quantities of {}", d.name),
           fmt::format("[\"1 {0}\", \"2 {0}\"]", d.usual.front()));
  return {quantity_of(*pair->get(0), key, d), quantity_of(*pair->get(1), key, d)};
}

Vec2 Table::vector(const char* key, const Dimension& d) const {
  return vector_of(need(key), key, d);
}

Vec2 Table::vector(const char* key, const Dimension& d, Vec2 fallback) const {
  return absent(key, fmt::format("[{}, {}] {}", fallback.x, fallback.y, d.si)) ? fallback : vector(key, d);
}

std::vector<Vec2> Table::points(const char* key, size_t least) const {
  const toml::node& node = need(key);
  const toml::array* array = node.as_array();
  if (!array || array->size() < least)
    refuse(key, fmt::format("expected an array of at least {} points", least), "[[\"0 mm\", \"0 mm\"], ...]");
  std::vector<Vec2> list;
  for (const toml::node& point : *array)
    list.push_back(vector_of(point, key, dimension::length));
  return list;
}

std::optional<TimeFunction> Table::function(const char* key, const Dimension& d) const {
  const toml::node* node = find(key);
  if (!node)
    return std::nullopt;
  TimeFunction f;
  if (!node->is_table()) {
    f.value = quantity(key, d, range::any);
    f.text = *node->value<std::string>();
    return f;
  }
  // Names beside value and shape are free: they are the times that the shape uses.
  const toml::table& entries = *node->as_table();
  for (const char* part : {"value", "shape"})
    if (!entries.contains(part))
      refuse(key, fmt::format("a function of time needs the key '{}'", part),
             "{ value = \"1 mm\", shape = \"sin(t/tr)\", tr = \"1 ms\" }");
  std::string shape;
  std::map<std::string, double> times;
  for (const auto& [name, entry] : entries) {
    if (name == "value") {
      f.value = quantity_of(entry, key, d);
    } else if (name == "shape") {
      if (!entry.is_string())
        wrong_type(entry, key, "a shape as a text, an expression in t");
      shape = *entry.value<std::string>();
    } else {
      times[std::string(name.str())] = quantity_of(entry, key, dimension::time);
    }
  }
  f.shape = placed(key, [&] { return parse_shape(shape, times, scene_->end_time); });
  f.text = fmt::format("{} * ({})", entries.get("value")->value<std::string>().value_or(""), shape);
  for (const auto& [name, seconds] : times)
    f.text += fmt::format(", {} = {}", name, entries.get(name)->value<std::string>().value_or(""));
  return f;
}

}  // namespace riven
