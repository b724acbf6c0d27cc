#include "core/state/bodies_at_cracks.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/state/make_tips.hpp"

namespace riven {

namespace {

constexpr double beside = 0.1;  ///< cells from a crack along the border of a body to where that is looked for

/// The mean density in the reach of a face at x, out along `way`, weighed about as nodes weigh particles; 0 where there
/// is no body.
double density_beside(const Scene& scene, Vec2 x, Vec2 way) {
  double sum = 0, weights = 0;
  for (const auto& [cells, weight] : {std::pair{0.25, 3.}, {0.75, 2.}, {1.25, 1.}})
    if (const int b = body_at(scene, x + (cells * scene.cell) * way); b >= 0) {
      const Body& body = scene.bodies[static_cast<size_t>(b)];
      sum += weight * scene.materials[static_cast<size_t>(body.material)].density;
      weights += weight;
    }
  return weights > 0 ? sum / weights : 0;
}

/// Across a crack at one of its points, upwards, of unit length.
Vec2 upwards(const Cracks& cracks, int k) {
  const int crack = cracks.crack[k], before = std::max(k - 1, cracks.end_point(crack, false)),
            next = std::min(k + 1, cracks.end_point(crack, true));
  const Vec2 along = cracks.plane0[next] - cracks.plane0[before];
  const double length = norm(along);
  return length > 0 ? (1 / length) * turned(along) : Vec2{};
}

/// Above (x) and below (y) a point of a crack.
Vec2 densities(const Scene& scene, const Cracks& cracks, int k) {
  const Vec2 up = upwards(cracks, k);
  return {density_beside(scene, cracks.plane0[k], up), density_beside(scene, cracks.plane0[k], -up)};
}

/// Share of the line from a to b that lies in a body, or along the border of one.
double share_in_bodies(const Scene& scene, Vec2 a, Vec2 b) {
  constexpr int samples = 32;
  const Vec2 along = b - a;
  const double length = norm(along);
  const Vec2 aside = length > 0 ? (beside * scene.cell / length) * turned(along) : Vec2{};
  int inside = 0;
  for (int i = 0; i < samples; ++i) {
    const Vec2 x = a + ((i + 0.5) / samples) * along;
    inside += body_at(scene, x + aside) >= 0 || body_at(scene, x - aside) >= 0;
  }
  return double(inside) / samples;
}

void take_from(Vec2 other, Vec2& own) {
  own = {own.x > 0 ? own.x : other.x, own.y > 0 ? own.y : other.y};
}

}  // namespace

void lay_densities(const Scene& scene, Cracks& cracks) {
  const auto density = [&](const Body& b) { return scene.materials[static_cast<size_t>(b.material)].density; };
  if (std::all_of(scene.bodies.begin(), scene.bodies.end(),
                  [&](const Body& b) { return density(b) == density(scene.bodies[0]); }))
    return;
  cracks.density.resize(cracks.points());
  for (int c = 0; c < cracks.count(); ++c) {
    const int first = cracks.end_point(c, false), last = cracks.end_point(c, true);
    for (int k = first; k <= last; ++k)
      cracks.density[k] = densities(scene, cracks, k);
    for (int k = first; k < last; ++k)
      take_from(cracks.density[k], cracks.density[k + 1]);
    for (int k = last; k > first; --k)
      take_from(cracks.density[k], cracks.density[k - 1]);
  }
}

bool has_solid_beside(const Scene& scene, const Cracks& cracks, int k) {
  if (!cracks.gap.empty() && std::isfinite(cracks.gap[k].x) && std::isfinite(cracks.gap[k].y))
    return true;
  const Vec2 x = cracks.plane0[k], aside = beside * scene.cell * upwards(cracks, k), along = turned(aside);
  for (const Vec2 at : {x + aside + along, x + aside - along, x - aside + along, x - aside - along})
    if (body_at(scene, at) >= 0)
      return true;
  return false;
}

void lay_in_solid(const Scene& scene, Cracks& cracks) {
  const auto is = [](const ContactSettings& c) { return c.law == ContactLaw::interface; };
  if (std::none_of(cracks.contact.begin(), cracks.contact.end(), is))
    return;
  cracks.in_solid.resize(cracks.points());
  for (int c = 0; c < cracks.count(); ++c)
    for (int k = cracks.end_point(c, false); k < cracks.end_point(c, true); ++k)
      cracks.in_solid[k] = share_in_bodies(scene, cracks.plane0[k], cracks.plane0[k + 1]);
}

void lay_density_at_end(const Scene& scene, int crack, bool last, Cracks& cracks) {
  if (cracks.density.empty())
    return;
  const int k = cracks.end_point(crack, last);
  cracks.density[k] = densities(scene, cracks, k);
  take_from(cracks.density[cracks.next_to_end(crack, last)], cracks.density[k]);
}

}  // namespace riven
