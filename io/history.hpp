// history.csv: named quantities over time, one row at a time, complete rows only whatever happens to the run.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace riven {

/// A field of a table of comma-separated values (RFC 4180).
std::string csv_field(const std::string& text);

struct HistoryColumn {
  std::string name;
  std::string unit;  ///< SI; "1" or empty for a pure number
};

class History {
 public:
  /// Begins a file with the header "name [unit],..."; the first column is the time. With `rows`, as rows() of a run
  /// that is taken up again gave them, the file gets these at once, or stays as it was. Throws Error (file).
  History(std::filesystem::path path, const std::vector<HistoryColumn>& columns, const std::string& rows = {});
  ~History();
  History(const History&) = delete;
  History& operator=(const History&) = delete;

  /// One value per column, written through to the file. After a failed write the file ends with the row before.
  void row(std::span<const double> values);
  /// What is in the file below its header. Throws Error (file).
  std::string rows() const;

 private:
  std::filesystem::path path_;
  std::size_t columns_;
  std::size_t header_bytes_;
  int descriptor_ = -1;
};

}  // namespace riven
