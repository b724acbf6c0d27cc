// TOML documents (toml++), with what its parser takes for impossible made an error. Version 3.3 runs into an assertion
// on table heads such as "[[[a]]]", and without assertions into undefined behaviour: here its assertions throw in
// every build. Include this instead of <toml++/toml.h>.
#pragma once
#include <string>
#include <string_view>

namespace riven {

/// Throws std::logic_error.
[[noreturn]] void toml_assertion_failed(const char* expression);

}  // namespace riven

#pragma push_macro("NDEBUG")
#undef NDEBUG
#define TOML_HEADER_ONLY 0
#define TOML_ASSERT(expression) ((expression) ? static_cast<void>(0) : ::riven::toml_assertion_failed(#expression))
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")

namespace riven {

/// The document that `text` describes; its nodes carry `source` and their line. Throws Error (bad_input) with
/// "source:line".
toml::table parse_toml(std::string_view text, const std::string& source);

}  // namespace riven
