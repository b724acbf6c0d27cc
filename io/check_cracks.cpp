#include <algorithm>
#include <cmath>

#include "core/laws/contact.hpp"
#include "core/scene/names.hpp"
#include "core/state/make_tips.hpp"
#include "io/checks.hpp"

namespace riven::checks {

namespace {

constexpr double most_segments = 1e7;
constexpr double most_to_cell = 200;
constexpr size_t most_compared = 10000;  // cracks, in pairs
constexpr int pieces = 7;                // of each straight part of a crack, that are compared
constexpr double most_samples = 1e5;     // of all cracks together, to find one point in a body

bool solid(const Scene& s, Vec2 p) {
  return std::any_of(s.bodies.begin(), s.bodies.end(), [&](const Body& b) {
    return contains(b.region, p) &&
           std::none_of(b.holes.begin(), b.holes.end(), [&](const Region& h) { return contains(h, p); });
  });
}

/// True when some point of the crack, looked at every `spacing`, lies in a body or along its edge, and in the region if
/// there is one.
bool meets_body(const Scene& s, const CrackLine& c, double spacing, const std::optional<Region>& region = {}) {
  for (size_t i = 1; i < c.points.size(); ++i) {
    const Vec2 a = c.points[i - 1], d = c.points[i] - a;
    const int n = static_cast<int>(std::ceil(norm(d) / spacing)) + 1;
    const Vec2 aside = (0.05 * s.cell / norm(d)) * turned(d);
    for (int k = 0; k < n; ++k) {
      const Vec2 p = a + d * ((k + 0.5) / n);
      if ((solid(s, p) || solid(s, p + aside) || solid(s, p - aside)) && (!region || contains(*region, p)))
        return true;
    }
  }
  return false;
}

void check_contact(const Scene& s, const std::string& key, const ContactSettings& c) {
  if (c.law == ContactLaw::interface && !(c.normal_stiffness > 0))
    refuse(s, key, "an interface needs a normal stiffness", fmt::format("{} Pa/m", c.normal_stiffness),
           "greater than 0", "law = \"frictionless\" for none");
}

/// Contact that waits for faces to close needs faces that start apart.
void check_waiting(const Scene& s, const CrackLine& c) {
  const ContactLaw law = c.contact.value_or(s.contact).law;
  if (s.contact_rules.when == ContactWhen::closing && holds_together(law))
    refuse(s, "crack " + c.name, "contact of faces that hold together from the start cannot wait for them to close",
           fmt::format("law = \"{}\", contact.when = \"auto\"", name_of(law)), "ignored, stick, frictionless, coulomb",
           "contact.when = \"always\"");
}

using Points = std::vector<Vec2>;

/// Does a line lie on another one all along? Both ends of one that closes another to a ring do, too.
bool lies_on(const Points& line, const Points& other, double tolerance) {
  const auto on_other = [&](Vec2 x) {
    for (size_t i = 1; i < other.size(); ++i) {
      const Vec2 a = other[i - 1], d = other[i] - a;
      if (norm(x - a - std::clamp(dot(x - a, d) / dot(d, d), 0., 1.) * d) < tolerance)
        return true;
    }
    return false;
  };
  for (size_t i = 1; i < line.size(); ++i)
    for (int k = 0; k <= pieces; ++k)
      if (!on_other(line[i - 1] + (double(k) / pieces) * (line[i] - line[i - 1])))
        return false;
  return true;
}

/// Where a line lies on an earlier part of itself for some length; where parts only meet or cross it does not. Of long
/// ones only parts that are near along the line are compared, and none with what comes right before it.
std::optional<Vec2> own_double(const Points& line, double tolerance) {
  constexpr size_t most_back = 300;  // segments
  for (size_t j = 2; j < line.size(); ++j) {
    const Vec2 from = line[j - 1], piece = (1. / pieces) * (line[j] - from);
    double between = 0;  // along the line, from the end of segment i to the start of segment j
    for (size_t i = j - 1; i >= 1 && i + most_back > j; --i) {
      for (int k = 0; k < pieces; ++k)
        if (between + k * norm(piece) > 4 * tolerance &&
            lies_on({from + double(k) * piece, from + (k + 1.) * piece}, {line[i - 1], line[i]}, tolerance))
          return from + double(k) * piece;
      between += norm(line[i] - line[i - 1]);
    }
  }
  return std::nullopt;
}

/// Half the size of the smallest particles, m, within which an end of a crack counts as joined to another.
double half_particle(const Scene& s) {
  double least = s.cell;
  for (int b = 0; b < static_cast<int>(s.bodies.size()); ++b)
    least = std::min(least, junction_reach(s, b));
  return least;
}

/// Faces of cracks that lie on each other are the same, and so are their ends, none of which is a tip then. Nor is
/// there anything between those that lie along each other nearer than half a particle.
void check_doubles(const Scene& s) {
  if (s.cracks.size() > most_compared)
    return;
  const double near = half_particle(s);
  for (const CrackLine& c : s.cracks)
    for (const CrackLine& other : s.cracks) {
      if (&c == &other || !lies_on(c.points, other.points, near))
        continue;
      const std::string place = text(c.points.front()) + " to " + text(c.points.back());
      if (lies_on(c.points, other.points, 0.01 * s.cell))
        refuse(s, "crack " + c.name, "the crack lies on another one, crack " + other.name, place,
               "cracks that meet or cross, at most", "only one of them");
      refuse(s, "crack " + c.name, "the crack lies all along crack " + other.name + " with no particle between", place,
             fmt::format("{} or more, half a particle, from cracks beside it", format_length(near, 2)),
             "smaller cells, or only one of them");
    }
  for (const CrackLine& c : s.cracks)
    if (const auto at = own_double(c.points, 0.01 * s.cell))
      refuse(s, "crack " + c.name, "the crack turns back and lies on itself", "at " + text(*at),
             "a line that crosses itself, at most", "points in their order along the crack");
}

/// No part of a crack may lie on a symmetry plane: it would have but one face, and that could not move.
void check_planes(const Scene& s, const CrackLine& c) {
  const auto on = [&](const SymmetryPlane& p, Vec2 x) {
    return std::abs((p.axis == 0 ? x.x : x.y) - p.position) < 1e-6 * s.cell;
  };
  for (const SymmetryPlane& p : s.symmetry)
    for (size_t i = 1; i < c.points.size(); ++i)
      if (on(p, c.points[i - 1]) && on(p, c.points[i]))
        refuse(s, "crack " + c.name, "the crack lies on a symmetry plane, which holds its face",
               text(c.points[i - 1]) + " to " + text(c.points[i]), "cracks that end on the plane, or lie off it",
               "both halves of the solid, without this [[symmetry]]");
}

/// Growth asked for must have a tip to grow from, and J one to be found at.
void check_tips(const Scene& s) {
  const bool cracks_grow = std::any_of(s.cracks.begin(), s.cracks.end(), [](const CrackLine& c) { return c.growth; });
  if (!s.growth && !cracks_grow && !(s.fracture.asked && !s.cracks.empty()))
    return;
  const std::vector<Tip> tips = make_tips(s);
  const std::string wanted =
      fmt::format("an end inside a body, {} or more, half a particle, from its border and from other cracks",
                  format_length(half_particle(s), 2));
  const std::string count = fmt::format("{} crack{}", s.cracks.size(), s.cracks.size() == 1 ? "" : "s");
  if (s.fracture.asked && tips.empty())
    refuse(s, "fracture", "J and K are asked for but no crack has a tip in a body", count, wanted, "no [fracture]");
  for (int c = 0; c < static_cast<int>(s.cracks.size()); ++c) {
    const CrackLine& line = s.cracks[static_cast<size_t>(c)];
    if (line.growth && std::none_of(tips.begin(), tips.end(), [&](const Tip& t) { return t.crack == c; }))
      refuse(s, "crack " + line.name, "the crack is to grow but has no tip in a body",
             text(line.points.front()) + " to " + text(line.points.back()), wanted, "no growth for this crack");
  }
  if (s.growth && std::none_of(tips.begin(), tips.end(), [](const Tip& t) { return t.grows; }))
    refuse(s, "growth", "cracks are to grow but none that may has a tip in a body", count, wanted, "no [growth]");
}

void check_traction(const Scene& s, int crack, double spacing) {
  const CrackLine& c = s.cracks[static_cast<size_t>(crack)];
  const ContactLaw law = c.contact.value_or(s.contact).law;
  if (holds_together(law))
    refuse(s, "crack " + c.name, "tractions on faces that contact joins", fmt::format("law = \"{}\"", name_of(law)),
           "a law of contact that lets faces part", "law = \"frictionless\"");
  if (c.traction->kind != TractionKind::pressure && s.surface_update == SurfaceUpdate::flip)
    refuse(s, "crack " + c.name, "cohesive faces that move by flip gain energy in every step",
           "surface_update = \"flip\"", "surface_update = \"xpic\" or \"pic\" in [cracks]");
  const bool grows = growth_rule(s, crack) != nullptr;  // perhaps into the region
  if (c.traction->region && !grows && !meets_body(s, c, spacing, c.traction->region))
    refuse(s, "crack " + c.name, "no part of the crack in a body lies in the region of its traction",
           text(bounds(*c.traction->region)), "a region that the crack passes through, or grows into");
}

/// The springs between faces are as wide as the scene is thick.
void check_interface(const Scene& s, const CrackLine& c) {
  if (c.contact.value_or(s.contact).law != ContactLaw::interface)
    return;
  for (const Body& b : s.bodies)
    if (b.thickness > 0 && b.thickness != s.thickness)
      refuse(s, "body " + b.name, "an interface takes the thickness of the scene, and a body has another",
             format_length(b.thickness), format_length(s.thickness), "solver.thickness, and none of the body's own");
}

}  // namespace

double length(const CrackLine& c) {
  double sum = 0;
  for (size_t i = 1; i < c.points.size(); ++i)
    sum += norm(c.points[i] - c.points[i - 1]);
  return sum;
}

void check_cracks(const Scene& s) {
  check_contact(s, "contact", s.contact);
  double total = 0, segments = 0;
  for (const CrackLine& c : s.cracks)
    total += length(c);
  const double spacing = std::max(s.cell / 4, total / most_samples);
  for (const CrackLine& c : s.cracks) {
    if (c.contact)
      check_contact(s, "crack " + c.name, *c.contact);
    check_waiting(s, c);
    check_interface(s, c);
    for (size_t i = 0; i < c.points.size(); ++i) {
      const Vec2 p = c.points[i];
      if (i > 0 && norm(p - c.points[i - 1]) < 1e-9 * s.cell)
        refuse(s, "crack " + c.name, "the crack has a piece without length",
               fmt::format("point {} at {}", i + 1, text(p)), "points that differ from the one before");
      if (p.x < s.grid.lower.x || p.x > s.grid.upper.x || p.y < s.grid.lower.y || p.y > s.grid.upper.y)
        refuse(s, "crack " + c.name, "the grid is too small: the crack leaves it",
               fmt::format("point {} at {}", i + 1, text(p)), text(s.grid.lower) + " to " + text(s.grid.upper),
               "a larger grid, or a crack that ends in it");
    }
    if (c.resolution > 0 && c.resolution < s.cell / most_to_cell)
      refuse(s, "crack " + c.name, "the resolution is finer than anything that the grid knows",
             format_length(c.resolution),
             fmt::format("{} or more, 1/{:.0f} of a cell", format_length(s.cell / most_to_cell, 3), most_to_cell),
             "leave it out: the distance of particles is enough");
    segments += length(c) / (c.resolution > 0 ? c.resolution : s.cell / 2);
    if (segments > most_segments)
      refuse(s, "crack " + c.name, "the cracks have too many segments", fmt::format("{:.3g} with this crack", segments),
             fmt::format("at most {:.0e} segments", most_segments), "a larger resolution");
    check_planes(s, c);
    if (!meets_body(s, c, spacing))
      refuse(s, "crack " + c.name, "no part of the crack lies in a body",
             text(c.points.front()) + " to " + text(c.points.back()), "a crack through a body, or along its border");
    if (c.traction)
      check_traction(s, static_cast<int>(&c - s.cracks.data()), spacing);
  }
  check_doubles(s);
  check_tips(s);
}

}  // namespace riven::checks
