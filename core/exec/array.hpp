// Array owns memory; View is what a kernel takes: a pointer and a length, trivially copyable. Where there is a device
// an array has a mirror there, made once a kernel asks for it: data(array) is what kernels of either side work on.
#pragma once
#include <cstdlib>
#include <cstring>
#include <new>
#include <type_traits>
#include <utility>

#include "core/exec/config.hpp"
#include "core/exec/mirror.hpp"

namespace riven::exec {

template <class T>
struct View {
  T* data = nullptr;
  long size = 0;
  RIVEN_INLINE T& operator[](long i) const { return data[i]; }
  RIVEN_INLINE T* begin() const { return data; }
  RIVEN_INLINE T* end() const { return data + size; }
};

/// A block of trivially copyable items, aligned to 64 bytes and zeroed. `padding` more items than asked
/// for can be read and written, so that a kernel may take its last block of lanes whole.
template <class T>
class Array {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  static constexpr long padding = 2 * block;

  Array() = default;
  explicit Array(long n) { resize(n); }
  Array(const Array& o) { *this = o; }
  Array(Array&& o) noexcept { swap(o); }
  Array& operator=(const Array& o) {
    if (this == &o)
      return *this;
    resize(o.size_);
    if (size_)
      std::memcpy(static_cast<void*>(data()), o.data(), bytes_held());
    return *this;
  }
  Array& operator=(Array&& o) noexcept { return swap(o), *this; }
  ~Array() { std::free(data_); }

  /// New size; the items that fit are kept, new ones are zero.
  void resize(long n) {
    if (n == size_ && data_)
      return;
    const long more = capacity_ + capacity_ / 2, room = n <= capacity_ ? capacity_ : n > more ? n : more;
    if (mirror_.device_holds()) {
      if (room > capacity_)
        take_room_for(room);
      mirror_.device_resizes(bytes_held(), static_cast<size_t>(n) * sizeof(T), bytes_of(room));
      size_ = n;
      return;
    }
    written_here();
    if (room > capacity_ || !data_)
      move_to_room_for(room);
    else if (n > size_)
      std::memset(static_cast<void*>(data_ + size_), 0, static_cast<size_t>(n - size_) * sizeof(T));
    size_ = n;
  }
  /// Room for n items and no more, where there is not as much: for large arrays that grow by little.
  void reserve(long n) {
    if (n <= capacity_)
      return;
    if (mirror_.device_holds()) {
      take_room_for(n);
      mirror_.device_resizes(bytes_held(), bytes_held(), bytes_of(n));
      return;
    }
    written_here();
    move_to_room_for(n);
  }
  void clear() { resize(0); }
  /// New size, for items that are all written before they are read.
  void renew(long n) {
    mirror_.drop();
    if (n > capacity_ || !data_)
      resize(n);
    size_ = n;
  }
  void zero() {
    mirror_.drop();
    if (size_)
      std::memset(static_cast<void*>(data()), 0, bytes_held());
  }
  void swap(Array& o) noexcept {
    std::swap(data_, o.data_);
    std::swap(size_, o.size_);
    std::swap(capacity_, o.capacity_);
    mirror_.swap(o.mirror_);
  }

  long size() const { return size_; }
  long capacity() const { return capacity_; }
  bool empty() const { return size_ == 0; }
  long bytes() const { return data_ ? (capacity_ + padding) * static_cast<long>(sizeof(T)) : 0; }
  T* data() { return written_here(), data_; }
  const T* data() const { return read_here(), data_; }
  T& operator[](long i) { return data()[i]; }
  const T& operator[](long i) const { return data()[i]; }
  T* begin() { return data(); }
  T* end() { return data() + size_; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size_; }

  // The same on the device: to be read, to be written too, to be written whole.
  const T* device_data() const {
    return data_ ? static_cast<const T*>(mirror_.device_reads(data_, bytes_held(), bytes_of(capacity_))) : nullptr;
  }
  T* device_data() {
    return data_ ? static_cast<T*>(mirror_.device_writes(data_, bytes_held(), bytes_of(capacity_))) : nullptr;
  }
  T* device_data_to_fill() {
    return data_ ? static_cast<T*>(mirror_.device_overwrites(data_, bytes_held(), bytes_of(capacity_))) : nullptr;
  }

  /// Brings parts to the host: PartsOnHost. False if there was nothing to bring.
  bool bring_parts(const RangeList& ranges) const { return mirror_.host_reads_parts(data_, sizeof(T), ranges); }
  Mirror& mirror() const { return mirror_; }

 private:
  size_t bytes_held() const { return static_cast<size_t>(size_) * sizeof(T); }
  /// Of memory for so many items, with the padding, in whole lines.
  static size_t bytes_of(long items) { return (static_cast<size_t>(items + padding) * sizeof(T) + 63) / 64 * 64; }

  // What is here is about to be read, or written.
  void read_here() const { mirror_.host_reads(data_, bytes_held()); }
  void written_here() { mirror_.host_writes(data_, bytes_held()); }

  static T* memory_for(long items) {
    T* fresh = static_cast<T*>(std::aligned_alloc(64, bytes_of(items)));
    if (!fresh)
      throw std::bad_alloc();
    return fresh;
  }
  void take(T* fresh, long items) {
    std::free(data_);
    data_ = fresh;
    capacity_ = items;
  }
  /// Nothing stays.
  void take_room_for(long items) { take(memory_for(items), items); }
  /// The items that there are stay, what is behind them is zero.
  void move_to_room_for(long items) {
    T* fresh = memory_for(items);
    const size_t keep = bytes_held();
    if (size_)
      std::memcpy(static_cast<void*>(fresh), data_, keep);
    std::memset(reinterpret_cast<char*>(fresh) + keep, 0, bytes_of(items) - keep);
    take(fresh, items);
  }

  T* data_ = nullptr;
  long size_ = 0;
  long capacity_ = 0;
  [[no_unique_address]] mutable Mirror mirror_;
};

inline namespace RIVEN_SIDE {

/// What kernels of this side work on: of a const array to be read, else to be written too.
template <class A>
auto* data(A& array) {
#if defined(RIVEN_ON_DEVICE)
  return array.device_data();
#else
  return array.data();
#endif
}
/// The same of an array that the kernel writes whole, and of which it reads nothing.
template <class T>
T* data_to_fill(Array<T>& array) {
#if defined(RIVEN_ON_DEVICE)
  return array.device_data_to_fill();
#else
  return array.data();
#endif
}
template <class T>
View<const T> view(const Array<T>& array) {
  return {data(array), array.size()};
}

}  // namespace RIVEN_SIDE

}  // namespace riven::exec
