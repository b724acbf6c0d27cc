#include <algorithm>
#include <cmath>
#include <optional>

#include "core/laws/contact.hpp"
#include "core/state/make_tips.hpp"
#include "io/checks.hpp"
#include "io/doubts.hpp"

namespace riven {

using namespace checks;

namespace {

struct Seen {
  int body;
  double distance;  ///< m
};

/// The first body from x on along `way`, within a few cells.
std::optional<Seen> body_along(const Scene& s, Vec2 x, Vec2 way) {
  constexpr double step = 0.05, far = 2;  // cells
  constexpr int halvings = 20;
  const auto at = [&](double d) { return body_at(s, x + (d * s.cell) * way); };
  double nearer = 0, d = step;
  for (; d <= far && at(d) < 0; d += step)
    nearer = d;
  const int body = at(d);
  if (body < 0)
    return {};
  for (int k = 0; k < halvings; ++k)
    (at(0.5 * (nearer + d)) < 0 ? nearer : d) = 0.5 * (nearer + d);
  return Seen{body, d * s.cell};
}

constexpr double closed = 0.2;  // cells: less is no more than how particles make up a slanted edge

/// The widest gap between two bodies on either side of a crack, m, if it is open along a quarter of where they are.
struct Gap {
  double width = 0;
  int above = 0, below = 0;
};

Gap widest_gap(const Scene& s, const CrackLine& c) {
  Gap most;
  int all = 0, open = 0;
  for (size_t k = 0; k + 1 < c.points.size(); ++k) {
    const Vec2 a = c.points[k], along = c.points[k + 1] - a;
    const double length = norm(along);
    const Vec2 up = (1 / length) * turned(along);
    const int n = static_cast<int>(std::ceil(2 * length / s.cell));
    for (int i = 0; i < n; ++i) {
      const Vec2 x = a + ((i + 0.5) / n) * along;
      const auto above = body_along(s, x, up), below = body_along(s, x, -up);
      if (!above || !below || above->body == below->body)
        continue;
      const double width = above->distance + below->distance;
      ++all;
      open += width > closed * s.cell;
      if (width > most.width)
        most = {width, above->body, below->body};
    }
  }
  return 4 * open > all ? most : Gap{};
}

}  // namespace

void doubt_gaps(const Scene& s, std::vector<Doubt>& list) {
  constexpr double most_cracks = 100;  // of which bodies are looked for point by point
  if (s.bodies.size() < 2 || s.cracks.size() > most_cracks)
    return;
  for (const CrackLine& c : s.cracks) {
    if (!keeps_apart((c.contact ? *c.contact : s.contact).law))
      continue;
    const Gap gap = widest_gap(s, c);
    if (gap.width > 0)
      list.push_back(
          {place(s, "crack " + c.name),
           fmt::format("a gap of up to {} lies between {} and {} along the crack, which counts as shut where "
                       "it is drawn: they press on each other before they meet",
                       format_length(gap.width, 2), s.bodies[static_cast<size_t>(gap.above)].name,
                       s.bodies[static_cast<size_t>(gap.below)].name),
           "try bodies that touch along it"});
  }
}

}  // namespace riven
