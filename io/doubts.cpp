#include "io/doubts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <variant>

#include "core/fracture/growth.hpp"
#include "core/scene/area.hpp"
#include "core/state/lay_points.hpp"
#include "core/state/make_tips.hpp"
#include "io/checks.hpp"

namespace riven {

using namespace checks;

namespace {

constexpr double shortest_crack = 2;    // cells: of one of a cell J is 0 to 9 %, of one of two within 10 % of all of it
constexpr double shortest_zone = 3;     // cells: with 0.3 a beam bears twice its load
constexpr double heaviest = 23e3;       // kg/m^3: osmium, and a little
constexpr double lightest = 1;          // kg/m^3: aerogel
constexpr double most_area = 0.02;      // of a rectangle, that its particles may have more or less
constexpr double most_steps = 0.05;     // of other shapes, whose edges have steps
constexpr double softest = 100;         // Pa: a tenth of the softest gels and tissues
constexpr double fastest_waves = 20e3;  // m/s: diamond, and a little

void doubt_materials(const Scene& s, std::vector<Doubt>& list) {
  for (const Material& m : s.materials) {
    const double waves = std::sqrt(m.E / m.density);
    if (m.density > heaviest || m.density < lightest)
      list.push_back({place(s, "material " + m.name), fmt::format("no solid has a density of {:.6g} kg/m^3", m.density),
                      "steel has 7850 kg/m^3 or 7.85 g/cm^3; leave it where a body is to weigh more than it is large"});
    else if (m.E < softest)
      list.push_back({place(s, "material " + m.name), fmt::format("no solid is as soft as {:.6g} Pa", m.E),
                      "look at the unit of E"});
    else if (waves > fastest_waves)
      list.push_back({place(s, "material " + m.name),
                      fmt::format("waves run at {:.3g} km/s, faster than in diamond", 1e-3 * waves),
                      "look at the units of E and density"});
  }
}

/// Toughnesses of materials that no crack goes by.
void doubt_toughness(const Scene& s, std::vector<Doubt>& list) {
  const auto asked = [&](GrowthCriterion criterion) {
    for (size_t c = 0; c < s.cracks.size(); ++c)
      if (const GrowthRule* rule = growth_rule(s, static_cast<int>(c));
          rule && rule->criterion == criterion && !(rule->toughness > 0))
        return true;
    return false;
  };
  const bool K = asked(GrowthCriterion::k_max), J = asked(GrowthCriterion::critical_j);
  for (const Material& m : s.materials)
    if ((m.K_Ic > 0 && !K) || (m.J_Ic > 0 && !J))
      list.push_back({place(s, "material " + m.name),
                      fmt::format("no crack grows by its {}", m.K_Ic > 0 && !K ? "K_Ic" : "J_Ic"),
                      "a [growth] table takes it that has this criterion and no toughness of its own"});
}

/// Bodies hold what their particles do, and not what was drawn.
void doubt_edges(const Scene& s, const Body& b, std::vector<Doubt>& list) {
  const double spacing = s.cell / b.particles_per_cell, drawn = area_of(b.region);
  const std::vector<Vec2> points =
      lay_points(b.region, {}, make_lattice(s.grid.lower, s.grid.upper, s.cell), b.particles_per_cell);
  const double more = static_cast<double>(points.size()) * spacing * spacing / drawn - 1;
  if (std::fabs(more) > (std::holds_alternative<Rectangle>(b.region) ? most_area : most_steps))
    list.push_back({place(s, "body " + b.name),
                    fmt::format("its edges lie between particles, which make up {:.0f} % {} than what was drawn",
                                100 * std::fabs(more), more > 0 ? "more" : "less"),
                    "try cells that divide its sides, or smaller ones"});
}

void doubt_solids(const Scene& s, std::vector<Doubt>& list) {
  for (const Body& b : s.bodies)
    doubt_edges(s, b, list);
  for (const Body& b : s.bodies)
    for (const Region& hole : b.holes) {
      const Vec2 size = bounds(hole).upper - bounds(hole).lower;
      const double spacing = s.cell / b.particles_per_cell;
      if (std::min(size.x, size.y) < spacing)
        list.push_back({place(s, "body " + b.name),
                        fmt::format("a hole of {} may lie between particles, {} apart", format_size(size, 4),
                                    format_length(spacing, 4)),
                        "try smaller cells"});
    }
}

double thickness_of(const Scene& s, const Body& b) {
  return b.thickness > 0 ? b.thickness : s.thickness;
}

bool alike_at_tips(const Scene& s, int a, int b) {
  return elastically_alike(s.materials[static_cast<size_t>(a)], s.materials[static_cast<size_t>(b)]);
}

/// A body of other material or thickness than the tip's own in its largest contour, or null.
const Body* other_solid_near(const Scene& s, const Tip& tip, Vec2 at) {
  const double own = thickness_of(s, s.bodies[static_cast<size_t>(tip.body)]);
  int contour = s.fracture.contour;
  for (const FractureReading& r : s.readings)
    contour = std::max(contour, r.rules.contour);
  const int half = contour + 2;  // cells, half a cell from point to point
  for (int j = -half; j <= half; ++j)
    for (int i = -half; i <= half; ++i)
      if (const int k = body_at(s, at + (0.5 * s.cell) * Vec2{double(i), double(j)}); k >= 0)
        if (const Body& b = s.bodies[static_cast<size_t>(k)];
            !alike_at_tips(s, b.material, tip.material) || thickness_of(s, b) != own)
          return &b;
  return nullptr;
}

/// How far from a tip the solid ends, m, along the axis that is farther: none beyond the least J contour.
std::optional<double> end_of_solid(const Scene& s, Vec2 tip) {
  constexpr double least_contour = 2;  // cells to each side
  constexpr int parts = 8;             // of that
  const double step = least_contour * s.cell / parts;
  for (int ring = 1; ring <= parts; ++ring)
    for (int k = -ring; k <= ring; ++k)
      for (const Vec2 d : {Vec2{double(k), double(-ring)},
                           {double(k), double(ring)},
                           {double(-ring), double(k)},
                           {double(ring), double(k)}})
        if (body_at(s, tip + (1 - 1e-6) * step * d) < 0)
          return step * ring;
  return std::nullopt;
}

void doubt_tips(const Scene& s, std::vector<Doubt>& list) {
  const bool found = s.fracture.asked || s.growth ||
                     std::any_of(s.cracks.begin(), s.cracks.end(), [](const CrackLine& c) { return c.growth; });
  for (const Tip& tip : make_tips(s)) {
    const CrackLine& crack = s.cracks[static_cast<size_t>(tip.crack)];
    const char* const end = tip.last ? "last" : "first";
    const Vec2 at = tip.last ? crack.points.back() : crack.points.front();
    if (const auto far = found ? end_of_solid(s, at) : std::nullopt)
      list.push_back(
          {place(s, "crack " + crack.name),
           fmt::format("the solid ends less than {:.3g} cells from the {} tip, within its least J contour: J and K "
                       "are not resolved there",
                       *far / s.cell, end),
           "try smaller cells"});
    const Body* const other = s.bodies.size() < 2 ? nullptr : other_solid_near(s, tip, at);
    if (other && !alike_at_tips(s, other->material, tip.material))
      list.push_back({place(s, "crack " + crack.name),
                      fmt::format("the J contour of the {} tip takes in material {}, and its K are those of one of {}",
                                  end, s.materials[static_cast<size_t>(other->material)].name,
                                  s.materials[static_cast<size_t>(tip.material)].name),
                      "try a smaller contour or smaller cells; J holds where the two meet along the crack's line"});
    else if (other)
      list.push_back(
          {place(s, "crack " + crack.name),
           fmt::format("the J contour of the {} tip takes in body {}, which has another thickness: J is then "
                       "not that of the tip",
                       end, other->name),
           "try a smaller contour or smaller cells"});
  }
}

/// The zone in which a cohesive law gives way ahead of a tip is some E G / strength^2 long.
void doubt_zone(const Scene& s, const CrackLine& c, std::vector<Doubt>& list) {
  if (!c.traction || c.traction->kind == TractionKind::pressure)
    return;
  const std::vector<Tip> tips = make_tips(s);
  const bool front = c.traction->region || std::any_of(tips.begin(), tips.end(), [&](const Tip& t) {
                       return &s.cracks[static_cast<size_t>(t.crack)] == &c;
                     });
  const auto body = std::find_if(c.points.begin(), c.points.end(), [&](Vec2 x) { return body_at(s, x) >= 0; });
  const Material& m = s.materials[static_cast<size_t>(
      s.bodies[body == c.points.end() ? 0 : static_cast<size_t>(body_at(s, *body))].material)];
  const double strength = c.traction->strength, zone = m.E * c.traction->toughness / (strength * strength);
  if (front && zone < shortest_zone * s.cell)
    list.push_back(
        {place(s, "crack " + c.name),
         fmt::format("its cohesive zone is some {:.2g} cells long, E G / strength^2, and too strong for them",
                     zone / s.cell),
         fmt::format("try grid.cell = \"{}\", or less strength at the same toughness",
                     format_length(zone / shortest_zone, 3))});
}

/// A crack that opens (mode I, where it follows the greatest hoop stress) cannot outrun surface waves.
void doubt_speed(const Scene& s, const std::optional<GrowthRule>& rule, const std::string& key,
                 std::vector<Doubt>& list) {
  if (!rule || rule->direction != GrowthDirection::hoop)
    return;
  double fastest = 0;
  for (const Material& m : s.materials)
    fastest = std::max(fastest, rayleigh_speed(m, s.plane));
  if (rule->speed_limit > fastest)
    list.push_back(
        {place(s, key),
         fmt::format("no crack opens faster than the Rayleigh speed, {:.4g} m/s, and this one may run at {:.4g}",
                     fastest, rule->speed_limit),
         "leave speed_limit out"});
}

/// FLIP wears no waves down: what a crack releases stays in the body.
void doubt_noise(const Scene& s, std::vector<Doubt>& list) {
  for (size_t c = 0; s.transfer == Transfer::flip && c < s.cracks.size(); ++c)
    if (growth_rule(s, static_cast<int>(c))) {
      list.push_back({place(s, "crack " + s.cracks[c].name),
                      "with FLIP the energy that a crack releases as it grows stays in the body as noise, which drives "
                      "tips on",
                      "try solver.transfer = \"fmpm\" with solver.order = 2"});
      return;
    }
}

/// With uGIMP, at any time step; linear functions and B-splines do not.
void doubt_update(const Scene& s, std::vector<Doubt>& list) {
  if (s.stress_update == StressUpdate::usl && s.transfer == Transfer::fmpm && s.order > 2 &&
      s.shape == ShapeFunction::ugimp)
    list.push_back({place(s, "solver.stress_update"),
                    "with usl FMPM of an order above 2 may gain energy at free corners",
                    "try stress_update = \"usavg\", or an order of 2"});
}

/// At faces, as at borders, nodes have the velocity of particles within: a solid that gives up its own velocities for
/// these comes apart there by the strain of about half a cell on either side.
void doubt_interfaces(const Scene& s, std::vector<Doubt>& list) {
  for (const CrackLine& c : s.cracks)
    if (c.contact.value_or(s.contact).law == ContactLaw::interface && s.transfer != Transfer::flip && !s.affine &&
        s.shape != ShapeFunction::linear) {
      list.push_back({place(s, "crack " + c.name),
                      "with PIC, XPIC and FMPM an interface gives way by the stress times a cell over E more than its "
                      "springs do",
                      "try solver.affine = true, or solver.transfer = \"flip\""});
      return;
    }
}

void doubt_cracks(const Scene& s, std::vector<Doubt>& list) {
  doubt_noise(s, list);
  doubt_interfaces(s, list);
  doubt_speed(s, s.growth, "growth.speed_limit", list);
  for (size_t i = 0; i < s.cracks.size(); ++i)
    doubt_speed(s, s.cracks[i].growth, fmt::format("crack.{}.growth.speed_limit", i), list);
  for (const CrackLine& c : s.cracks)
    if (const double cells = length(c) / s.cell; cells < shortest_crack)
      list.push_back({place(s, "crack " + c.name),
                      fmt::format("a crack of {:.3g} cells may not open, as all of its nodes see its tips", cells),
                      fmt::format("try grid.cell = \"{}\"", format_length(length(c) / (2 * shortest_crack), 3))});
  for (const CrackLine& c : s.cracks)
    doubt_zone(s, c, list);
  const bool grows =
      s.growth || std::any_of(s.cracks.begin(), s.cracks.end(), [](const CrackLine& c) { return c.growth; });
  if (!s.fracture.asked && !grows)
    return;
  if (s.fracture.asked && s.fracture.contour <= 2)
    list.push_back({place(s, "fracture.contour"),
                    "a contour of 2 cells finds J up to 30 % too large where a crack lies between nodes, and more "
                    "beside a bend",
                    "try contour = 4"});
  doubt_tips(s, list);
}

}  // namespace

std::vector<Doubt> doubts(const Scene& s) {
  std::vector<Doubt> list;
  doubt_update(s, list);
  doubt_materials(s, list);
  doubt_toughness(s, list);
  doubt_solids(s, list);
  doubt_motion(s, list);
  doubt_gaps(s, list);
  doubt_grips(s, list);
  doubt_borders(s, list);
  doubt_loads(s, list);
  doubt_cracks(s, list);
  return list;
}

std::size_t print_doubts(const Scene& s) {
  constexpr size_t most = 10;
  const std::vector<Doubt> list = doubts(s);
  for (size_t i = 0; i < std::min(most, list.size()); ++i)
    fmt::print(stderr, "note: {}: {}; {}\n", list[i].place, list[i].what, list[i].hint);
  if (list.size() > most)
    fmt::print(stderr, "note: ... and {} more like these\n", list.size() - most);
  return list.size();
}

}  // namespace riven
