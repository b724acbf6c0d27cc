// Points with cells and named arrays: what every writer of frames takes. Plain data, always 3 coordinates.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

namespace riven {

using PolyValues = std::variant<std::vector<double>, std::vector<std::int64_t>, std::vector<float>>;

/// One value per point or per cell: rows of `components` numbers. The name holds neither '/' nor '.'.
struct PolyArray {
  std::string name;
  int components = 1;
  std::string unit;  ///< SI; empty where there is none
  PolyValues data;
  /// Makes the values, where they are many, each time that they are wanted; `data` then only says of which type they
  /// are. A frame of particles takes more memory than their state does, one array of it at a time a sixth of that.
  std::function<PolyValues()> make = {};

  template <class T>
  bool holds() const {
    return std::holds_alternative<std::vector<T>>(data);
  }
  /// f(vector of the values).
  template <class F>
  void visit(const F& f) const {
    if (make)
      std::visit(f, make());
    else
      std::visit(f, data);
  }
  /// From now on holds the values.
  void settle() {
    if (make)
      data = make();
    make = {};
  }
};

/// Cells are all vertices or all lines. Cell c joins the points connectivity[offsets[c]] up to, not including,
/// connectivity[offsets[c + 1]].
struct PolyData {
  enum class Cells { vertices, lines };

  std::vector<double> points;  ///< x y z of each point, m
  Cells kind = Cells::vertices;
  std::vector<std::int64_t> connectivity;
  std::vector<std::int64_t> offsets{0};
  std::vector<PolyArray> point_arrays, cell_arrays;

  std::int64_t point_count() const { return static_cast<std::int64_t>(points.size() / 3); }
  std::int64_t cell_count() const { return static_cast<std::int64_t>(offsets.size()) - 1; }
};

}  // namespace riven
