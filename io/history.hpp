// history.csv: named quantities over time, one row at a time, complete rows only whatever happens to the run.
#pragma once
#include <filesystem>
#include <limits>
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
  /// Begins a file with the header "name [unit],..."; the first column is the time. With a finite `keep_until`,
  /// rows of a file with the same header up to and including that time, s, are kept and the rest is dropped: a
  /// resumed run goes on where its checkpoint was. Throws Error (file).
  History(std::filesystem::path path, const std::vector<HistoryColumn>& columns,
          double keep_until = -std::numeric_limits<double>::infinity());
  ~History();
  History(const History&) = delete;
  History& operator=(const History&) = delete;

  /// One value per column, written through to the file. After a failed write the file ends with the row before.
  void row(std::span<const double> values);

 private:
  std::filesystem::path path_;
  std::size_t columns_;
  int descriptor_ = -1;
};

}  // namespace riven
