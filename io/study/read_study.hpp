// Study files (TOML) into a Study.
#pragma once
#include <string>
#include <string_view>

#include "io/study/study.hpp"

namespace riven::study {

/// Reads a study. Throws Error (bad_input with file, line and key; file): unknown keys, an axis without choices,
/// choices of one name, several refined axes, a result without a reference, nothing to run.
Study read_study(const std::string& path);

/// The same from the text of the file.
Study parse_study(std::string_view text, const std::string& path);

}  // namespace riven::study
