// A counting iterator for std::execution algorithms (C++20's iota view has one, but its iterators are
// not Cpp17RandomAccess and libstdc++'s parallel algorithms would run them serially).
#pragma once
#include <compare>
#include <iterator>

namespace riven::exec {

struct Counting {
  using iterator_category = std::random_access_iterator_tag;
  using value_type = long;
  using difference_type = long;
  using pointer = const long*;
  using reference = long;

  long i = 0;

  long operator*() const { return i; }
  long operator[](long d) const { return i + d; }
  Counting& operator++() { return ++i, *this; }
  Counting operator++(int) { return Counting{i++}; }
  Counting& operator--() { return --i, *this; }
  Counting operator--(int) { return Counting{i--}; }
  Counting& operator+=(long d) { return i += d, *this; }
  Counting& operator-=(long d) { return i -= d, *this; }
  friend Counting operator+(Counting a, long d) { return {a.i + d}; }
  friend Counting operator+(long d, Counting a) { return {a.i + d}; }
  friend Counting operator-(Counting a, long d) { return {a.i - d}; }
  friend long operator-(Counting a, Counting b) { return a.i - b.i; }
  friend std::strong_ordering operator<=>(Counting a, Counting b) { return a.i <=> b.i; }
  friend bool operator==(Counting a, Counting b) = default;
};

}  // namespace riven::exec
