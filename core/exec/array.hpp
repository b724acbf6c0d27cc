// Array owns memory; View is what a kernel takes: a pointer and a length, trivially copyable.
#pragma once
#include <cstdlib>
#include <cstring>
#include <new>
#include <type_traits>
#include <utility>

#include "core/exec/config.hpp"

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
  static constexpr long padding = 2 * lanes;

  Array() = default;
  explicit Array(long n) { resize(n); }
  Array(const Array& o) { *this = o; }
  Array(Array&& o) noexcept { swap(o); }
  Array& operator=(const Array& o) {
    if (this == &o)
      return *this;
    resize(o.size_);
    if (size_)
      std::memcpy(static_cast<void*>(data_), o.data_, static_cast<size_t>(size_) * sizeof(T));
    return *this;
  }
  Array& operator=(Array&& o) noexcept { return swap(o), *this; }
  ~Array() { std::free(data_); }

  /// New size; the items that fit are kept, new ones are zero.
  void resize(long n) {
    if (n > capacity_ || !data_)
      move_to_room_for(n > capacity_ + capacity_ / 2 ? n : capacity_ + capacity_ / 2);
    else if (n > size_)
      std::memset(static_cast<void*>(data_ + size_), 0, static_cast<size_t>(n - size_) * sizeof(T));
    size_ = n;
  }
  /// Room for n items and no more, where there is not as much: for large arrays that grow by little.
  void reserve(long n) {
    if (n > capacity_)
      move_to_room_for(n);
  }
  void clear() { resize(0); }
  void zero() {
    if (size_)
      std::memset(static_cast<void*>(data_), 0, static_cast<size_t>(size_) * sizeof(T));
  }
  void swap(Array& o) noexcept {
    std::swap(data_, o.data_);
    std::swap(size_, o.size_);
    std::swap(capacity_, o.capacity_);
  }

  long size() const { return size_; }
  long capacity() const { return capacity_; }
  bool empty() const { return size_ == 0; }
  long bytes() const { return data_ ? (capacity_ + padding) * static_cast<long>(sizeof(T)) : 0; }
  T* data() { return data_; }
  const T* data() const { return data_; }
  T& operator[](long i) { return data_[i]; }
  const T& operator[](long i) const { return data_[i]; }
  T* begin() { return data_; }
  T* end() { return data_ + size_; }
  const T* begin() const { return data_; }
  const T* end() const { return data_ + size_; }
  View<T> view() { return {data_, size_}; }
  View<const T> view() const { return {data_, size_}; }

 private:
  /// The items that there are stay, what is behind them is zero.
  void move_to_room_for(long items) {
    const size_t bytes = (static_cast<size_t>(items + padding) * sizeof(T) + 63) / 64 * 64;
    T* fresh = static_cast<T*>(std::aligned_alloc(64, bytes));
    if (!fresh)
      throw std::bad_alloc();
    const size_t keep = static_cast<size_t>(size_) * sizeof(T);
    if (size_)
      std::memcpy(static_cast<void*>(fresh), data_, keep);
    std::memset(reinterpret_cast<char*>(fresh) + keep, 0, bytes - keep);
    std::free(data_);
    data_ = fresh;
    capacity_ = items;
  }

  T* data_ = nullptr;
  long size_ = 0;
  long capacity_ = 0;
};

}  // namespace riven::exec
