#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/fracture/crossing.hpp"
#include "core/state/lay_points.hpp"
#include "core/state/make_tips.hpp"
#include "io/checks.hpp"
#include "io/doubts.hpp"

namespace riven {

using namespace checks;

namespace {

/// How far rigid particles lie above and below a crack, m; 0 where none does beside a body.
struct Sides {
  double above = 0, below = 0;
};

/// Is there a body about x, on its own side of the line from a to b?
bool body_beside(const Scene& s, Vec2 x, Vec2 a, Vec2 b) {
  constexpr int directions = 8;
  for (int i = 0; i < directions; ++i) {
    const double angle = 2 * std::numbers::pi * i / directions;
    const Vec2 there = x + s.cell * Vec2{std::cos(angle), std::sin(angle)};
    if (orientation(a, b, there) == orientation(a, b, x) && body_at(s, there) >= 0)
      return true;
  }
  return false;
}

Sides sides_of(const Scene& s, const std::vector<Vec2>& points, const CrackLine& crack) {
  const double on_it = 1e-6 * s.cell, beyond = 2 * s.cell;
  Sides far;
  for (size_t k = 0; k + 1 < crack.points.size(); ++k) {
    const Vec2 a = crack.points[k], along = crack.points[k + 1] - a;
    const double length = norm(along);
    for (const Vec2 x : points) {
      const double t = dot(x - a, along) / length;
      const double up = dot(x - a, turned(along)) / length;
      const double before = k == 0 ? beyond : 0, after = k + 2 == crack.points.size() ? beyond : 0;
      if (t < -before || t > length + after || std::abs(up) < on_it || !body_beside(s, x, a, a + along))
        continue;
      double& most = up > 0 ? far.above : far.below;
      most = std::max(most, std::abs(up));
    }
  }
  return far;
}

/// A grip that is to hold one face reaches a little past the crack.
void doubt_sides(const Scene& s, const Grip& g, const Lattice& lattice, std::vector<Doubt>& list) {
  const std::vector<Vec2> points = lay_points(g.region, {}, lattice, g.particles_per_cell);
  const Vec2 around{2 * s.cell, 2 * s.cell};
  const Rectangle box{bounds(g.region).lower - around, bounds(g.region).upper + around};
  for (const CrackLine& c : s.cracks) {
    const ContactSettings& law = c.contact ? *c.contact : s.contact;
    if (law.law == ContactLaw::bonded || !checks::overlap(box, bounds(Polygon{c.points})))
      continue;
    const auto [above, below] = sides_of(s, points, c);
    const double least = std::min(above, below), most = std::max(above, below);
    if (least > 0 && least < s.cell && most > 3 * least)
      list.push_back(
          {place(s, "grip " + g.name),
           fmt::format("the grip reaches past crack {} by less than a cell, and holds the face there, too", c.name),
           "try one that ends on the crack, or a cell or more past it"});
  }
}

}  // namespace

void doubt_grips(const Scene& s, std::vector<Doubt>& list) {
  const Lattice lattice = make_lattice(s.grid.lower, s.grid.upper, s.cell);
  for (const Grip& g : s.grips) {
    const Rectangle box = bounds(g.region), way = travel(s, g);
    const Vec2 around{s.cell, s.cell};
    const Rectangle swept{box.lower + way.lower - around, box.upper + way.upper + around};
    if (std::none_of(s.bodies.begin(), s.bodies.end(),
                     [&](const Body& b) { return checks::overlap(swept, bounds(b.region)); }))
      list.push_back({place(s, "grip " + g.name), "the grip is more than a cell away from all bodies, wherever it goes",
                      "try a region beside what it is to hold"});
    doubt_sides(s, g, lattice, list);
  }
}

}  // namespace riven
