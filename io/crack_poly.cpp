#include <algorithm>
#include <cmath>

#include "core/state/bodies_at_cracks.hpp"
#include "core/state/tractions.hpp"
#include "io/crack_opening.hpp"
#include "io/frames.hpp"

namespace riven {

std::vector<CrackOpening> crack_openings(const Cracks& cracks) {
  std::vector<CrackOpening> all(static_cast<std::size_t>(cracks.points()));
  for (int i = 0; i < cracks.points(); ++i) {
    const FacePair opening = face_opening(cracks, i);
    all[static_cast<std::size_t>(i)] = {cracks.upper[i] - cracks.lower[i], opening.normal, opening.sliding};
  }
  return all;
}

double extreme_opening(const Scene& scene, const Cracks& cracks, int crack) {
  const std::vector<CrackOpening> all = crack_openings(cracks);
  double extreme = 0;
  for (int i = cracks.start[crack]; i < cracks.start[crack + 1]; ++i)
    if (std::abs(all[static_cast<std::size_t>(i)].normal) > std::abs(extreme) && has_solid_beside(scene, cracks, i))
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
    d.offsets.push_back(cracks.start[c + 1]);
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
  if (!cracks.traction.empty()) {
    std::vector<double> damage, taken;
    for (int i = 0; i < n; ++i) {
      damage.push_back(std::min(cracks.cohesive[i].worst, 1.0));
      taken.push_back(cracks.cohesive[i].dissipated);
    }
    PolyArray traction = vectors("traction", [&](int i) { return traction_on(cracks, i); });
    traction.unit = "Pa";
    d.point_arrays.insert(d.point_arrays.end(),
                          {traction, {"softening", 1, "", damage}, {"dissipated", 1, "J/m^2", taken}});
  }
  d.cell_arrays = {{"crack", 1, "", of_cell}};
  return d;
}

}  // namespace riven
