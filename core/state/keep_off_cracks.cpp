#include "core/state/keep_off_cracks.hpp"

#include <algorithm>
#include <cmath>

namespace riven {

namespace {

constexpr double clear = 0.05;  ///< cells, from a crack to the nearest particle of a body that ends there
constexpr double beside = 0.1;  ///< cells, from a crack to where is seen what is there

}  // namespace

KeepOffCracks::KeepOffCracks(const Cracks& cracks, const Lattice& lattice) : cracks_(cracks), lattice_(lattice) {
  const double near = clear * lattice.h;
  for (int c = 0; c < cracks.count(); ++c)
    for (int k = cracks.end_point(c, false); k < cracks.end_point(c, true); ++k) {
      const Vec2 a = cracks.plane0[k], b = cracks.plane0[k + 1];
      for (int j = row(std::min(a.y, b.y) - near); j <= row(std::max(a.y, b.y) + near); ++j)
        for (int i = column(std::min(a.x, b.x) - near); i <= column(std::max(a.x, b.x) + near); ++i)
          segments_[cell(i, j)].push_back(k);
    }
}

int KeepOffCracks::column(double x) const {
  return static_cast<int>(std::floor((x - lattice_.origin.x) / lattice_.h));
}
int KeepOffCracks::row(double y) const {
  return static_cast<int>(std::floor((y - lattice_.origin.y) / lattice_.h));
}
long KeepOffCracks::cell(int i, int j) const {
  return long{j} * lattice_.nx + i;
}

Vec2 KeepOffCracks::from(Vec2 x, const std::function<bool(Vec2)>& holds) const {
  const auto near = segments_.find(cell(column(x.x), row(x.y)));
  if (near == segments_.end())
    return x;
  const double h = lattice_.h;
  for (const int k : near->second) {
    const Vec2 a = cracks_.plane0[k], along = cracks_.plane0[k + 1] - a;
    const double length = norm(along), t = length > 0 ? dot(x - a, along) / (length * length) : -1;
    if (t < 0 || t > 1)
      continue;
    const Vec2 up = (1 / length) * turned(along), foot = a + t * along;
    if (std::abs(dot(x - foot, up)) >= clear * h)
      continue;
    const bool above = holds(foot + beside * h * up), below = holds(foot - beside * h * up);
    if (above != below)
      return foot + (above ? clear : -clear) * h * up;
  }
  return x;
}

}  // namespace riven
