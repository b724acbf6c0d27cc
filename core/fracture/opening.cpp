#include "core/fracture/opening.hpp"

#include <algorithm>
#include <cmath>

namespace riven {

Vec2 heading_of(const Cracks& cracks, const Tip& tip, bool first) {
  const exec::Array<Vec2>& at = first ? cracks.plane0 : cracks.plane;
  const Vec2 along = at[cracks.end_point(tip.crack, tip.last)] - at[cracks.next_to_end(tip.crack, tip.last)];
  return along * (1 / norm(along));
}

namespace {

/// Cells behind the tip between which points are fitted, and from which on they are averaged where a crack is short.
/// A tenth of a cell less and more than said, as crack points are about half a cell apart and move a little.
constexpr double fit_from = 1.4, fit_to = 4.1, near_from = 0.9;

/// Sums of least squares for y = a + b r.
struct LineFit {
  int count = 0;
  double r = 0, rr = 0;
  Vec2 y, ry;

  void add(double at, Vec2 value) {
    ++count;
    r += at;
    rr += at * at;
    y += value;
    ry += at * value;
  }
  /// At r = 0. Needs points apart from each other.
  Vec2 start() const { return (rr * y - r * ry) * (1 / (count * rr - r * r)); }
  Vec2 mean() const { return y * (1.0 / std::max(1, count)); }
};

}  // namespace

Vec2 opening_behind(const Cracks& cracks, const Tip& tip, double h, double whole) {
  const Vec2 t = heading_of(cracks, tip), n = turned(t);
  const double side = tip.last ? 1 : -1;  // the upper surface is to the left of the crack's own direction
  const int end = cracks.end_point(tip.crack, tip.last), other = cracks.end_point(tip.crack, !tip.last);
  const int step = tip.last ? -1 : 1;
  LineFit fit, near, next;
  double behind = 0;
  for (int k = end + step; k != other; k += step) {
    behind += norm(cracks.plane[k] - cracks.plane[k - step]);
    if (behind > fit_to * h || behind > whole)
      break;
    const Vec2 gap = (side / std::sqrt(behind)) * (cracks.upper[k] - cracks.lower[k]);
    const Vec2 opening{dot(gap, n), dot(gap, t)};
    if (next.count == 0)
      next.add(behind, opening);
    if (behind >= near_from * h)
      near.add(behind, opening);
    if (behind >= fit_from * h)
      fit.add(behind, opening);
  }
  if (fit.count > 2 && behind > fit_to * h)
    return fit.start();
  return near.count > 0 ? near.mean() : next.mean();
}

}  // namespace riven
