#include "io/hdf_file.hpp"

#include <algorithm>
#include <cerrno>
#include <type_traits>

#include "core/error.hpp"
#include "io/hdf_driver.hpp"

namespace riven {
namespace {

constexpr hsize_t chunk_values = 65536;  // half a mebibyte of doubles: fits in HDF5's default chunk cache
constexpr hsize_t least_chunk = 16;

template <class T>
hid_t type_of() {
  if constexpr (std::is_same_v<T, double>)
    return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, float>)
    return H5T_NATIVE_FLOAT;
  if constexpr (std::is_same_v<T, std::uint8_t>)
    return H5T_NATIVE_UINT8;
  if constexpr (std::is_same_v<T, std::int64_t>)
    return H5T_NATIVE_INT64;
  if constexpr (std::is_same_v<T, std::int32_t>)
    return H5T_NATIVE_INT32;
}

void silence() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

/// The innermost entry of HDF5's error stack.
herr_t innermost(unsigned n, const H5E_error2_t* entry, void* text) {
  if (n == 0 && entry->desc)
    *static_cast<std::string*>(text) = entry->desc;
  return 0;
}

}  // namespace

HdfFile HdfFile::create(const std::filesystem::path& path, std::size_t own_bytes) {
  silence();
  HdfFile f(path);
  f.target_ = std::make_unique<AtomicFile>(path);
  f.failure_ = std::make_unique<int>(0);
  const HdfId access(f.check(make_driver_list(f.target_->descriptor(), f.failure_.get()), "write the file"), H5Pclose);
  const HdfId layout(f.check(H5Pcreate(H5P_FILE_CREATE), "write the file"), H5Pclose);
  f.check(H5Pset_userblock(layout, own_bytes), "write the file");
  f.file_ = HdfId(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, layout, access), H5Fclose);
  f.check(f.file_, "write the file");
  return f;
}

HdfFile HdfFile::open(const std::filesystem::path& path) {
  silence();
  HdfFile f(path);
  const HdfId access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  f.file_ = HdfId(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose);
  f.check(f.file_, "read the file");
  return f;
}

void HdfFile::fail(const std::string& attempt) const {
  if (failure_ && *failure_ != 0)
    fail_file(path_, "write the file", *failure_);
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, innermost, &reason);
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  riven::fail({Exit::file, "cannot " + attempt + (reason.empty() ? "" : ": " + reason), path_.string(), "", "", ""});
}

hid_t HdfFile::check(hid_t result, const std::string& attempt) const {
  if (result < 0 || (failure_ && *failure_ != 0))
    fail(attempt);
  return result;
}

