#include "perf/scenes.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "io/read_scene.hpp"

namespace riven::perf {

namespace {

constexpr double block_cell = 0.5e-3;
/// Material of the plates of Nairn and Aimene, section 3.
constexpr double E = 2.5e9, nu = 0.33, density = 1000;
/// Largest velocity of each end there, m/s: 0.2 % of the dilatational wave.
constexpr double pull = 3.849;

/// A rectangle of the material, on a grid that leaves room around it.
Scene bare(const std::string& name, Vec2 size, double cell) {
  const Vec2 margin{8 * cell, 8 * cell};
  Scene s;
  s.name = s.title = name;
  s.end_time = 1;  // far beyond what is run
  s.cell = cell;
  s.grid = {-1 * margin, size + margin};
  s.materials.push_back({"solid", LawKind::linear_elastic, E, nu, density});
  Body body;
  body.name = "body";
  body.region = Rectangle{{0, 0}, size};
  s.bodies.push_back(body);
  return s;
}

Scene block(int cells) {
  const double edge = cells * block_cell;
  Scene s = bare("block", {edge, edge}, block_cell);
  s.materials[0].law = LawKind::neo_hookean;
  s.stress_update = StressUpdate::usl;
  return s;
}

std::function<Vec2(Vec2)> swirl(int cells) {
  const double edge = cells * block_cell, wave = std::sqrt(E * (1 - nu) / ((1 + nu) * (1 - 2 * nu) * density));
  const double spin = 0.05 * wave / (edge / 2), amplitude = 0.005 * wave, k = 2 * std::numbers::pi / edge;
  return [=](Vec2 x) {
    const Vec2 turn = spin * turned(x - Vec2{edge / 2, edge / 2});
    return turn + amplitude * Vec2{std::sin(k * x.x) * std::cos(k * x.y), std::cos(k * x.x) * std::sin(k * x.y)};
  };
}

/// Uniform stretch along y of a plate of the given size, its ends moving at `pull`.
std::function<Vec2(Vec2)> stretch(Vec2 size, double pull) {
  const double rate = 2 * pull / size.y;
  return [=](Vec2 x) { return Vec2{-nu * rate * (x.x - size.x / 2), rate * (x.y - size.y / 2)}; };
}

/// Rigid particles one cell high along the upper and the lower edge of a plate, moving apart.
void pull_apart(Scene& s, Vec2 size, double velocity) {
  s.grips.clear();
  const auto grip = [&](const char* name, double bottom, double v) {
    Grip g;
    g.name = name;
    g.region = Rectangle{{0, bottom}, {size.x, bottom + s.cell}};
    g.velocity[1] = TimeFunction{v, {}, ""};
    s.grips.push_back(g);
  };
  grip("top", size.y, velocity);
  grip("bottom", -s.cell, -velocity);
}

Scene shipped(const char* file) {
  Scene s = read_scene((std::filesystem::path(RIVEN_CASES_DIR) / file).string());
  s.end_time = 1;
  return s;
}

}  // namespace

Entrant swirling(const std::string& name, int cells, const std::function<void(Scene&)>& change) {
  Entrant e{name, block(cells), swirl(cells), ""};
  if (change)
    change(e.scene);
  return e;
}

Entrant pulled(const std::string& name, const Scene& plate) {
  const Rectangle body = bounds(plate.bodies[0].region);
  const std::function<Vec2(Vec2)> velocity = stretch(body.upper - body.lower, (*plate.grips[0].velocity[1])(0));
  return {name, plate, velocity, ""};
}

Scene sent_plate(double cell) {
  const Vec2 size{50e-3, 100e-3};
  Scene s = bare("sent", size, cell);
  s.plane = Plane::stress;
  s.transfer = Transfer::fmpm;
  s.order = 1;
  pull_apart(s, size, pull);
  const double a = 25e-3, b = 15e-3, middle = size.y / 2;
  const auto crack = [&](const char* name, std::vector<Vec2> points) {
    CrackLine c;
    c.name = name;
    c.points = std::move(points);
    s.cracks.push_back(c);
  };
  crack("H", {{0, middle}, {a, middle}});
  crack("V", {{b, middle - a}, {b, middle + a}});
  s.contact.law = ContactLaw::frictionless;
  return s;
}

Scene many_plate(double edge, double cell) {
  Scene s = shipped("many_cracks.toml");
  s.cell = cell;
  const Rectangle whole = bounds(s.bodies[0].region);
  const Vec2 margin = whole.lower - s.grid.lower, upper = whole.lower + Vec2{edge, edge};
  s.bodies[0].region = Rectangle{whole.lower, upper};
  s.grid.upper = upper + margin;
  pull_apart(s, {edge, edge}, pull);
  std::erase_if(s.cracks, [&](const CrackLine& c) {
    return std::any_of(c.points.begin(), c.points.end(), [&](Vec2 x) { return x.x > upper.x || x.y > upper.y; });
  });
  return s;
}

Scene growing_plate(double cell, double velocity) {
  Scene s = shipped("ten_cracks.toml");
  const Rectangle plate = bounds(s.bodies[0].region);
  s.grid = {plate.lower - 8 * Vec2{cell, cell}, plate.upper + 8 * Vec2{cell, cell}};
  s.cell = cell;
  pull_apart(s, plate.upper - plate.lower, velocity);
  return s;
}

Scene thousand_plate() {
  Scene s = shipped("thousand_cracks.toml");
  const Rectangle plate = bounds(s.bodies[0].region);
  pull_apart(s, plate.upper - plate.lower, 20);
  s.growth->toughness = 0.16e6;
  return s;
}

}  // namespace riven::perf
