// Points with cells and named arrays: what every writer of frames takes. Plain data, always 3 coordinates.
#pragma once
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace riven {

/// One value per point or per cell: rows of `components` numbers. The name holds neither '/' nor '.'.
struct PolyArray {
  std::string name;
  int components = 1;
  std::string unit;  ///< SI; empty where there is none
  std::variant<std::vector<double>, std::vector<std::int64_t>> data;

  std::size_t size() const {
    return std::visit([](const auto& v) { return v.size(); }, data);
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
