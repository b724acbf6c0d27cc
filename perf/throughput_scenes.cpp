#include "perf/throughput_scenes.hpp"

#include <cmath>
#include <filesystem>
#include <numbers>

#include "io/read_scene.hpp"

namespace riven::perf {

namespace {

constexpr double cell = 0.5e-3;
/// Material of the plates of Nairn and Aimene, "Modeling multiple crack propagation in the material point method by
/// J-integral methods accounting for other cracks intersecting the J contour", section 3.
constexpr double E = 2.5e9, nu = 0.33, density = 1000;
/// Largest velocity of each end there, m/s: 0.2 % of the dilatational wave.
constexpr double pull = 3.849;

Scene bare(const std::string& name, Vec2 size, double margin) {
  Scene s;
  s.name = s.title = name;
  s.end_time = 1;  // far beyond what is run
  s.cell = cell;
  s.grid = {{-margin, -margin}, size + Vec2{margin, margin}};
  s.materials.push_back({"solid", LawKind::linear_elastic, E, nu, density});
  Body body;
  body.name = "body";
  body.region = Rectangle{{0, 0}, size};
  s.bodies.push_back(body);
  return s;
}

/// A free square of `cells` x `cells` cells, 4 particles in each: uGIMP, FLIP, USL, neo-Hookean, plane strain.
Scene block(int cells) {
  const double edge = cells * cell;
  Scene s = bare("block", {edge, edge}, 8 * cell);
  s.materials[0].law = LawKind::neo_hookean;
  s.stress_update = StressUpdate::usl;
  return s;
}

/// The block turns, and stretches and shears in waves as long as its edge. Its edges turn at 5 % of the dilatational
/// wave: as fast as in a hard impact, so that particles are sorted again about every 45 steps.
std::function<Vec2(Vec2)> swirl(int cells) {
  const double edge = cells * cell, wave = std::sqrt(E * (1 - nu) / ((1 + nu) * (1 - 2 * nu) * density));
  const double spin = 0.05 * wave / (edge / 2), amplitude = 0.005 * wave, k = 2 * std::numbers::pi / edge;
  return [=](Vec2 x) {
    const Vec2 turn = spin * turned(x - Vec2{edge / 2, edge / 2});
    return turn + amplitude * Vec2{std::sin(k * x.x) * std::cos(k * x.y), std::cos(k * x.x) * std::sin(k * x.y)};
  };
}

/// The square swirling at first; `change` makes the variant of the method.
Entrant swirling(const std::string& name, int cells, const std::function<void(Scene&)>& change = {}) {
  Entrant e{name, block(cells), swirl(cells), ""};
  if (change)
    change(e.scene);
  return e;
}

std::vector<Entrant> methods() {
  constexpr int cells = 200;
  const auto updated = [&](const char* name, StressUpdate update) {
    return swirling(name, cells, [=](Scene& s) { s.stress_update = update; });
  };
  const auto transferred = [&](const char* name, Transfer transfer, int order) {
    return swirling(name, cells, [=](Scene& s) {
      s.transfer = transfer;
      s.order = order;
      s.pic_fraction = transfer == Transfer::pic ? 0.1 : 0;
    });
  };
  return {updated("usl flip", StressUpdate::usl),
          updated("musl", StressUpdate::musl),
          updated("usf", StressUpdate::usf),
          updated("usavg", StressUpdate::usavg),
          transferred("pic 0.1", Transfer::pic, 1),
          transferred("fmpm(1)", Transfer::fmpm, 1),
          transferred("fmpm(2)", Transfer::fmpm, 2),
          transferred("xpic(2)", Transfer::xpic, 2),
          swirling("linear, musl", cells,
                   [](Scene& s) {
                     // USL divides by the tiny masses of nodes at the free edge and turns a particle inside out
                     s.shape = ShapeFunction::linear;
                     s.stress_update = StressUpdate::musl;
                   }),
          swirling("bspline", cells, [](Scene& s) { s.shape = ShapeFunction::bspline; }),
          swirling("atomic", cells, [](Scene& s) { s.scatter = ScatterKind::atomic; })};
}

/// Uniform stretch along y of a plate of the given size, its ends moving at the grips' velocity.
std::function<Vec2(Vec2)> stretch(Vec2 size) {
  const double rate = 2 * pull / size.y;
  return [=](Vec2 x) { return Vec2{-nu * rate * (x.x - size.x / 2), rate * (x.y - size.y / 2)}; };
}

/// SENT plate of the paper (section 3.2) between grips of rigid particles: a horizontal edge crack of 25 mm, and a
/// vertical one of twice 25 mm that crosses it at b/w = 0.3, where the faces would overlap without contact.
Scene sent() {
  const Vec2 size{50e-3, 100e-3};
  Scene s = bare("sent", size, 8 * cell);
  s.plane = Plane::stress;
  s.transfer = Transfer::fmpm;
  s.order = 1;
  const auto grip = [&](const char* name, double bottom, double velocity) {
    Grip g;
    g.name = name;
    g.region = Rectangle{{0, bottom}, {size.x, bottom + cell}};
    g.velocity[1] = TimeFunction{velocity, {}, ""};
    s.grips.push_back(g);
  };
  grip("top", size.y, pull);
  grip("bottom", -cell, -pull);
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

/// The shipped plate with 200 cracks.
Scene many() {
  Scene s = read_scene((std::filesystem::path(RIVEN_CASES_DIR) / "many_cracks.toml").string());
  s.end_time = 1;
  return s;
}

/// A plate with and without its cracks, as it stands (two stress updates a step) and with USL, whose cheaper step
/// leaves the cracks a greater share.
std::vector<Entrant> pulled(const Scene& plate) {
  const Rectangle body = bounds(plate.bodies[0].region);
  const std::function<Vec2(Vec2)> velocity = stretch(body.upper - body.lower);
  std::vector<Entrant> list;
  for (const auto& [suffix, update] : {std::pair{"", plate.stress_update}, std::pair{", usl", StressUpdate::usl}}) {
    Scene with = plate;
    with.stress_update = update;
    Scene without = with;
    without.cracks.clear();
    const std::string plain = std::string("no cracks") + suffix;
    list.push_back({plain, without, velocity, ""});
    list.push_back({std::string("cracks") + suffix, with, velocity, plain});
  }
  return list;
}

}  // namespace

std::vector<Group> throughput_groups() {
  return {
      {"block", "block without cracks, 160,000 particles: uGIMP, FLIP, USL, neo-Hookean", 20, 50, 9,
       [] { return std::vector{swirling("block", 200)}; }},
      {"large", "the same with 1,440,000 particles, beyond the caches", 10, 50, 3,
       [] { return std::vector{swirling("large", 600)}; }},
      {"methods", "stress updates, transfers, shape functions and scatter on the block", 20, 50, 5, methods},
      {"sent", "plate with two crossing cracks (H and V), 80,000 particles, frictionless contact", 60, 10, 55,
       [] { return pulled(sent()); }},
      {"many", "plate with 200 cracks, 160,000 particles, frictionless contact", 40, 8, 35,
       [] { return pulled(many()); }},
  };
}

}  // namespace riven::perf
