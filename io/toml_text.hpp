// TOML documents as text; toml++'s own formatter is undefined for very small and infinite numbers.
#pragma once
#include <string>

#include "io/toml.hpp"

namespace riven {

/// The value on one line: "2 ms", 0.3, { a = 1 }, [ 1, 2 ]. Numbers with all digits that they need.
std::string toml_value(const toml::node& node);

/// The document, a table head for each table and array of tables of the root; reads back as the same document.
std::string toml_text(const toml::table& document);

}  // namespace riven
