#include "io/history.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>

#include "core/error.hpp"
#include "io/atomic_file.hpp"

namespace riven {
namespace fs = std::filesystem;

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos)
    return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"')
      quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

namespace {

std::string header(const std::vector<HistoryColumn>& columns) {
  std::string line;
  for (const HistoryColumn& c : columns) {
    if (!line.empty())
      line += ',';
    line += csv_field(c.name + " [" + (c.unit.empty() ? "1" : c.unit) + "]");
  }
  return line + '\n';
}

}  // namespace

History::History(fs::path path, const std::vector<HistoryColumn>& columns, const std::string& rows)
    : path_(std::move(path)), columns_(columns.size()) {
  const std::string begin = header(columns);
  header_bytes_ = begin.size();
  if (!rows.empty())
    write_file(path_, begin + rows);
  descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | (rows.empty() ? O_TRUNC : O_APPEND), 0666);
  if (descriptor_ < 0)
    fail_file(path_, "write the file", errno);
  if (rows.empty() && !write_all(descriptor_, begin.data(), begin.size())) {
    const int cause = errno;
    ::close(descriptor_);
    fail_file(path_, "write the file", cause);
  }
}

History::~History() {
  ::close(descriptor_);
}

void History::row(std::span<const double> values) {
  if (values.size() != columns_)
    fail({Exit::internal, "a row of the history has not one value per column", path_.string(),
          std::to_string(values.size()), std::to_string(columns_), ""});
  append(descriptor_, path_, fmt::format("{:.17g}\n", fmt::join(values, ",")));
}

std::string History::rows() const {
  std::string text;
  char part[65536];
  for (;;) {
    const ssize_t n = ::pread(descriptor_, part, sizeof part, static_cast<off_t>(header_bytes_ + text.size()));
    if (n < 0 && errno == EINTR)
      continue;
    if (n < 0)
      fail_file(path_, "read the file", errno);
    if (n == 0)
      return text;
    text.append(part, static_cast<std::size_t>(n));
  }
}

}  // namespace riven
