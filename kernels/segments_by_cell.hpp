// The segments of cracks by the cells that their middles are in.
#pragma once
#include <algorithm>
#include <vector>

#include "core/state/cracks.hpp"
#include "core/state/grid.hpp"
#include "kernels/cells_around.hpp"

namespace riven {

class SegmentsByCell {
 public:
  struct Entry {
    int cell, segment;
    friend bool operator<(const Entry& a, const Entry& b) {
      return a.cell != b.cell ? a.cell < b.cell : a.segment < b.segment;
    }
  };

  template <class Shape>
  SegmentsByCell(const Shape&, const Lattice& l, const Cracks& cracks) : columns_(l.nx), cell_(cracks.points(), -1) {
    const double inv = 1 / l.h;
    for (int c = 0; c < cracks.count(); ++c)
      for (int k = cracks.start[c]; k + 1 < cracks.start[c + 1]; ++k) {
        const Vec2 X = (0.5 * (cracks.plane[k] + cracks.plane[k + 1]) - l.origin) * inv;
        cell_[static_cast<size_t>(k)] = cell_at<Shape>(l, X);
        list_.push_back({cell_[static_cast<size_t>(k)], k});
      }
    std::sort(list_.begin(), list_.end());
    row_.resize(static_cast<size_t>(l.ny) + 1);
    size_t at = 0;
    for (int j = 0; j <= l.ny; ++j) {
      while (at < list_.size() && list_[at].cell < j * l.nx)
        ++at;
      row_[static_cast<size_t>(j)] = at;
    }
  }

  /// Of the middle of a segment.
  int cell_of(int segment) const { return cell_[static_cast<size_t>(segment)]; }

  /// f(segment, cell) for those in columns left .. right of row j.
  template <class F>
  void each_of_row(int j, int left, int right, const F& f) const {
    const Entry* end = list_.data() + row_[static_cast<size_t>(j) + 1];
    const int last = j * columns_ + right;
    for (const Entry* at =
             std::lower_bound(list_.data() + row_[static_cast<size_t>(j)], end, Entry{last - right + left, 0});
         at != end && at->cell <= last; ++at)
      f(at->segment, at->cell);
  }

 private:
  int columns_;
  std::vector<int> cell_;    ///< [points] -1 where no segment begins
  std::vector<Entry> list_;  ///< by cell
  std::vector<size_t> row_;  ///< [rows + 1] where each begins in the list
};

}  // namespace riven
