// HDF5 files by path: every call checked, every error an Error (file) that names the file.
#pragma once
#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/atomic_file.hpp"

namespace riven {

/// An HDF5 identifier that closes itself.
class HdfId {
 public:
  using Close = herr_t (*)(hid_t);
  HdfId() = default;
  HdfId(hid_t id, Close close) : id_(id), close_(close) {}
  HdfId(HdfId&& o) noexcept : id_(std::exchange(o.id_, -1)), close_(o.close_) {}
  HdfId& operator=(HdfId&& o) noexcept {
    std::swap(id_, o.id_);
    std::swap(close_, o.close_);
    return *this;
  }
  ~HdfId() {
    if (id_ >= 0)
      close_(id_);
  }
  operator hid_t() const { return id_; }
  /// Closes now; negative when HDF5 reports an error.
  herr_t close() { return id_ >= 0 ? close_(std::exchange(id_, -1)) : 0; }

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

/// Paths of groups and datasets are as in HDF5, "/VTKHDF/Points". T is double, float, std::int64_t or std::int32_t; in
/// put and read it may be std::uint8_t, too.
class HdfFile {
 public:
  /// A new file, which has its name only after commit(). Its first `own_bytes` (0, or a power of two from 512 on) are
  /// none of HDF5's.
  static HdfFile create(const std::filesystem::path& path, std::size_t own_bytes = 0);
  /// A finished file, to read.
  static HdfFile open(const std::filesystem::path& path);

  HdfFile(HdfFile&&) noexcept = default;
  HdfFile& operator=(HdfFile&&) = delete;
  ~HdfFile() = default;

  const std::filesystem::path& path() const { return path_; }

  void make_group(const std::string& group);
  void put_attribute(const std::string& object, const std::string& name, std::string_view text);
  template <class T>
  void put_attribute(const std::string& object, const std::string& name, const std::vector<T>& values);
  /// Adds rows of `width` values to the end of a dataset, which is made when it is not there. Width 0 is a plain
  /// list. Integers are compressed.
  template <class T>
  void append(const std::string& dataset, const T* values, std::size_t rows, std::size_t width = 0);
  /// A plain list at once, stored as it stands in memory. The groups on the way to it are made.
  template <class T>
  void put(const std::string& dataset, const T* values, std::size_t count);
  /// Closes, calls `finish` with the descriptor of what is then a complete file, syncs and renames.
  void commit(const std::function<void(int descriptor)>& finish = {});

  bool has(const std::string& object) const;
  std::vector<std::string> children(const std::string& group) const;  ///< names in ascending order
  bool has_attribute(const std::string& object, const std::string& name) const;
  std::string text_attribute(const std::string& object, const std::string& name) const;
  std::vector<std::int64_t> integer_attribute(const std::string& object, const std::string& name) const;
  bool is_integer(const std::string& dataset) const;
  bool is_float(const std::string& dataset) const;  ///< of 32 bits
  /// {rows} of a plain list, {rows, width} else.
  std::vector<std::size_t> extent(const std::string& dataset) const;
  template <class T>
  std::vector<T> read(const std::string& dataset) const;

 private:
  explicit HdfFile(std::filesystem::path path) : path_(std::move(path)) {}
  HdfId type_of_dataset(const std::string& dataset) const;
  hid_t check(hid_t result, const std::string& attempt) const;
  [[noreturn]] void fail(const std::string& attempt) const;

  std::filesystem::path path_;
  std::unique_ptr<AtomicFile> target_;  ///< only while writing
  std::unique_ptr<int> failure_;        ///< errno of the first failed write
  HdfId file_;                          ///< goes first: HDF5 writes on closing
};

}  // namespace riven
