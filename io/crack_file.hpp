// Cracks from a table of straight lines (CSV).
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "core/math/vec.hpp"

namespace riven {

/// One row of a crack file.
struct CrackRow {
  std::string label;  ///< the column `crack`, or the row's number from 1
  Vec2 from, to;      ///< m
  std::string where;  ///< "cracks.csv:12"
};

/// Reads CSV whose header names the columns and their unit, for example "x0_mm,y0_mm,x1_mm,y1_mm" or
/// "crack,x_start (mm),y_start (mm),x_end (mm),y_end (mm)". `path` is the file it comes from, `where` the place that
/// asks for it. Throws Error (bad_input) with file and line.
std::vector<CrackRow> parse_crack_file(std::string_view text, const std::string& path, const std::string& where);

}  // namespace riven
