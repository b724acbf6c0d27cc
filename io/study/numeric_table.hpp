// Tables of comma-separated numbers with a header of names and units, as in history.csv and files of reference curves.
#pragma once
#include <string>
#include <vector>

namespace riven::study {

struct NumericTable {
  std::vector<std::string> names;  ///< without units
  std::vector<std::string> units;  ///< as in the header: "name [unit]" or "name (unit)"; "1" where none is said
  std::vector<std::vector<double>> columns;  ///< of equal length
  std::string path;

  /// Number of the column of that name. Throws Error (bad_input, `where`) with the nearest name.
  size_t find(const std::string& name, const std::string& where) const;
};

/// Lines that begin with # are left out, as is an incomplete last row. Throws Error: file when it cannot be read,
/// bad_input when there is a row that is no row of numbers.
NumericTable read_numeric_table(const std::string& path, const std::string& what, const std::string& where = {});

}  // namespace riven::study
