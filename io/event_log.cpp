#include "io/event_log.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>

#include "io/atomic_file.hpp"
#include "io/history.hpp"
#include "io/tip_report.hpp"

namespace riven {

namespace {

constexpr std::string_view column_names =
    "time [s],step,crack,end,event,x [m],y [m],other crack,K_I [Pa m^0.5],K_II [Pa m^0.5],J [J/m^2],speed [m/s],load "
    "[1]\n";

const char* name(CrackEvent::Kind kind) {
  switch (kind) {
    case CrackEvent::Kind::start: return "start";
    case CrackEvent::Kind::arrest: return "arrest";
    case CrackEvent::Kind::join: return "join";
    case CrackEvent::Kind::exit: return "exit";
    case CrackEvent::Kind::meet: return "meet";
    case CrackEvent::Kind::close: return "close";
    case CrackEvent::Kind::open: return "open";
    case CrackEvent::Kind::retry: return "retry";
  }
  return "?";
}

/// Faces close and open somewhere between the ends, and a run goes wrong anywhere.
bool at_an_end(CrackEvent::Kind kind) {
  return kind != CrackEvent::Kind::close && kind != CrackEvent::Kind::open && kind != CrackEvent::Kind::retry;
}

std::string line(const CrackEvent& e, const Cracks& cracks) {
  const auto crack = [&](int c) {
    return c < 0 ? std::string() : csv_field(cracks.names[static_cast<std::size_t>(c)]);
  };
  return fmt::format("{:.17g},{},{},{},{},{:.17g},{:.17g},{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", e.time, e.step,
                     crack(e.crack), at_an_end(e.kind) ? end_name(e.last) : "", name(e.kind), e.place.x, e.place.y,
                     crack(e.other), e.K_I, e.K_II, e.J, e.speed, e.load);
}

}  // namespace

EventLog::EventLog(std::filesystem::path path, const std::vector<CrackEvent>& events, const Cracks& cracks)
    : path_(std::move(path)), written_(events.size()) {
  if (!events.empty()) {
    std::string text(column_names);
    for (const CrackEvent& e : events)
      text += line(e, cracks);
    write_file(path_, text);
  }
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | (events.empty() ? O_TRUNC : O_APPEND), 0666);
  if (descriptor_ < 0)
    fail_file(path_, "write the file", errno);
  if (events.empty())
    append(descriptor_, path_, column_names);
}

EventLog::~EventLog() {
  ::close(descriptor_);
}

void EventLog::write(const std::vector<CrackEvent>& events, const Cracks& cracks) {
  for (; written_ < events.size(); ++written_)
    append(descriptor_, path_, line(events[written_], cracks));
}

}  // namespace riven
