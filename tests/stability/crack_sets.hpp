// Random sets of cracks in a plate of 40 x 40 cells of 1 m.
#pragma once
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "tests/physics/scenes.hpp"

namespace riven::hard_cases {

constexpr double plate_edge = 40;

/// Lays cracks of one seed.
class CrackSet {
 public:
  explicit CrackSet(std::uint64_t seed) : random_(seed) {}

  /// 2 to 40 cracks that cross, touch, run side by side, bend, or meet in stars; of half of the sets the ends lie on
  /// eighths of a cell, and so on nodes, edges and rows of particles.
  std::vector<CrackLine> lay() {
    on_eighths_ = pick(0, 1) == 0;
    const auto count = static_cast<size_t>(pick(2, 40));
    while (cracks_.size() < count)
      switch (pick(0, 5)) {
        case 0: add({anywhere(), anywhere()}); break;
        case 1: cross(); break;
        case 2: touch(); break;
        case 3: side_by_side(); break;
        case 4: bend(); break;
        default: meet(std::min(static_cast<size_t>(pick(3, 5)), count - cracks_.size())); break;
      }
    cracks_.resize(count);
    return std::move(cracks_);
  }

  int pick(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  double real(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

 private:
  Vec2 anywhere() { return {real(-2, plate_edge + 2), real(-2, plate_edge + 2)}; }
  Vec2 away(double least, double most) {
    const double angle = real(0, 2 * std::numbers::pi), length = real(least, most);
    return length * Vec2{std::cos(angle), std::sin(angle)};
  }
  void add(std::vector<Vec2> points) {
    for (Vec2& p : points) {
      if (on_eighths_)
        p = {std::round(8 * p.x) / 8, std::round(8 * p.y) / 8};
      p = {std::clamp(p.x, -2., plate_edge + 2), std::clamp(p.y, -2., plate_edge + 2)};
    }
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() > 1)
      cracks_.push_back(test::crack(("crack " + std::to_string(cracks_.size())).c_str(), points));
  }
  Vec2 on_another() {
    const auto& points = cracks_[static_cast<size_t>(pick(0, static_cast<int>(cracks_.size()) - 1))].points;
    const auto k = static_cast<size_t>(pick(0, static_cast<int>(points.size()) - 2));
    return points[k] + real(0, 1) * (points[k + 1] - points[k]);
  }
  void cross() {
    const Vec2 middle = cracks_.empty() ? anywhere() : on_another(), arm = away(2, 8);
    add({middle - arm, middle + real(0.3, 1) * arm});
  }
  void touch() {
    const Vec2 end = cracks_.empty() ? anywhere() : on_another();
    add({end, end + away(2, 10)});
  }
  void side_by_side() {
    const Vec2 from = anywhere(), arm = away(3, 12);
    const Vec2 beside = real(0.25, 1.5) * (1 / norm(arm)) * turned(arm);
    add({from, from + arm});
    add({from + beside, from + beside + arm});
  }
  void bend() {
    std::vector<Vec2> points{anywhere()};
    for (int k = pick(2, 8); k > 0; --k)
      points.push_back(points.back() + away(0.3, 4));
    add(points);
  }
  void meet(size_t arms) {
    const Vec2 middle = anywhere();
    for (size_t k = 0; k < arms; ++k)
      add({middle, middle + away(2, 10)});
  }

  std::mt19937_64 random_;
  std::vector<CrackLine> cracks_;
  bool on_eighths_ = false;
};

}  // namespace riven::hard_cases
