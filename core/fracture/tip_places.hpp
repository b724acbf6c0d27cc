// Where tips are, and which of them are near a place.
#pragma once
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/math/vec.hpp"

namespace riven {

class TipPlaces {
 public:
  TipPlaces() = default;
  /// `places`: m, [tips]
  explicit TipPlaces(std::vector<Vec2> places) : places_(std::move(places)), by_x_(places_.size()) {
    for (size_t k = 0; k < by_x_.size(); ++k)
      by_x_[k] = {places_[k].x, k};
    std::sort(by_x_.begin(), by_x_.end());
  }

  Vec2 operator[](size_t tip) const { return places_[tip]; }

  /// f(tip) for those that are less than `far` from x along either axis, from left to right.
  template <class F>
  void each_near(Vec2 x, double far, const F& f) const {
    const auto first = std::lower_bound(by_x_.begin(), by_x_.end(), std::pair<double, size_t>{x.x - far, 0});
    for (auto at = first; at != by_x_.end() && at->first < x.x + far; ++at)
      if (std::fabs(places_[at->second].y - x.y) < far)
        f(at->second);
  }

 private:
  std::vector<Vec2> places_;
  std::vector<std::pair<double, size_t>> by_x_;  ///< tips from left to right
};

}  // namespace riven
