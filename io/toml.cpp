#define TOML_IMPLEMENTATION
#include "io/toml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "core/error.hpp"
#include "io/suggest.hpp"

namespace riven {

namespace {

[[noreturn]] void refuse(const std::string& why, const std::string& source, size_t line) {
  fail({Exit::bad_input, "this is not TOML: " + shown(why), fmt::format("{}:{}", shown(source), line), "", "",
        "see https://toml.io; texts stand in quotes"});
}

bool asserts(std::string_view text) {
  try {
    static_cast<void>(toml::parse(text));
  } catch (const toml::parse_error&) {
    return false;
  } catch (const std::logic_error&) {
    return true;
  }
  return false;
}

/// The line at whose end the text first runs into an assertion; every longer text does too.
size_t asserting_line(std::string_view text) {
  std::vector<size_t> ends;
  for (size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\n')
      ends.push_back(i + 1);
  const auto first =
      std::partition_point(ends.begin(), ends.end(), [&](size_t end) { return !asserts(text.substr(0, end)); });
  return static_cast<size_t>(first - ends.begin()) + 1;
}

}  // namespace

void toml_assertion_failed(const char* expression) {
  throw std::logic_error(expression);
}

toml::table parse_toml(std::string_view text, const std::string& source) {
  try {
    return toml::parse(text, source);
  } catch (const toml::parse_error& e) {
    refuse(std::string(e.description()), source, e.source().begin.line);
  } catch (const std::logic_error&) {
    refuse("unexpected character", source, asserting_line(text));
  }
}

}  // namespace riven
