#include "core/fracture/opening.hpp"

namespace riven {

Vec2 heading_of(const Cracks& cracks, const Tip& tip, bool first) {
  const exec::Array<Vec2>& at = first ? cracks.plane0 : cracks.plane;
  const Vec2 along = at[cracks.end_point(tip.crack, tip.last)] - at[cracks.next_to_end(tip.crack, tip.last)];
  return along * (1 / norm(along));
}

Vec2 opening_behind(const Cracks& cracks, const Tip& tip, double from, double to) {
  const Vec2 t = heading_of(cracks, tip), n = turned(t);
  const double side = tip.last ? 1 : -1;  // the upper surface is to the left of the crack's own direction
  const int end = cracks.end_point(tip.crack, tip.last), other = cracks.end_point(tip.crack, !tip.last);
  const int step = tip.last ? -1 : 1;
  Vec2 sum;
  int count = 0;
  const auto add = [&](int k) {
    const Vec2 gap = side * (cracks.upper[k] - cracks.lower[k]);
    sum += Vec2{dot(gap, n), dot(gap, t)};
    ++count;
  };
  double behind = 0;
  for (int k = end + step; k != other + step; k += step) {
    behind += norm(cracks.plane[k] - cracks.plane[k - step]);
    if (behind > to)
      break;
    if (behind >= from)
      add(k);
  }
  if (count == 0)
    add(end + step);
  return sum;
}

}  // namespace riven
