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

constexpr size_t deepest = 32;

/// Behind the text in quotes that begins at `at`.
size_t behind_quoted(std::string_view text, size_t at) {
  const char quote = text[at];
  const std::string three(3, quote);
  const bool over_lines = text.substr(at).starts_with(three);
  const auto ends = [&] {
    return over_lines ? text.substr(at).starts_with(three) : text[at] == quote || text[at] == '\n';
  };
  for (at += over_lines ? 3 : 1; at < text.size() && !ends(); ++at)
    if (quote == '"' && text[at] == '\\')
      ++at;
  while (at < text.size() && text[at] == quote)
    ++at;
  return at;
}

/// The parser descends a level for every part of a key and every bracket, and so does whatever walks through the
/// document, down to the end of the stack. Outside quotes and comments a point that is none of a key's is that of a
/// number, of which there is one between two of the characters that end a key.
void refuse_what_is_too_deep(std::string_view text, const std::string& source) {
  size_t line = 1, parts = 1, brackets = 0;
  const auto refuse_if = [&](size_t depth, const char* of_what) {
    if (depth > deepest)
      fail({Exit::bad_input, "this is nested too deeply", fmt::format("{}:{}", shown(source), line), "",
            fmt::format("at most {} {}", deepest, of_what), ""});
  };
  for (size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      const size_t behind = std::min(behind_quoted(text, at), text.size());
      line += static_cast<size_t>(
          std::count(text.begin() + static_cast<ptrdiff_t>(at), text.begin() + static_cast<ptrdiff_t>(behind), '\n'));
      at = behind - 1;
    } else if (c == '#') {
      at = std::min(text.find('\n', at), text.size()) - 1;
    } else if (c == '.') {
      refuse_if(++parts, "parts of a key, joined by dots");
    } else if (std::string_view("\n=,[]{}").find(c) != std::string_view::npos) {
      parts = 1;
      line += c == '\n';
      if (c == '[' || c == '{')
        refuse_if(++brackets, "arrays and tables in one another");
      else if (c == ']' || c == '}')
        brackets -= brackets > 0;
    }
  }
}

}  // namespace

void toml_assertion_failed(const char* expression) {
  throw std::logic_error(expression);
}

toml::table parse_toml(std::string_view text, const std::string& source) {
  refuse_what_is_too_deep(text, source);
  try {
    return toml::parse(text, source);
  } catch (const toml::parse_error& e) {
    refuse(std::string(e.description()), source, e.source().begin.line);
  } catch (const std::logic_error&) {
    refuse("unexpected character", source, asserting_line(text));
  }
}

}  // namespace riven
