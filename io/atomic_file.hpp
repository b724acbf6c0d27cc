// Files that appear whole or not at all: written under a temporary name in the same folder, synced, renamed.
#pragma once
#include <filesystem>
#include <string_view>

namespace riven {

/// Throws Error (file) that names the file, what was tried and the cause, an errno value.
[[noreturn]] void fail_file(const std::filesystem::path& path, std::string_view attempt, int cause);

/// Makes the folder and its parents. Throws Error (file) when that is not possible.
void make_folder(const std::filesystem::path& folder);

/// All bytes into the descriptor, over interruptions and short writes; false, with errno set, when it cannot.
bool write_all(int descriptor, const void* data, std::size_t bytes);

/// Adds text to the end of an open file. When that cannot be, the file is cut back to what it was and Error (file) is
/// thrown.
void append(int descriptor, const std::filesystem::path& path, std::string_view text);

/// The temporary is removed when the object dies without commit(); the file that had the name before stays as
/// it was until then.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& target() const { return target_; }
  const std::filesystem::path& temporary() const { return temporary_; }
  int descriptor() const { return descriptor_; }

  void write(std::string_view bytes);
  /// Syncs, renames, and syncs the folder: from here on the file is there.
  void commit();

  /// The name that a file has until it is complete: hidden, and of no ending that a viewer would open.
  static std::filesystem::path temporary_name(const std::filesystem::path& target);

 private:
  std::filesystem::path target_, temporary_;
  int descriptor_ = -1;
};

/// The whole file at once.
void write_file(const std::filesystem::path& path, std::string_view content);

}  // namespace riven
