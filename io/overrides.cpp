#include "io/overrides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "core/error.hpp"
#include "io/suggest.hpp"
#include "io/toml_text.hpp"

namespace riven {

namespace {

constexpr size_t deepest = 8;

std::vector<std::string> split_path(std::string_view path) {
  std::vector<std::string> parts(1);
  for (const char c : path)
    if (c == '.')
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

/// A document with the one key "value", its source being the argument; nothing when the text is not TOML.
bool parse_value(const std::string& text, const std::string& source, toml::table& into) {
  try {
    into = parse_toml("value = " + text, source);
    return into.size() == 1 && into.contains("value");
  } catch (const Error&) {
    return false;
  }
}

toml::table value_of(const std::string& text, const std::string& source) {
  toml::table document;
  if (parse_value(text, source, document))
    return document;
  if (!parse_value(toml_value(toml::value<std::string>{text}), source, document))
    fail({Exit::bad_input, "the value is not text", shown(source), shown(text), "TOML, or text in UTF-8", ""});
  return document;
}

/// The entry that a part of a path names in an array: by index, or by its key `name`.
size_t entry_of(const toml::array& array, const std::string& part, const std::string& source) {
  size_t index = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), index);
  const bool numeric = error == std::errc{} && end == part.data() + part.size();
  if (numeric && index < array.size())
    return index;
  std::vector<std::string> names;
  for (size_t i = 0; i < array.size(); ++i) {
    const toml::table* t = array.get(i)->as_table();
    const std::string name = t ? (*t)["name"].value_or(std::string()) : std::string();
    if (!name.empty() && name == part)
      return i;
    if (!name.empty())
      names.push_back(name);
  }
  const std::string near = nearest(part, names);
  std::string allowed = array.empty()       ? "the array is empty"
                        : array.size() == 1 ? "number 0"
                                            : "numbers 0 to " + std::to_string(array.size() - 1);
  if (!names.empty())
    allowed += ", or " + listed(names);
  fail({Exit::bad_input, "there is no entry '" + shown(part) + "'", shown(source), "", allowed,
        near.empty() ? "" : "did you mean '" + near + "'?"});
}

[[noreturn]] void nothing_to_take_away(const toml::table& from, const std::string& part, const std::string& source) {
  std::vector<std::string> names;
  for (const auto& [key, node] : from)
    names.emplace_back(key.str());
  const std::string near = nearest(part, names);
  fail({Exit::bad_input, "there is no key '" + shown(part) + "' to take away", shown(source), "", listed(names),
        near.empty() ? "" : "did you mean '" + near + "'?"});
}

void apply(toml::table& root, const std::string& argument) {
  const std::string source = "--set " + argument;
  const size_t equals = argument.find('=');
  if (equals == std::string::npos || equals == 0)
    fail(
        {Exit::bad_input, "a setting needs a key and a value", shown(source), "", "key=value", "--set solver.cfl=0.3"});
  const std::vector<std::string> parts = split_path(std::string_view(argument).substr(0, equals));
  if (parts.size() > deepest || std::any_of(parts.begin(), parts.end(), [](const auto& p) { return p.empty(); }))
    fail({Exit::bad_input, "the path of a setting cannot be read", shown(source), "",
          fmt::format("at most {} names joined by dots", deepest), ""});
  const bool take_away = equals + 1 == argument.size();
  toml::table value = take_away ? toml::table() : value_of(argument.substr(equals + 1), source);
  toml::node* at = &root;
  for (size_t i = 0; i < parts.size(); ++i) {
    const bool last = i + 1 == parts.size();
    if (toml::table* table = at->as_table()) {
      if (take_away && !table->contains(parts[i]))
        nothing_to_take_away(*table, parts[i], source);
      if (last && take_away) {
        table->erase(parts[i]);
        return;
      }
      if (last) {
        table->insert_or_assign(parts[i], std::move(*value.get("value")));
        return;
      }
      const bool numbered =
          std::all_of(parts[i + 1].begin(), parts[i + 1].end(), [](char c) { return c >= '0' && c <= '9'; });
      if (!table->contains(parts[i]) && numbered)
        fail({Exit::bad_input, "there is no array '" + shown(parts[i]) + "'", shown(source), "", "",
              "--set '" + shown(parts[i]) + "=[{...}]' makes one"});
      if (!table->contains(parts[i]))
        table->insert_or_assign(parts[i], std::move(*value_of("{}", source).get("value")));
      at = table->get(parts[i]);
    } else if (toml::array* array = at->as_array()) {
      const size_t entry = entry_of(*array, parts[i], source);
      if (last && take_away) {
        array->erase(array->cbegin() + static_cast<ptrdiff_t>(entry));
        return;
      }
      if (last) {
        array->replace(array->cbegin() + static_cast<ptrdiff_t>(entry), std::move(*value.get("value")));
        return;
      }
      at = array->get(entry);
    } else {
      fail({Exit::bad_input, "'" + shown(parts[i - 1]) + "' has no keys below it", shown(source), "", "", ""});
    }
  }
}

}  // namespace

void apply_overrides(toml::table& root, const std::vector<std::string>& overrides) {
  for (const std::string& argument : overrides)
    apply(root, argument);
}

}  // namespace riven
