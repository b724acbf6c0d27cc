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

/// Reads a CSV file whose header names the columns and their unit, for example "x0_mm,y0_mm,x1_mm,y1_mm" or
/// "crack,x_start (mm),y_start (mm),x_end (mm),y_end (mm)". `where` is the place that asks for the file. Throws Error:
/// file when it cannot be read, bad_input with file and line for what is in it.
std::vector<CrackRow> read_crack_file(const std::string& path, const std::string& where);

/// The same from the contents of the file; `path` names it in messages.
std::vector<CrackRow> parse_crack_file(std::string_view text, const std::string& path, const std::string& where);

}  // namespace riven
