// What the frames of a run have in common. A run that went on may have had other fields, or their precision, from then
// on; a file of all frames has the same arrays in each.
#pragma once
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "io/poly_data.hpp"

namespace riven {

/// Arrays of a group that all frames have, and as what: double where some are float and others not.
class CommonArrays {
 public:
  /// Takes note of the arrays of one more frame.
  void meet(std::vector<PolyArray> arrays) {
    if (std::exchange(first_, false))
      all_ = std::move(arrays);
    else
      std::erase_if(all_, [&](PolyArray& mine) {
        const PolyArray* other = named(mine.name, arrays);
        if (other && mine.holds<float>() && other->holds<double>())
          mine.data = std::vector<double>{};
        return !other || other->components != mine.components ||
               other->holds<std::int64_t>() != mine.holds<std::int64_t>();
      });
  }
  /// Keeps of the arrays what is common, as what is common.
  void keep(std::vector<PolyArray>& arrays) const {
    std::erase_if(arrays, [&](const PolyArray& a) { return !named(a.name, all_); });
    for (PolyArray& a : arrays)
      if (a.holds<float>() && named(a.name, all_)->holds<double>()) {
        a.data = std::vector<double>{};
        a.make = [of_float = a.make]() -> PolyValues {
          const auto values = std::get<std::vector<float>>(of_float());
          return std::vector<double>(values.begin(), values.end());
        };
      }
  }

 private:
  static const PolyArray* named(const std::string& name, const std::vector<PolyArray>& arrays) {
    const auto at = std::find_if(arrays.begin(), arrays.end(), [&](const PolyArray& a) { return a.name == name; });
    return at == arrays.end() ? nullptr : &*at;
  }

  std::vector<PolyArray> all_;
  bool first_ = true;
};

}  // namespace riven
