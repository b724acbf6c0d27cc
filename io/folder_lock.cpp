#include "io/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>

#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/suggest.hpp"

namespace riven {
namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse(const fs::path& folder, int descriptor) {
  char text[32] = {};
  const ssize_t n = ::pread(descriptor, text, sizeof text - 1, 0);
  const std::string process = n > 1 ? "process " + shown({text, static_cast<std::size_t>(n - 1)}) : "another process";
  ::close(descriptor);
  fail({Exit::file, "another run writes into this folder", folder.string(), process, "one run at a time",
        "another folder with -o, or wait for that run to end"});
}

/// Whether the open file is still the one of this name: another run, or a person, may have removed or moved it.
bool in_place(int descriptor, const fs::path& path) {
  struct stat open_file {
  }, named{};
  return ::fstat(descriptor, &open_file) == 0 && ::stat(path.c_str(), &named) == 0 &&
         open_file.st_dev == named.st_dev && open_file.st_ino == named.st_ino;
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder) : path_(folder / ".lock") {
  make_folder(folder);
  for (;;) {
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor_ < 0)
      fail_file(path_, "write the file", errno);
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
      refuse(folder, descriptor_);
    if (in_place(descriptor_, path_))
      break;
    ::close(descriptor_);
  }
  // for people; that a file system knows no locks, or has no room for these few bytes, is no reason not to run
  const std::string process = std::to_string(::getpid()) + "\n";
  if (::ftruncate(descriptor_, 0) == 0)
    static_cast<void>(write_all(descriptor_, process.data(), process.size()));
}

void FolderLock::require_held() const {
  if (!in_place(descriptor_, path_))
    fail({Exit::file, "this folder has been moved or removed while the run wrote into it", path_.parent_path().string(),
          "", "a folder that stays where it is until the run has ended",
          "riven run --restart with the folder where it is now, if that holds a checkpoint"});
}

FolderLock::~FolderLock() {
  if (in_place(descriptor_, path_))
    ::unlink(path_.c_str());
  ::close(descriptor_);
}

}  // namespace riven