void HdfFile::make_group(const std::string& group) {
  const HdfId id(H5Gcreate2(file_, group.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  check(id, "write " + group);
}

void HdfFile::put_attribute(const std::string& object, const std::string& name, std::string_view text) {
  // ASCII of fixed length: readers of VTKHDF compare the raw bytes.
  const HdfId type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, std::max<std::size_t>(text.size(), 1));
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  const HdfId space(H5Screate(H5S_SCALAR), H5Sclose);
  const HdfId id(
      H5Acreate_by_name(file_, object.c_str(), name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  check(id, "write " + object);
  const std::string padded = text.empty() ? std::string(1, '\0') : std::string(text);
  check(H5Awrite(id, type, padded.data()), "write " + object);
}

template <class T>
void HdfFile::put_attribute(const std::string& object, const std::string& name, const std::vector<T>& values) {
  const hsize_t n = values.size();
  const HdfId space(n == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &n, nullptr), H5Sclose);
  const HdfId id(H5Acreate_by_name(file_, object.c_str(), name.c_str(), type_of<T>(), space, H5P_DEFAULT, H5P_DEFAULT,
                                   H5P_DEFAULT),
                 H5Aclose);
  check(id, "write " + object);
  check(H5Awrite(id, type_of<T>(), values.data()), "write " + object);
}

template <class T>
void HdfFile::append(const std::string& dataset, const T* values, std::size_t rows, std::size_t width) {
  const std::string attempt = "write " + dataset;
  const int rank = width == 0 ? 1 : 2;
  const hsize_t w = std::max<std::size_t>(width, 1);
  HdfId id;
  hsize_t size[2] = {0, w};
  if (has(dataset)) {
    id = HdfId(check(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), attempt), H5Dclose);
    const HdfId space(check(H5Dget_space(id), attempt), H5Sclose);
    check(H5Sget_simple_extent_dims(space, size, nullptr), attempt);
  } else {
    const hsize_t limit[2] = {H5S_UNLIMITED, w};
    const hsize_t chunk[2] = {std::clamp<hsize_t>(rows, least_chunk, std::max(least_chunk, chunk_values / w)), w};
    const HdfId space(check(H5Screate_simple(rank, size, limit), attempt), H5Sclose);
    const HdfId layout(check(H5Pcreate(H5P_DATASET_CREATE), attempt), H5Pclose);
    check(H5Pset_chunk(layout, rank, chunk), attempt);
    check(H5Pset_obj_track_times(layout, false), attempt);  // the same contents are the same bytes
    if constexpr (std::is_integral_v<T>) {
      check(H5Pset_shuffle(layout), attempt);
      check(H5Pset_deflate(layout, 1), attempt);
    }
    id =
        HdfId(check(H5Dcreate2(file_, dataset.c_str(), type_of<T>(), space, H5P_DEFAULT, layout, H5P_DEFAULT), attempt),
              H5Dclose);
  }
  if (rows > 0) {
    const hsize_t first[2] = {size[0], 0};
    const hsize_t count[2] = {rows, w};
    size[0] += rows;
    check(H5Dset_extent(id, size), attempt);
    const HdfId space(check(H5Dget_space(id), attempt), H5Sclose);
    const HdfId memory(check(H5Screate_simple(rank, count, nullptr), attempt), H5Sclose);
    check(H5Sselect_hyperslab(space, H5S_SELECT_SET, first, nullptr, count, nullptr), attempt);
    check(H5Dwrite(id, type_of<T>(), memory, space, H5P_DEFAULT, values), attempt);
  }
  check(id.close(), attempt);
}

template <class T>
void HdfFile::put(const std::string& dataset, const T* values, std::size_t count) {
  const std::string attempt = "write " + dataset;
  const hsize_t size = count;
  const HdfId space(check(H5Screate_simple(1, &size, nullptr), attempt), H5Sclose);
  const HdfId links(check(H5Pcreate(H5P_LINK_CREATE), attempt), H5Pclose);
  check(H5Pset_create_intermediate_group(links, 1), attempt);
  const HdfId layout(check(H5Pcreate(H5P_DATASET_CREATE), attempt), H5Pclose);
  check(H5Pset_obj_track_times(layout, false), attempt);
  HdfId id(check(H5Dcreate2(file_, dataset.c_str(), type_of<T>(), space, links, layout, H5P_DEFAULT), attempt),
           H5Dclose);
  if (count > 0)
    check(H5Dwrite(id, type_of<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values), attempt);
  check(id.close(), attempt);
}

void HdfFile::commit(const std::function<void(int descriptor)>& finish) {
  check(H5Fflush(file_, H5F_SCOPE_GLOBAL), "write the file");
  check(file_.close(), "write the file");
  if (finish)
    finish(target_->descriptor());
  target_->commit();
  target_.reset();
}

bool HdfFile::has(const std::string& object) const {
  // H5Lexists wants every group on the way to exist.
  for (std::size_t slash = object.find('/', 1);; slash = object.find('/', slash + 1)) {
    if (H5Lexists(file_, object.substr(0, slash).c_str(), H5P_DEFAULT) <= 0)
      return false;
    if (slash == std::string::npos)
      return true;
  }
}

std::vector<std::string> HdfFile::children(const std::string& group) const {
  const std::string attempt = "read " + group;
  const HdfId id(check(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), attempt), H5Gclose);
  H5G_info_t info;
  check(H5Gget_info(id, &info), attempt);
  std::vector<std::string> names;
  for (hsize_t n = 0; n < info.nlinks; ++n) {
    const auto name_by_index = [&](char* to, std::size_t bytes) {
      return H5Lget_name_by_idx(id, ".", H5_INDEX_NAME, H5_ITER_INC, n, to, bytes, H5P_DEFAULT);
    };
    const ssize_t length = name_by_index(nullptr, 0);
    check(length, attempt);
    std::string name(static_cast<std::size_t>(length), '\0');
    check(name_by_index(name.data(), name.size() + 1), attempt);
    names.push_back(std::move(name));
  }
  return names;
}

