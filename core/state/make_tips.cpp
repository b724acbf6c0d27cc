#include "core/state/make_tips.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

namespace riven {

namespace {

bool well_inside(const Scene& scene, Vec2 x, double radius) {
  constexpr int directions = 16;
  for (int i = 0; i < directions; ++i) {
    const double angle = 2 * std::numbers::pi * i / directions;
    if (body_at(scene, x + radius * Vec2{std::cos(angle), std::sin(angle)}) < 0)
      return false;
  }
  return true;
}

double distance(Vec2 x, Vec2 a, Vec2 b) {
  const Vec2 d = b - a;
  const double length2 = dot(d, d), t = length2 > 0 ? std::clamp(dot(x - a, d) / length2, 0., 1.) : 0;
  return norm(x - a - t * d);
}

int body_of_tip(const Scene& scene, Vec2 x) {
  int body = body_at(scene, x);
  const double near = border_width * scene.cell / scene.bodies[static_cast<size_t>(body)].particles_per_cell;
  constexpr int directions = 8;
  for (int i = 0; i < directions; ++i) {
    const double angle = 2 * std::numbers::pi * i / directions;
    const int other = body_at(scene, x + near * Vec2{std::cos(angle), std::sin(angle)});
    if (other >= 0 && weaker(scene, other, body))
      body = other;
  }
  return body;
}

/// Whether the end of a crack comes nearer than `radius` to another one, or to itself further along.
bool on_crack(const Scene& scene, size_t crack, bool last, double radius) {
  std::vector<Vec2> own = scene.cracks[crack].points;
  if (last)
    std::reverse(own.begin(), own.end());
  const Vec2 x = own.front();
  double along = 0;
  for (size_t k = 0; k + 1 < own.size(); ++k) {
    if (along > 4 * radius && distance(x, own[k], own[k + 1]) < radius)
      return true;
    along += norm(own[k + 1] - own[k]);
  }
  for (size_t c = 0; c < scene.cracks.size(); ++c)
    for (size_t k = 0; c != crack && k + 1 < scene.cracks[c].points.size(); ++k)
      if (distance(x, scene.cracks[c].points[k], scene.cracks[c].points[k + 1]) < radius)
        return true;
  return false;
}

}  // namespace

int body_at(const Scene& scene, Vec2 x) {
  const auto in = [&](const Region& r) { return contains(r, x); };
  for (size_t b = 0; b < scene.bodies.size(); ++b)
    if (in(scene.bodies[b].region) && std::none_of(scene.bodies[b].holes.begin(), scene.bodies[b].holes.end(), in))
      return static_cast<int>(b);
  return -1;
}

bool weaker(const Scene& scene, int body, int than) {
  const auto material = [&](int b) -> const Material& {
    return scene.materials[static_cast<size_t>(scene.bodies[static_cast<size_t>(b)].material)];
  };
  const auto known = [](double toughness) { return toughness > 0 ? toughness : std::numeric_limits<double>::max(); };
  const auto strength = [&](const Material& m) {
    return std::tuple(known(m.K_Ic), known(m.J_Ic), m.E, m.nu, m.density);
  };
  return strength(material(body)) < strength(material(than));
}

double junction_reach(const Scene& scene, int body) {
  // a little less than half a particle, so that an end exactly as far from an edge is a tip whatever rounding does
  return 0.499 * scene.cell / scene.bodies[static_cast<size_t>(body)].particles_per_cell;
}

CrackEnd end_of(const Scene& scene, size_t crack, bool last) {
  const std::vector<Vec2>& points = scene.cracks[crack].points;
  const Vec2 x = last ? points.back() : points.front();
  const int body = body_at(scene, x);
  if (body < 0)
    return CrackEnd::outside;
  const double radius = junction_reach(scene, body);
  if (on_crack(scene, crack, last, radius))
    return CrackEnd::junction;
  return well_inside(scene, x, radius) ? CrackEnd::tip : CrackEnd::mouth;
}

std::vector<Tip> make_tips(const Scene& scene) {
  std::vector<Tip> tips;
  for (size_t c = 0; c < scene.cracks.size(); ++c)
    for (const bool last : {false, true}) {
      if (end_of(scene, c, last) != CrackEnd::tip)
        continue;
      const std::vector<Vec2>& points = scene.cracks[c].points;
      const int b = body_of_tip(scene, last ? points.back() : points.front());
      const Body& body = scene.bodies[static_cast<size_t>(b)];
      Tip tip;
      tip.crack = static_cast<int>(c);
      tip.last = last;
      tip.grows = growth_rule(scene, tip.crack) != nullptr;
      tip.body = b;
      tip.material = body.material;
      tips.push_back(tip);
    }
  return tips;
}

const GrowthRule* growth_rule(const Scene& scene, int crack) {
  const CrackLine& line = scene.cracks[static_cast<size_t>(crack)];
  if (!line.grows)
    return nullptr;
  return line.growth ? &*line.growth : scene.growth ? &*scene.growth : nullptr;
}

GrowthRule growth_rule_at(const Scene& scene, const Tip& tip) {
  GrowthRule rule = *growth_rule(scene, tip.crack);
  const Material& material = scene.materials[static_cast<size_t>(tip.material)];
  if (!(rule.toughness > 0))
    rule.toughness = rule.criterion == GrowthCriterion::k_max ? material.K_Ic : material.J_Ic;
  return rule;
}

}  // namespace riven
