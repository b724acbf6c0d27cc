// What a study has done so far: a folder for each run, named by the run's hash.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/study/members.hpp"

namespace riven::study {

/// How a run went, and what it cost each time that it was done.
struct Record {
  std::string status;   ///< "done", "unstable", "refused", "crashed" or "interrupted"
  std::string message;  ///< why it is not done
  long steps = 0, particles = 0;
  long memory = 0;                                     ///< bytes, peak of the process
  std::vector<double> wall;                            ///< s, of the process from start to end
  std::vector<double> cpu;                             ///< s, of all its threads
  std::vector<std::pair<std::string, double>> shares;  ///< of the steps' time, by effect; "" for the plain step

  bool done() const { return status == "done"; }
  /// What ended it may have been outside: it is worth another try.
  bool cut_short() const { return status == "crashed" || status == "interrupted"; }
};

class Store {
 public:
  /// Makes the folder. Throws Error (file).
  explicit Store(std::filesystem::path folder);

  const std::filesystem::path& folder() const { return folder_; }
  /// The results of a run.
  std::filesystem::path results(const Run& run) const { return folder_ / "runs" / run.hash; }
  /// Nothing where the run has not ended yet; what cannot be read counts as that.
  std::optional<Record> find(const Run& run) const;
  /// The record appears whole or not at all. Throws Error (file).
  void keep(const Run& run, const Record& record) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace riven::study
