#include "io/history.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <fstream>

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

/// The rows of an older file that a resumed run keeps.
std::string rows_until(const fs::path& path, const std::string& first_line, double time) {
  std::ifstream in(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!text.starts_with(first_line))
    return {};
  std::size_t end = first_line.size();
  while (true) {
    double t = 0;
    const char* begin = text.data() + end;
    const std::size_t next = text.find('\n', end);
    if (next == std::string::npos)
      break;
    const auto [stop, error] = std::from_chars(begin, text.data() + next, t);
    if (error != std::errc() || *stop != ',' || !(t <= time))
      break;
    end = next + 1;
  }
  return text.substr(first_line.size(), end - first_line.size());
}

}  // namespace

History::History(fs::path path, const std::vector<HistoryColumn>& columns, double keep_until)
    : path_(std::move(path)), columns_(columns.size()) {
  std::string begin = header(columns);
  if (keep_until > -std::numeric_limits<double>::infinity()) {
    begin += rows_until(path_, begin, keep_until);
    write_file(path_, begin);
  }
  const int fresh = keep_until > -std::numeric_limits<double>::infinity() ? O_APPEND : O_TRUNC;
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | fresh, 0666);
  if (descriptor_ < 0)
    fail_file(path_, "write the file", errno);
  if (fresh == O_TRUNC && !write_all(descriptor_, begin.data(), begin.size())) {
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

}  // namespace riven