bool HdfFile::has_attribute(const std::string& object, const std::string& name) const {
  return H5Aexists_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

std::string HdfFile::text_attribute(const std::string& object, const std::string& name) const {
  const std::string attempt = "read " + object;
  const HdfId id(check(H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), attempt),
                 H5Aclose);
  const HdfId type(check(H5Aget_type(id), attempt), H5Tclose);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0)
    fail(attempt);
  std::string text(H5Tget_size(type), '\0');
  check(H5Aread(id, type, text.data()), attempt);
  return text.substr(0, text.find('\0'));
}

std::vector<std::int64_t> HdfFile::integer_attribute(const std::string& object, const std::string& name) const {
  const std::string attempt = "read " + object;
  const HdfId id(check(H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), attempt),
                 H5Aclose);
  const HdfId space(check(H5Aget_space(id), attempt), H5Sclose);
  std::vector<std::int64_t> values(static_cast<std::size_t>(check(H5Sget_simple_extent_npoints(space), attempt)));
  check(H5Aread(id, H5T_NATIVE_INT64, values.data()), attempt);
  return values;
}

HdfId HdfFile::type_of_dataset(const std::string& dataset) const {
  const HdfId id(check(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), "read " + dataset), H5Dclose);
  return {check(H5Dget_type(id), "read " + dataset), H5Tclose};
}

bool HdfFile::is_integer(const std::string& dataset) const {
  return H5Tget_class(type_of_dataset(dataset)) == H5T_INTEGER;
}

bool HdfFile::is_float(const std::string& dataset) const {
  const HdfId type = type_of_dataset(dataset);
  return H5Tget_class(type) == H5T_FLOAT && H5Tget_size(type) == sizeof(float);
}

std::vector<std::size_t> HdfFile::extent(const std::string& dataset) const {
  const std::string attempt = "read " + dataset;
  const HdfId id(check(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), attempt), H5Dclose);
  const HdfId space(check(H5Dget_space(id), attempt), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 1 || rank > 2)
    fail(attempt);
  hsize_t size[2] = {0, 0};
  check(H5Sget_simple_extent_dims(space, size, nullptr), attempt);
  return {size, size + rank};
}

template <class T>
std::vector<T> HdfFile::read(const std::string& dataset) const {
  std::size_t n = 1;
  for (const std::size_t s : extent(dataset))
    n *= s;
  const HdfId id(check(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), "read " + dataset), H5Dclose);
  std::vector<T> values(n);
  if (n > 0)
    check(H5Dread(id, type_of<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "read " + dataset);
  return values;
}

template void HdfFile::put_attribute(const std::string&, const std::string&, const std::vector<double>&);
template void HdfFile::put_attribute(const std::string&, const std::string&, const std::vector<std::int64_t>&);
template void HdfFile::put_attribute(const std::string&, const std::string&, const std::vector<std::int32_t>&);
template void HdfFile::append(const std::string&, const double*, std::size_t, std::size_t);
template void HdfFile::append(const std::string&, const float*, std::size_t, std::size_t);
template void HdfFile::append(const std::string&, const std::int64_t*, std::size_t, std::size_t);
template void HdfFile::append(const std::string&, const std::int32_t*, std::size_t, std::size_t);
template void HdfFile::put(const std::string&, const double*, std::size_t);
template void HdfFile::put(const std::string&, const float*, std::size_t);
template void HdfFile::put(const std::string&, const std::int32_t*, std::size_t);
template void HdfFile::put(const std::string&, const std::uint8_t*, std::size_t);
template std::vector<double> HdfFile::read(const std::string&) const;
template std::vector<float> HdfFile::read(const std::string&) const;
template std::vector<std::uint8_t> HdfFile::read(const std::string&) const;
template std::vector<std::int64_t> HdfFile::read(const std::string&) const;
template std::vector<std::int32_t> HdfFile::read(const std::string&) const;

}  // namespace riven
