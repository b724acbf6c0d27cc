#include "io/checkpoint_header.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include <cerrno>
#include <charconv>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/suggest.hpp"

namespace riven {
namespace fs = std::filesystem;

namespace {

constexpr std::string_view magic = "riven checkpoint\n";

[[noreturn]] void refuse(const fs::path& path, std::string what, std::string value = {}, std::string limit = {}) {
  fail({Exit::file, std::move(what), path.string(), std::move(value), std::move(limit),
        "another checkpoint, as checkpoint.previous.h5 in the folder of results"});
}

/// Bytes from `offset` on; fewer only at the end of the file.
std::string read_at(int descriptor, off_t offset, std::size_t bytes, const fs::path& path) {
  std::string text(bytes, '\0');
  std::size_t got = 0;
  while (got < bytes) {
    const ssize_t n = ::pread(descriptor, text.data() + got, bytes - got, offset + static_cast<off_t>(got));
    if (n < 0 && errno == EINTR)
      continue;
    if (n < 0)
      fail_file(path, "read the file", errno);
    if (n == 0)
      break;
    got += static_cast<std::size_t>(n);
  }
  text.resize(got);
  return text;
}

/// XXH3 with 128 bits of the text and of the file behind the header, in hexadecimal digits.
std::string digest(const std::string& text, int descriptor, const fs::path& path) {
  const std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state(XXH3_createState(), XXH3_freeState);
  XXH3_128bits_reset(state.get());
  XXH3_128bits_update(state.get(), text.data(), text.size());
  constexpr std::size_t most = 1u << 20;
  auto at = static_cast<off_t>(checkpoint_header_bytes);
  for (;;) {
    const std::string part = read_at(descriptor, at, most, path);
    XXH3_128bits_update(state.get(), part.data(), part.size());
    at += static_cast<off_t>(part.size());
    if (part.size() < most)
      break;
  }
  const XXH128_hash_t hash = XXH3_128bits_digest(state.get());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::string head_text(int format, std::string_view program, long bytes) {
  return fmt::format("{}format {}\nprogram {}\nbytes {}\n", magic, format, program, bytes);
}

/// The first bytes as they are in the file.
std::string header(const std::string& head, int descriptor, const fs::path& path) {
  std::string all = head + "digest " + digest(head, descriptor, path) + "\n";
  all.resize(checkpoint_header_bytes, '\0');
  return all;
}

long size_of(int descriptor, const fs::path& path) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0)
    fail_file(path, "read the file", errno);
  if (!S_ISREG(status.st_mode))
    fail({Exit::file, "this is not a file", path.string()});
  return status.st_size;
}

/// What stands behind a word at the start of a line.
std::string_view entry(std::string_view head, std::string_view word) {
  const std::string start = "\n" + std::string(word) + " ";
  const std::size_t at = head.find(start);
  if (at == std::string_view::npos)
    return {};
  head.remove_prefix(at + start.size());
  return head.substr(0, head.find('\n'));
}

template <class T>
T number(std::string_view text) {
  T n = -1;
  std::from_chars(text.data(), text.data() + text.size(), n);
  return n;
}

void verify(int descriptor, const fs::path& path) {
  const long size = size_of(descriptor, path);
  const std::string block = read_at(descriptor, 0, checkpoint_header_bytes, path);
  if (!block.starts_with(magic))
    refuse(path, "this is no checkpoint of riven");
  const std::string_view program = entry(block, "program");
  const int format = number<int>(entry(block, "format"));
  if (format != checkpoint_format)
    refuse(path, "the checkpoint is of another format", fmt::format("format {}, riven {}", format, shown(program)),
           fmt::format("format {}, riven {}", checkpoint_format, RIVEN_VERSION));
  if (const long bytes = number<long>(entry(block, "bytes")); size != bytes)
    refuse(path, "the checkpoint is not whole", fmt::format("{} bytes", size), fmt::format("{} bytes", bytes));
  if (block != header(head_text(format, program, size), descriptor, path))
    refuse(path, "the checkpoint is damaged: its contents do not have the digest that they were written with");
}

}  // namespace

void seal_checkpoint(int descriptor, const fs::path& path) {
  const std::string block =
      header(head_text(checkpoint_format, RIVEN_VERSION, size_of(descriptor, path)), descriptor, path);
  if (::lseek(descriptor, 0, SEEK_SET) != 0 || !write_all(descriptor, block.data(), block.size()) ||
      ::fsync(descriptor) != 0)
    fail_file(path, "write the file", errno);
}

void verify_checkpoint(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0)
    fail_file(path, "read the checkpoint", errno);
  const std::unique_ptr<const int, void (*)(const int*)> closing(&descriptor, [](const int* d) { ::close(*d); });
  verify(descriptor, path);
}

}  // namespace riven
