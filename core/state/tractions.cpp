#include "core/state/tractions.hpp"

#include <algorithm>
#include <cmath>

#include "core/state/make_tips.hpp"

namespace riven {

namespace {

/// Thickness of the solid at a point, m; 0 outside of all bodies.
double thickness_at(const Scene& scene, Vec2 x) {
  const int b = body_at(scene, x);
  const double own = b < 0 ? 0 : scene.bodies[static_cast<size_t>(b)].thickness;
  return b < 0 ? 0 : own > 0 ? own : scene.thickness;
}

/// Mean thickness that bears the tractions from a to b.
double mean_bearing(const Scene& scene, const TractionSettings& settings, Vec2 a, Vec2 b) {
  constexpr int samples = 32;
  double sum = 0;
  for (int i = 0; i < samples; ++i) {
    const Vec2 x = a + ((i + 0.5) / samples) * (b - a);
    if (!settings.region || contains(*settings.region, x))
      sum += thickness_at(scene, x);
  }
  return sum / samples;
}

const TractionLaw* law_at(const Cracks& cracks, int point) {
  if (cracks.traction.empty() || (cracks.bearing[point].x == 0 && cracks.bearing[point].y == 0))
    return nullptr;
  return &cracks.traction[static_cast<size_t>(cracks.crack[point])].law;
}

struct Ends {
  int first, last;
};
Ends ends_of(const Cracks& cracks, int point) {
  const int c = cracks.crack[point];
  return {cracks.start[c], cracks.start[c + 1] - 1};
}

FacePair in_frame(const Cracks& cracks, int point, Vec2 opening) {
  const CrackFrame f = crack_frame(cracks, point);
  return {dot(opening, f.left), dot(opening, f.along)};
}

}  // namespace

CrackFrame crack_frame(const Cracks& cracks, int point) {
  const Ends e = ends_of(cracks, point);
  const Vec2 d = cracks.plane[std::min(point + 1, e.last)] - cracks.plane[std::max(point - 1, e.first)];
  const double length = norm(d);
  const Vec2 along = length > 0 ? d * (1 / length) : Vec2{};
  return {along, turned(along)};
}

FacePair face_opening(const Cracks& cracks, int point) {
  FacePair opening = in_frame(cracks, point, cracks.upper[point] - cracks.lower[point]);
  if (const double gap = cracks.gap.empty() ? 0 : cracks.gap[point].x + cracks.gap[point].y; std::isfinite(gap))
    opening.normal += gap;
  return opening;
}

FacePair law_opening(const Cracks& cracks, int point) {
  Vec2 opening = cracks.upper[point] - cracks.lower[point];
  if (cracks.lead > 0)
    opening += cracks.lead * (cracks.upper_velocity[point] - cracks.lower_velocity[point]);
  return in_frame(cracks, point, opening);
}

double face_area(const Cracks& cracks, int point) {
  if (!law_at(cracks, point))
    return 0;
  const Ends e = ends_of(cracks, point);
  const Vec2 bearing = cracks.bearing[point];
  const double before = point > e.first ? norm(cracks.plane[point] - cracks.plane[point - 1]) : 0;
  const double after = point < e.last ? norm(cracks.plane[point + 1] - cracks.plane[point]) : 0;
  return 0.5 * (before * bearing.x + after * bearing.y);
}

Vec2 traction_on(const Cracks& cracks, int point) {
  const TractionLaw* law = law_at(cracks, point);
  if (!law)
    return {};
  const CrackFrame f = crack_frame(cracks, point);
  const FacePair T = law->traction(law_opening(cracks, point), cracks.cohesive[point]);
  return -T.normal * f.left - T.sliding * f.along;
}

double stored_energy(const Cracks& cracks, int point) {
  const TractionLaw* law = law_at(cracks, point);
  return law ? law->stored(law_opening(cracks, point), cracks.cohesive[point]) : 0;
}

double dissipated_energy(const Cracks& cracks, int point) {
  return cracks.cohesive.empty() ? 0 : cracks.cohesive[point].dissipated;
}

double cohesive_energy(const Cracks& cracks) {
  double sum = 0;
  for (int k = 0; k < cracks.points(); ++k) {
    const TractionLaw* law = law_at(cracks, k);
    if (law && law->kind == TractionLaw::Kind::cohesive)
      sum += face_area(cracks, k) * stored_energy(cracks, k);
  }
  return sum;
}

void lay_tractions(const Scene& scene, Cracks& cracks) {
  cracks.cohesive.resize(cracks.points());
  cracks.bearing.resize(cracks.points());
  for (int c = 0; c < cracks.count(); ++c) {
    const std::optional<TractionSettings>& settings = scene.cracks[static_cast<size_t>(c)].traction;
    cracks.traction.push_back({});
    if (!settings)
      continue;
    cracks.traction.back() = {settings->pressure, TractionLaw(*settings)};
    for (int k = cracks.start[c]; k < cracks.start[c + 1]; ++k) {
      const Vec2 x = cracks.plane[k];
      // at an end the missing segment counts as lying in the same solid, should the crack grow
      const bool first = k == cracks.start[c], last = k + 1 == cracks.start[c + 1];
      const Vec2 before = first ? x : 0.5 * (x + cracks.plane[k - 1]),
                 after = last ? x : 0.5 * (x + cracks.plane[k + 1]);
      cracks.bearing[k] = {mean_bearing(scene, *settings, x, first ? after : before),
                           mean_bearing(scene, *settings, x, last ? before : after)};
    }
  }
}

void lay_traction_at_end(const Scene& scene, int crack, bool last, Cracks& cracks) {
  const std::optional<TractionSettings>& settings = scene.cracks[static_cast<size_t>(crack)].traction;
  if (!settings || !settings->region)
    return;
  const int end = cracks.end_point(crack, last), next = cracks.next_to_end(crack, last);
  const Vec2 from = cracks.plane0[next], to = cracks.plane0[end], middle = 0.5 * (from + to);
  Vec2& inner = cracks.bearing[next];
  (last ? inner.y : inner.x) = mean_bearing(scene, *settings, from, middle);
  const double bears = mean_bearing(scene, *settings, middle, to);
  cracks.bearing[end] = {bears, bears};
}

}  // namespace riven
