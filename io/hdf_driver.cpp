#include "io/hdf_driver.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <map>
#include <memory>

#if H5_VERSION_GE(1, 13, 0)
#include <H5FDdevelop.h>
#endif

namespace riven {
namespace {

constexpr haddr_t page_size = 4096;
constexpr haddr_t greatest_address = (haddr_t{1} << 62) - 1;
using Page = std::array<char, page_size>;

struct Settings {
  int descriptor;
  int* failure;
};

/// HDF5 hands out pointers to the first member, as with a base class in C.
struct File {
  H5FD_t base;
  Settings settings;
  haddr_t allocated;              ///< end of the address space in use
  haddr_t end;                    ///< end of the file
  std::map<haddr_t, Page>* kept;  ///< pages written since the first failure
};

File* self(H5FD_t* f) {
  return reinterpret_cast<File*>(f);
}
const File* self(const H5FD_t* f) {
  return reinterpret_cast<const File*>(f);
}

bool read_descriptor(int descriptor, haddr_t address, char* to, std::size_t bytes) {
  while (bytes > 0) {
    const ssize_t n = ::pread(descriptor, to, bytes, static_cast<off_t>(address));
    if (n < 0 && errno == EINTR)
      continue;
    if (n < 0)
      return false;
    if (n == 0) {  // behind the end of the file
      std::memset(to, 0, bytes);
      return true;
    }
    to += n;
    address += static_cast<haddr_t>(n);
    bytes -= static_cast<std::size_t>(n);
  }
  return true;
}

bool write_descriptor(int descriptor, haddr_t address, const char* from, std::size_t bytes) {
  while (bytes > 0) {
    const ssize_t n = ::pwrite(descriptor, from, bytes, static_cast<off_t>(address));
    if (n < 0 && errno == EINTR)
      continue;
    if (n <= 0)
      return false;
    from += n;
    address += static_cast<haddr_t>(n);
    bytes -= static_cast<std::size_t>(n);
  }
  return true;
}

/// visit(page, offset in the page, offset in the block, bytes) for each page that the block touches.
template <class Visit>
void each_page(haddr_t address, std::size_t bytes, Visit&& visit) {
  for (std::size_t done = 0; done < bytes;) {
    const haddr_t at = address + done;
    const std::size_t in_page = static_cast<std::size_t>(at % page_size);
    const std::size_t n = std::min<std::size_t>(bytes - done, page_size - in_page);
    visit(at - in_page, in_page, done, n);
    done += n;
  }
}

void keep(File& file, haddr_t address, const char* from, std::size_t bytes) {
  each_page(address, bytes, [&](haddr_t page, std::size_t in_page, std::size_t done, std::size_t n) {
    auto [place, fresh] = file.kept->try_emplace(page);
    if (fresh && !read_descriptor(file.settings.descriptor, page, place->second.data(), page_size))
      place->second.fill(0);
    std::memcpy(place->second.data() + in_page, from + done, n);
  });
}

// ---- what HDF5 calls ----------------------------------------------------------------------------------------

H5FD_t* open_file(const char*, unsigned, hid_t list, haddr_t) {
  const auto* settings = static_cast<const Settings*>(H5Pget_driver_info(list));
  if (!settings)
    return nullptr;
  auto* file = new File{};
  file->settings = *settings;
  const off_t end = ::lseek(settings->descriptor, 0, SEEK_END);
  file->end = end > 0 ? static_cast<haddr_t>(end) : 0;
  file->kept = new std::map<haddr_t, Page>;
  return &file->base;
}

herr_t close_file(H5FD_t* f) {
  std::unique_ptr<File> file(self(f));
  delete file->kept;
  return 0;
}

herr_t query(const H5FD_t*, unsigned long* features) {
  *features = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
              H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

haddr_t get_allocated(const H5FD_t* f, H5FD_mem_t) {
  return self(f)->allocated;
}
haddr_t get_end(const H5FD_t* f, H5FD_mem_t) {
  return self(f)->end;
}
herr_t set_allocated(H5FD_t* f, H5FD_mem_t, haddr_t address) {
  self(f)->allocated = address;
  return 0;
}

herr_t read_block(H5FD_t* f, H5FD_mem_t, hid_t, haddr_t address, std::size_t bytes, void* buffer) {
  const File& file = *self(f);
  char* to = static_cast<char*>(buffer);
  if (!read_descriptor(file.settings.descriptor, address, to, bytes))
    return -1;
  if (!file.kept->empty())
    each_page(address, bytes, [&](haddr_t page, std::size_t in_page, std::size_t done, std::size_t n) {
      if (const auto place = file.kept->find(page); place != file.kept->end())
        std::memcpy(to + done, place->second.data() + in_page, n);
    });
  return 0;
}

herr_t write_block(H5FD_t* f, H5FD_mem_t, hid_t, haddr_t address, std::size_t bytes, const void* buffer) {
  File& file = *self(f);
  const char* from = static_cast<const char*>(buffer);
  if (*file.settings.failure == 0 && !write_descriptor(file.settings.descriptor, address, from, bytes))
    *file.settings.failure = errno ? errno : EIO;
  if (*file.settings.failure != 0)
    keep(file, address, from, bytes);
  file.end = std::max(file.end, address + bytes);
  return 0;
}

herr_t truncate_file(H5FD_t* f, hid_t, hbool_t) {
  File& file = *self(f);
  if (*file.settings.failure == 0 && file.end != file.allocated &&
      ::ftruncate(file.settings.descriptor, static_cast<off_t>(file.allocated)) != 0)
    *file.settings.failure = errno;
  file.end = file.allocated;
  return 0;
}

H5FD_class_t make_class() {
  H5FD_class_t c{};
#if H5_VERSION_GE(1, 13, 0)
  c.version = H5FD_CLASS_VERSION;
  c.value = static_cast<H5FD_class_value_t>(300);  // of the range for unregistered drivers
#endif
  c.name = "riven";
  c.maxaddr = greatest_address;
  c.fc_degree = H5F_CLOSE_STRONG;
  c.fapl_size = sizeof(Settings);
  c.open = open_file;
  c.close = close_file;
  c.query = query;
  c.get_eoa = get_allocated;
  c.set_eoa = set_allocated;
  c.get_eof = get_end;
  c.read = read_block;
  c.write = write_block;
  c.truncate = truncate_file;
  const H5FD_mem_t map[] = H5FD_FLMAP_DICHOTOMY;
  std::copy(std::begin(map), std::end(map), std::begin(c.fl_map));
  return c;
}

}  // namespace

hid_t make_driver_list(int descriptor, int* failure) {
  static const H5FD_class_t driver_class = make_class();
  static const hid_t driver = H5FDregister(&driver_class);
  const hid_t list = H5Pcreate(H5P_FILE_ACCESS);
  const Settings settings{descriptor, failure};
  if (list < 0 || driver < 0 || H5Pset_driver(list, driver, &settings) < 0)
    return -1;
  return list;
}

}  // namespace riven
