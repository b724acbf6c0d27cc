// events.csv: what happened at the tips of cracks, and when contact that waits for their faces was switched on and off,
// and when the run went wrong and went back; each line written as it happens.
#pragma once
#include <filesystem>
#include <vector>

#include "core/state/cracks.hpp"
#include "core/state/tips.hpp"

namespace riven {

class EventLog {
 public:
  /// Begins the file with its header, and with the events that a run that is taken up again has seen: these it gets at
  /// once, or stays as it was. Throws Error (file).
  explicit EventLog(std::filesystem::path path, const std::vector<CrackEvent>& events = {}, const Cracks& cracks = {});
  ~EventLog();
  EventLog(const EventLog&) = delete;
  EventLog& operator=(const EventLog&) = delete;

  /// Writes those of the events that are not in the file yet. After a failed write it ends with the line before.
  void write(const std::vector<CrackEvent>& events, const Cracks& cracks);

 private:
  std::filesystem::path path_;
  std::size_t written_ = 0;
  int descriptor_ = -1;
};

}  // namespace riven
