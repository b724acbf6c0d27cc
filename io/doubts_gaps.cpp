// Notches and slots of a body that the grid does not see: particles on either side of a gap of less than two cells
// share nodes, and move as one. A saw cut of a cell that leads to a crack leaves 6 % of its K.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/fracture/crossing.hpp"
#include "core/state/grid.hpp"
#include "core/state/lay_points.hpp"
#include "io/checks.hpp"
#include "io/doubts.hpp"
#include "io/format_length.hpp"

namespace riven {

using namespace checks;

namespace {

constexpr double seen = 2;     // cells: the narrowest gap that is
constexpr double longest = 2;  // cells, along a gap that is not: the root of a notch, or a small hole

/// The empty places between two particles of a line, counted by the distance of particles.
struct Gap {
  long first, last;
  bool overlaps(const Gap& o) const { return first <= o.last && o.first <= last; }
};

/// Where particles lie along the lines of one axis.
class Lines {
 public:
  /// `along`: axis of the lines.
  Lines(const Scene& s, const std::vector<Vec2>& points, double spacing, int along)
      : s_(s), spacing_(spacing), along_(along) {
    taken_.reserve(points.size());
    for (const Vec2 x : points) {
      const Vec2 r = x - s.grid.lower;
      taken_.emplace_back(place(along == 0 ? r.y : r.x), place(along == 0 ? r.x : r.y));
    }
    std::sort(taken_.begin(), taken_.end());
  }

  /// The narrow gaps, through which no crack leads, of neighbouring lines that meet: in the middle of the longest row
  /// of more than `least` of them.
  std::optional<Vec2> middle_of_narrow(long most, long least) const {
    struct Row {
      long line;
      Gap gap;
      long length;
    };
    std::vector<Row> before, now;
    std::optional<Row> best;
    long line = 0;
    const auto consider = [&](long at, Gap gap) {
      if (gap.last - gap.first + 1 >= most || crossed(at, gap))
        return;
      if (at != line) {
        before = at == line + 1 ? std::exchange(now, {}) : std::vector<Row>{};
        now.clear();
        line = at;
      }
      Row row{at, gap, 1};
      for (const Row& r : before)
        if (r.gap.overlaps(gap))
          row.length = std::max(row.length, r.length + 1);
      now.push_back(row);
      if (row.length > least && (!best || row.length > best->length))
        best = row;
    };
    for (size_t k = 1; k < taken_.size(); ++k)
      if (const auto [at, place] = taken_[k - 1]; taken_[k].first == at && taken_[k].second > place + 1)
        consider(at, {place + 1, taken_[k].second - 1});
    if (!best)
      return std::nullopt;
    return position(best->line - best->length / 2, 0.5 * static_cast<double>(best->gap.first + best->gap.last));
  }

 private:
  long place(double x) const { return std::lround(x / spacing_ - 0.5); }
  Vec2 position(long line, double along) const {
    const double across = spacing_ * (static_cast<double>(line) + 0.5), at = spacing_ * (along + 0.5);
    return s_.grid.lower + (along_ == 0 ? Vec2{at, across} : Vec2{across, at});
  }
  bool crossed(long line, Gap gap) const {
    const Vec2 a = position(line, static_cast<double>(gap.first - 1)),
               b = position(line, static_cast<double>(gap.last + 1));
    for (const CrackLine& c : s_.cracks)
      for (size_t k = 0; k + 1 < c.points.size(); ++k)
        if (const Vec2 segment[2] = {c.points[k], c.points[k + 1]}; crossing(a, b, segment, true, true) != 0)
          return true;
    return false;
  }

  const Scene& s_;
  double spacing_;
  int along_;
  std::vector<std::pair<long, long>> taken_;  ///< lines, and places on them
};

}  // namespace

void doubt_gaps(const Scene& s, std::vector<Doubt>& list) {
  for (const Body& b : s.bodies) {
    if (b.holes.empty() && !std::holds_alternative<Polygon>(b.region))
      continue;
    const std::vector<Vec2> points =
        lay_points(b.region, b.holes, make_lattice(s.grid.lower, s.grid.upper, s.cell), b.particles_per_cell);
    const double spacing = s.cell / b.particles_per_cell;
    const auto cells = [&](double n) { return std::lround(n * b.particles_per_cell); };
    for (const int along : {0, 1})
      if (const auto at = Lines(s, points, spacing, along).middle_of_narrow(cells(seen), cells(longest))) {
        list.push_back({place(s, "body " + b.name),
                        fmt::format("a gap at ({:.4g}, {:.4g}) m is less than two cells wide: what is on either side "
                                    "of it moves as one",
                                    at->x, at->y),
                        "try smaller cells, or a crack drawn along it from the outside"});
        break;
      }
  }
}

}  // namespace riven
