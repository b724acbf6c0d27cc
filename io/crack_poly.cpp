#include <cmath>

#include "io/crack_opening.hpp"
#include "io/frames.hpp"

namespace riven {

std::vector<CrackOpening> crack_openings(const Cracks& cracks) {
  std::vector<CrackOpening> all(static_cast<std::size_t>(cracks.points()));
  for (int c = 0; c < cracks.count(); ++c) {
    const int first = cracks.start[static_cast<std::size_t>(c)], end = cracks.start[static_cast<std::size_t>(c) + 1];
    for (int i = first; i < end; ++i) {
      const Vec2 along = cracks.plane[i + 1 < end ? i + 1 : i] - cracks.plane[i > first ? i - 1 : i];
      const double length = norm(along);
      const Vec2 tangent = length > 0 ? along * (1 / length) : Vec2{};
      const Vec2 opening = cracks.upper[i] - cracks.lower[i];
      all[static_cast<std::size_t>(i)] = {opening, dot(opening, turned(tangent)), dot(opening, tangent)};
    }
  }
  return all;
}

double extreme_opening(const Cracks& cracks, int crack) {
  const std::vector<CrackOpening> all = crack_openings(cracks);
  double extreme = 0;
  for (int i = cracks.start[static_cast<std::size_t>(crack)]; i < cracks.start[static_cast<std::size_t>(crack) + 1];
       ++i)
    if (std::abs(all[static_cast<std::size_t>(i)].normal) > std::abs(extreme))
      extreme = all[static_cast<std::size_t>(i)].normal;
  return extreme;
}

PolyData crack_poly(const Cracks& cracks) {
  const int n = cracks.points();
  PolyData d;
  d.kind = PolyData::Cells::lines;
  std::vector<std::int64_t> of_point, of_cell;
  for (int i = 0; i < n; ++i) {
    d.connectivity.push_back(i);
    of_point.push_back(cracks.crack[i]);
  }
  for (int c = 0; c < cracks.count(); ++c) {
    d.offsets.push_back(cracks.start[static_cast<std::size_t>(c) + 1]);
    of_cell.push_back(c);
  }

  const auto vectors = [&](std::string name, auto&& at) {
    std::vector<double> out;
    out.reserve(3 * static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) {
      const Vec2 v = at(i);
      out.insert(out.end(), {v.x, v.y, 0.0});
    }
    return PolyArray{std::move(name), 3, "m", std::move(out)};
  };
  d.points = std::get<std::vector<double>>(vectors("", [&](int i) { return cracks.plane[i]; }).data);

  const std::vector<CrackOpening> openings = crack_openings(cracks);
  std::vector<double> normal, sliding;
  for (const CrackOpening& o : openings) {
    normal.push_back(o.normal);
    sliding.push_back(o.sliding);
  }
  d.point_arrays = {{"crack", 1, "", of_point},
                    vectors("first_position", [&](int i) { return cracks.plane0[i]; }),
                    vectors("upper", [&](int i) { return cracks.upper[i]; }),
                    vectors("lower", [&](int i) { return cracks.lower[i]; }),
                    vectors("opening", [&](int i) { return openings[static_cast<std::size_t>(i)].vector; }),
                    {"normal_opening", 1, "m", normal},
                    {"sliding", 1, "m", sliding}};
  d.cell_arrays = {{"crack", 1, "", of_cell}};
  return d;
}

}  // namespace riven
