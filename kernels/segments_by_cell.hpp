// The segments of cracks by the cells that their middles are in.
#pragma once
#include <algorithm>
#include <numeric>
#include <vector>

#include "core/state/cracks.hpp"
#include "core/state/grid.hpp"
#include "kernels/cells_around.hpp"

namespace riven {

class SegmentsByCell {
 public:
  struct Entry {
    int cell, segment, crack;
  };

  template <class Shape>
  SegmentsByCell(const Shape&, const Lattice& l, const Cracks& cracks)
      : columns_(l.nx), rows_(l.ny), cell_(cracks.points(), -1) {
    const double inv = 1 / l.h;
    list_.reserve(cell_.size());
    for (int c = 0; c < cracks.count(); ++c)
      for (int k = cracks.start[c]; k + 1 < cracks.start[c + 1]; ++k) {
        const Vec2 a = cracks.plane[k], b = cracks.plane[k + 1];
        const int cell = cell_at<Shape>(l, (0.5 * (a + b) - l.origin) * inv);
        cell_[static_cast<size_t>(k)] = cell;
        if (cell >= 0 && cell < l.nodes())
          list_.push_back({cell, k, c});
        longest_ = std::max(longest_, norm(b - a));
      }
    // by row, and by column within it; segments of one cell stay in their order
    sort_by(columns_, [&](const Entry& e) { return e.cell % columns_; });
    row_ = sort_by(rows_, [&](const Entry& e) { return e.cell / columns_; });
  }

  /// The longest segment, m.
  double longest() const { return longest_; }

  /// Of the middle of a segment.
  int cell_of(int segment) const { return cell_[static_cast<size_t>(segment)]; }

  /// f(entry) for those in columns left .. right of row j; clipped to the lattice.
  template <class F>
  void each_of_row(int j, int left, int right, const F& f) const {
    if (j < 0 || j >= rows_)
      return;
    const Entry* end = list_.data() + row_[static_cast<size_t>(j) + 1];
    const int first = j * columns_ + std::max(left, 0), last = j * columns_ + std::min(right, columns_ - 1);
    for (const Entry *at = std::lower_bound(list_.data() + row_[static_cast<size_t>(j)], end, first,
                                            [](const Entry&e, int cell) { return e.cell < cell; });
         at != end && at->cell <= last; ++at)
      f(*at);
  }

 private:
  /// Sorts the list by a key in [0, n); entries of one key stay in their order. Returns where each key begins.
  template <class Key>
  std::vector<size_t> sort_by(int n, const Key& key) {
    std::vector<size_t> start(static_cast<size_t>(n) + 1);
    for (const Entry& e : list_)
      ++start[static_cast<size_t>(key(e)) + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<size_t> at = start;
    std::vector<Entry> sorted(list_.size());
    for (const Entry& e : list_)
      sorted[at[static_cast<size_t>(key(e))]++] = e;
    list_.swap(sorted);
    return start;
  }

  int columns_, rows_;
  double longest_ = 0;
  std::vector<int> cell_;    ///< [points] -1 where no segment begins
  std::vector<Entry> list_;  ///< by cell
  std::vector<size_t> row_;  ///< [rows + 1] where each begins in the list
};

}  // namespace riven
