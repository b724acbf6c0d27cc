#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/laws/contact.hpp"
#include "core/state/first_gaps.hpp"
#include "core/state/lay_points.hpp"
#include "core/state/make_tips.hpp"
#include "io/checks.hpp"
#include "io/doubts.hpp"

namespace riven {

using namespace checks;

namespace {

/// The cracks of a scene and what lies beside them.
struct Borders {
  const Scene& scene;
  Cracks cracks;
  exec::Array<Vec2> gaps;

  explicit Borders(const Scene& s)
      : scene(s), cracks(make_cracks(s, least_particle_distance(s))), gaps(first_gaps(s, cracks)) {}

  int first(int crack) const { return cracks.end_point(crack, false); }
  int last(int crack) const { return cracks.end_point(crack, true); }
  /// From above to below point k, as far as is void.
  std::pair<Vec2, Vec2> across(int k) const {
    const int next = std::min(k + 1, last(cracks.crack[k])), before = next - 1;
    const Vec2 along = cracks.plane0[next] - cracks.plane0[before], up = (1 / norm(along)) * turned(along);
    return {cracks.plane0[k] + gaps[k].x * up, cracks.plane0[k] - gaps[k].y * up};
  }
  bool between_solids(int k) const { return std::isfinite(gaps[k].x + gaps[k].y); }
  int body(Vec2 x) const { return body_at(scene, x); }
  const std::string& name(int crack) const { return cracks.names[static_cast<std::size_t>(crack)]; }
  std::string where(int crack) const { return place(scene, "crack " + name(crack)); }
};

/// Do the lines a and b meet, or come nearer to it than `slack`?
bool meet(std::pair<Vec2, Vec2> a, Vec2 from, Vec2 to, double slack) {
  const Vec2 d = a.second - a.first, e = to - from;
  const double area = cross(d, e);
  if (area == 0)
    return false;
  const double t = cross(from - a.first, e) / area, u = cross(from - a.first, d) / area;
  const double more = slack / norm(d);
  return t > -more && t < 1 + more && u >= 0 && u <= 1;
}

void doubt_detection(const Borders& b, int crack, std::vector<Doubt>& list) {
  constexpr double closed = 0.2, far = 2;  // cells: no more than how particles make up an edge; what no node sees
  double widest = 0;
  for (int k = b.first(crack); k <= b.last(crack); ++k)
    if (const double gap = b.gaps[k].x + b.gaps[k].y; gap < far * b.scene.cell)
      widest = std::max(widest, gap);
  if (b.scene.contact_rules.detection != ContactDetection::displacement && widest > closed * b.scene.cell)
    list.push_back({b.where(crack),
                    fmt::format("a gap of up to {} lies between solids along the crack, which counts as shut where it "
                                "is drawn: they press on each other before they meet",
                                format_length(widest, 2)),
                    "try detection = \"displacement\" in [contact], which knows gaps"});
}

/// Each particle closes the gap of one crack alone.
void doubt_two_cracks(const Borders& b, int crack, std::vector<Doubt>& list) {
  constexpr double slack = 0.1;  // cells
  for (int other = crack + 1; other < b.cracks.count(); ++other) {
    int all = 0, both = 0;
    for (int k = b.first(crack); k <= b.last(crack); ++k) {
      if (!b.between_solids(k))
        continue;
      ++all;
      const auto gap = b.across(k);
      bool met = false;
      for (int m = b.first(other); m < b.last(other) && norm(gap.second - gap.first) > slack * b.scene.cell; ++m)
        met = met || meet(gap, b.cracks.plane0[m], b.cracks.plane0[m + 1], slack * b.scene.cell);
      both += met;
    }
    if (4 * both > all && all > 0)
      list.push_back({b.where(other),
                      fmt::format("the crack lies along the same gap between solids as crack {}: what is on either "
                                  "side of both presses on each other before it meets",
                                  b.name(crack)),
                      "try one crack, along the border of either solid"});
  }
}

/// What lies outside of it goes with what is on the other side.
void doubt_depth(const Borders& b, int crack, std::vector<Doubt>& list) {
  constexpr double kept_off = 0.05, border = 0.3;  // cells: so near to a crack particles are laid on their own side
  const double h = b.scene.cell;
  int within = 0, all = 0;
  for (int k = b.first(crack); k < b.last(crack); ++k) {
    const Vec2 a = b.cracks.plane0[k], along = b.cracks.plane0[k + 1] - a, x = a + 0.5 * along;
    const Vec2 up = (1 / norm(along)) * turned(along);
    if (!b.between_solids(k))
      continue;
    ++all;
    for (const double side : {h, -h})
      within += b.body(x + kept_off * side * up) >= 0 && b.body(x - border * side * up) >= 0 &&
                b.body(x + kept_off * side * up) == b.body(x - border * side * up) &&
                b.body(x + border * side * up) != b.body(x + kept_off * side * up);
  }
  if (4 * within > all && all > 0)
    list.push_back({b.where(crack),
                    "the crack lies a little inside of a body along its border: particles between the two go with what "
                    "is on the other side",
                    "try a crack along the border, or as little outside of it"});
}

/// Bodies stick to each other where there is no crack between them. Of a tip on their border that is meant.
void doubt_ends(const Borders& b, int crack, std::vector<Doubt>& list) {
  constexpr double beside = 0.3, step = 0.1;  // cells
  const double h = b.scene.cell;
  for (const bool last : {false, true}) {
    const int end = b.cracks.end_point(crack, last);
    const Vec2 x = b.cracks.plane0[end], back = b.cracks.plane0[b.cracks.next_to_end(crack, last)];
    const Vec2 out = (1 / norm(x - back)) * (x - back), up = (last ? 1. : -1.) * turned(out), gap = b.gaps[end];
    if (!b.between_solids(end))
      continue;
    const auto side_by_side = [&](double cells) {
      const Vec2 ahead = x + (cells * h) * out;
      const int above = b.body(ahead + (gap.x + beside * h) * up), below = b.body(ahead - (gap.y + beside * h) * up);
      return above >= 0 && below >= 0 && above != below;
    };
    if (side_by_side(step) && !side_by_side(1))
      list.push_back({b.where(crack),
                      fmt::format("the crack ends less than a cell before the border of two bodies does, at {}: they "
                                  "stick to each other there",
                                  text(x)),
                      "try a crack that goes on past the end of the border"});
  }
}

}  // namespace

void doubt_borders(const Scene& s, std::vector<Doubt>& list) {
  constexpr int most_cracks = 100;  // of which bodies are looked for point by point
  if (s.bodies.size() < 2 || s.cracks.size() > most_cracks)
    return;
  const Borders b(s);
  for (int c = 0; c < b.cracks.count(); ++c) {
    if (!keeps_apart(b.cracks.contact[c].law))
      continue;
    doubt_detection(b, c, list);
    doubt_two_cracks(b, c, list);
    doubt_depth(b, c, list);
    doubt_ends(b, c, list);
  }
}

}  // namespace riven
