// One run at a time in a folder of results.
#pragma once
#include <filesystem>

namespace riven {

/// Holds the folder while it lives, by a lock that the system takes back whenever and however the process ends: a file
/// that a killed run has left is no obstacle.
class FolderLock {
 public:
  /// Makes the folder where there is none. Throws Error (file), with the number of the other process, when it is held.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  /// Throws Error (file) when the folder is no longer where it was: another run may have begun in one of its name.
  void require_held() const;
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
};

}  // namespace riven
