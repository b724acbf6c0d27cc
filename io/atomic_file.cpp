#include "io/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "core/error.hpp"

namespace riven {
namespace fs = std::filesystem;

namespace {

std::string advice(int cause) {
  switch (cause) {
    case ENOSPC:
    case EDQUOT: return "free some space, or choose a folder on another disk with -o";
    case EFBIG: return "raise the limit on the size of files (ulimit -f), or write fewer frames";
    case EACCES:
    case EPERM:
    case EROFS: return "choose a folder that you may write to with -o";
    case ENOTDIR:
    case EEXIST: return "a part of the path is a file, not a folder; choose another folder with -o";
    default: return {};
  }
}

}  // namespace

void fail_file(const fs::path& path, std::string_view attempt, int cause) {
  const std::string reason = cause ? std::system_category().message(cause) : "the reason is unknown";
  fail({Exit::file, "cannot " + std::string(attempt) + ": " + reason, path.string(), "", "", advice(cause)});
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    fail_file(folder, "make the folder", error.value());
  if (!fs::is_directory(folder, error))
    fail_file(folder, "make the folder", ENOTDIR);
}

bool write_all(int descriptor, const void* data, std::size_t bytes) {
  const char* from = static_cast<const char*>(data);
  while (bytes > 0) {
    const ssize_t n = ::write(descriptor, from, bytes);
    if (n < 0 && errno == EINTR)
      continue;
    if (n <= 0) {
      if (n == 0)
        errno = ENOSPC;
      return false;
    }
    from += n;
    bytes -= static_cast<std::size_t>(n);
  }
  return true;
}

void append(int descriptor, const fs::path& path, std::string_view text) {
  const off_t before = ::lseek(descriptor, 0, SEEK_END);  // a file opened to be appended to stands at its start
  if (write_all(descriptor, text.data(), text.size()))
    return;
  const int cause = errno;
  if (before >= 0 && ::ftruncate(descriptor, before) != 0)
    fail_file(path, "write or shorten the file", cause);
  fail_file(path, "write the file", cause);
}

fs::path AtomicFile::temporary_name(const fs::path& target) {
  return target.parent_path() / ("." + target.filename().string() + ".part");
}

AtomicFile::AtomicFile(fs::path target) : target_(std::move(target)), temporary_(temporary_name(target_)) {
  descriptor_ = ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0)
    fail_file(target_, "write the file", errno);
}

AtomicFile::~AtomicFile() {
  if (descriptor_ < 0)
    return;
  ::close(descriptor_);
  ::unlink(temporary_.c_str());
}

void AtomicFile::write(std::string_view bytes) {
  if (!write_all(descriptor_, bytes.data(), bytes.size()))
    fail_file(target_, "write the file", errno);
}

void AtomicFile::commit() {
  if (::fsync(descriptor_) != 0)
    fail_file(target_, "write the file", errno);
  if (::rename(temporary_.c_str(), target_.c_str()) != 0)
    fail_file(target_, "put the file in place", errno);
  const int descriptor = std::exchange(descriptor_, -1);
  if (::close(descriptor) != 0)
    fail_file(target_, "write the file", errno);
  // The rename itself is durable once the folder is; some file systems cannot sync folders, and lose nothing by it.
  const fs::path folder = target_.has_parent_path() ? target_.parent_path() : fs::path(".");
  const int handle = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (handle >= 0) {
    ::fsync(handle);
    ::close(handle);
  }
}

void write_file(const fs::path& path, std::string_view content) {
  AtomicFile file(path);
  file.write(content);
  file.commit();
}

}  // namespace riven
