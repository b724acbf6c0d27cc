#include "io/text_file.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/error.hpp"

namespace riven {

std::string read_text_file(const std::string& path, const std::string& what, const std::string& where) {
  constexpr std::uintmax_t largest = 64u << 20;
  const auto refuse = [&](const std::string& why) {
    fail({Exit::file, what + " cannot be read: " + why, where, path, "", "check the path and the permissions"});
  };
  std::error_code error;
  if (path.find('\0') != std::string::npos)
    refuse("the path holds a null character");
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status))
    refuse("there is no such file");
  if (!std::filesystem::is_regular_file(status))
    refuse("it is not a file");
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error)
    refuse(error.message());
  if (size > largest)
    refuse("it is larger than 64 MiB");
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in)
    refuse(std::strerror(errno));
  std::string text(size, '\0');
  in.read(text.data(), static_cast<std::streamsize>(size));
  if (static_cast<std::uintmax_t>(in.gcount()) != size)
    refuse("it ended early");
  return text;
}

}  // namespace riven
