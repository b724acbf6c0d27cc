// The part of Table that reads physical quantities, vectors of them, and functions of time.
#include <cmath>

#include "core/error.hpp"
#include "io/at_place.hpp"
#include "io/keys.hpp"
#include "io/toml_text.hpp"

namespace riven {

namespace {

std::string si_text(double value, const Dimension& d) {
  return fmt::format("{} {}", value, d.si);
}

}  // namespace

template <class F>
auto Table::placed(const char* key, F read) const {
  return at_place(where(key), read);
}

double Table::quantity_of(const toml::node& node, const char* key, const Dimension& d) const {
  const auto with_units = [&](double value) {
    const std::string usual = fmt::format("\"{} {}\"", value, d.usual.front());
    return d.usual.front() == d.si ? usual : fmt::format("{}, or \"{} {}\" if that is meant", usual, value, d.si);
  };
  if (!node.is_string())
    refuse(key, fmt::format("expected a quantity of {}: a text with number and unit", d.name),
           fmt::format("a number and a unit of {} ({}, ...)", d.name, listed(d.usual)),
           node.is_number() ? with_units(*node.value<double>()) : "");
  return placed(key, [&] { return parse_quantity(*node.value<std::string>(), d); });
}

double Table::quantity(const char* key, const Dimension& d, Range allowed) const {
  return checked(key, quantity_of(need(key), key, d), allowed, d.si);
}

double Table::quantity(const char* key, const Dimension& d, Range allowed, double fallback, const char* said) const {
  return absent(key, said ? said : si_text(fallback, d)) ? fallback : quantity(key, d, allowed);
}

std::vector<double> Table::quantities(const char* key, const Dimension& d, Range allowed) const {
  if (!need(key).is_array())
    return {quantity(key, d, allowed)};
  std::vector<double> list;
  for (const toml::node& item : *need(key).as_array())
    list.push_back(checked(key, quantity_of(item, key, d), allowed, d.si));
  return list;
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

double Table::constant_of(const toml::node& node, const std::string& place) const {
  if (const std::optional<double> number = node.value_exact<double>())
    return *number;
  if (const std::optional<int64_t> number = node.value_exact<int64_t>())
    return static_cast<double>(*number);
  if (!node.is_string())
    fail({Exit::bad_input, "this is no constant", place, toml_value(node), "a number, or a quantity as a text", ""});
  return at_place(place, [&] { return parse_any_quantity(*node.value<std::string>()); });
}

void Table::constants(const char* key) const {
  const toml::node* node = find(key);
  if (!node)
    return;
  if (!node->is_table())
    wrong_type(*node, key, "a table of constants");
  for (const auto& [name, entry] : *node->as_table()) {
    const std::string word(name.str()), place = where(key) + "." + shown(word);
    at_place(place, [&] { check_constant_name(word); });
    scene_->constants[word] = constant_of(entry, place);
  }
}

Table::Shaped Table::shaped(const toml::table& entries, const char* key, const Dimension& d, bool times) const {
  for (const char* part : {"value", "shape"})
    if (!entries.contains(part))
      refuse(key, fmt::format("a function needs the key '{}'", part),
             "{ value = \"1 mm\", shape = \"sin(t/tr)\", tr = \"1 ms\" }");
  Shaped f;
  f.constants = scene_->constants;
  f.value = quantity_of(*entries.get("value"), key, d);
  if (!entries.get("shape")->is_string())
    wrong_type(*entries.get("shape"), key, "a shape as a text, an expression in t");
  f.shape = *entries.get("shape")->value<std::string>();
  f.text = fmt::format("{} * ({})", entries.get("value")->value<std::string>().value_or(""), f.shape);
  // names beside value and shape are free: they are the constants that the shape uses
  for (const auto& [name, entry] : entries)
    if (name != "value" && name != "shape") {
      f.constants[std::string(name.str())] =
          times ? quantity_of(entry, key, dimension::time) : constant_of(entry, where(key) + "." + shown(name.str()));
      f.text += fmt::format(", {} = {}", name.str(), entry.value<std::string>().value_or(toml_value(entry)));
    }
  return f;
}

TimeFunction Table::of_time(const Shaped& f, const char* key) const {
  return {f.value, placed(key, [&] { return parse_shape(f.shape, f.constants, scene_->end_time); }), f.text};
}

std::optional<TimeFunction> Table::function(const char* key, const Dimension& d) const {
  const toml::node* node = find(key);
  if (!node)
    return std::nullopt;
  if (!node->is_table())
    return TimeFunction{quantity(key, d, range::any), {}, *node->value<std::string>()};
  return of_time(shaped(*node->as_table(), key, d, true), key);
}

std::optional<Field> Table::field(const char* key, const Dimension& d) const {
  const toml::node* node = find(key);
  if (!node || !node->is_table())
    return function(key, d);
  const Shaped read = shaped(*node->as_table(), key, d, false);
  Field f(read.value, placed(key, [&] { return parse_field(read.shape, read.constants); }));
  if (!names_place(read.shape))
    return of_time(read, key);
  f.text = read.text;
  return f;
}

}  // namespace riven
